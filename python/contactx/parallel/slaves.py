# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes of a contact on one rank."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.parallel.halo import Halo
from contactx.surface import FacetList


class SlaveNodes:
    """Slave nodes that a rank owns, and those of others that share a facet with them.

    State, pairs and laws are those of owned nodes alone.

    Attributes:
        facets: Slave facets around the owned slave nodes.
        owned: Owned slave nodes in order, shape (n,).
        around: All slave nodes of the facets in order, the owned ones first, shape (m,).
    """

    def __init__(self, halo: Halo, facets: FacetList):
        """Find the nodes.

        Args:
            halo: Nodes of this rank.
            facets: Slave facets around its own slave nodes.
        """
        self._halo = halo
        self.facets = facets
        self.around: npt.NDArray[np.int32] = np.unique(facets.nodes)
        self.owned = self.around[self.around < halo.num_owned]

    def scatter_forward(self, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Give all slave nodes the values that their owners have; all ranks must take part.

        Args:
            values: Values at owned slave nodes, shape (n,) or (n, k).

        Returns:
            Values, shape (m,) or (m, k).
        """
        if self._halo.comm.size == 1:
            return values
        everywhere = np.zeros((self._halo.num_owned, *values.shape[1:]), dtype=values.dtype)
        everywhere[self.owned] = values
        return self._halo.scatter_forward(everywhere)[self.around]
