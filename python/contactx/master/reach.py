# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How far apart slave nodes and masters are paired."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.surface import FacetList


def default_reach(x: npt.NDArray[np.float64], slave: FacetList, master: FacetList) -> float:
    """Diameter of the larger surface: twice the largest distance of its nodes from their mean.

    A body that has moved into another within one iteration must still be found.
    """
    radii = []
    for facets in (slave, master):
        nodes = x[np.unique(facets.nodes)]
        radii.append(np.linalg.norm(nodes - nodes.mean(axis=0), axis=1).max())
    return 2 * float(max(radii))
