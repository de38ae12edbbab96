# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How far apart slave nodes and masters are paired."""

from __future__ import annotations

import numpy as np

from contactx.parallel.halo import Halo
from contactx.parallel.reduce import largest, total
from contactx.surface import FacetList


def default_reach(halo: Halo, slave: FacetList, master: FacetList) -> float:
    """Diameter of the larger surface: twice the largest distance of its nodes from their mean.

    A body that has moved into another within one iteration must still be found.

    Args:
        halo: Nodes of this rank.
        slave: Slave facets on this rank.
        master: Master facets on this rank.
    """
    radii = []
    for facets in (slave, master):
        # Each node counts on the rank that owns it
        marked = np.zeros(halo.num_nodes)
        marked[facets.nodes] = 1
        nodes = halo.x[: halo.num_owned][halo.add_up(marked) > 0]
        sums = total(halo.comm, np.append(nodes.sum(axis=0), len(nodes)))
        arms = np.linalg.norm(nodes - sums[:-1] / sums[-1], axis=1)
        radii.append(largest(halo.comm, arms.max(initial=0.0)))
    return 2 * float(max(radii))
