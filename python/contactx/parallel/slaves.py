# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes of a contact on one rank."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.search.surface import slave_facets
from contactx.surface import FacetList


class SlaveNodes:
    """Slave nodes that a rank owns, and those of others that share a facet with them.

    State, pairs and laws are those of owned nodes alone.

    Attributes:
        facets: Slave facets around the owned slave nodes.
        own: Slave facets of this rank's cells, each on one rank alone.
        owned: Owned slave nodes in order, shape (n,).
        around: All slave nodes of the facets in order, the owned ones first, shape (m,).
        corners: Nodes of the facets by their places among those.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Find the nodes; all ranks must take part.

        Args:
            halo: Nodes of this rank, to which those of facets around its own are added for good.
            own: Slave facets of this rank's cells.
        """
        self._halo, self.own = halo, own
        self.facets = facets = slave_facets(halo, own)
        self.around: npt.NDArray[np.int32] = np.unique(facets.nodes)
        self.owned = self.around[self.around < halo.num_owned]
        self.corners: npt.NDArray[np.int32] = np.searchsorted(self.around, facets.nodes).astype(
            np.int32
        )

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

    def facing(
        self, x: npt.NDArray[np.float64], normal: npt.NDArray[np.float64]
    ) -> npt.NDArray[np.bool_]:
        """Which owned slave nodes face a master.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            normal: Unit normals of the master at the owned slave nodes, shape (n, gdim).

        Returns:
            Which ones, shape (n,).
        """
        offsets, gdim = self.facets.offsets, x.shape[1]
        every = self._padded(normal, gdim)
        faces = core.facing_nodes(offsets, self.corners, x[self.around], every, gdim)
        which: npt.NDArray[np.bool_] = faces[: len(self.owned)] > 0
        return which

    def facing_areas(
        self,
        reference: npt.NDArray[np.float64],
        x: npt.NDArray[np.float64],
        normal: npt.NDArray[np.float64],
    ) -> npt.NDArray[np.float64]:
        """Reference areas of the corners of the facets that face a master, else zero.

        Those of nodes of other ranks count as if all faced it.

        Args:
            reference: Reference positions of all nodes, shape (num_nodes, gdim).
            x: Positions of all nodes, shape (num_nodes, gdim).
            normal: Unit normals of the master at the owned slave nodes, or zero, shape (n, gdim).

        Returns:
            Areas, in the order of the facets' nodes.
        """
        offsets, around, gdim = self.facets.offsets, self.around, x.shape[1]
        every = self._padded(normal, gdim)
        return core.facing_areas(offsets, self.corners, reference[around], x[around], every, gdim)

    def of_facets(
        self, values: npt.NDArray[Any], function: np.ufunc = np.maximum
    ) -> npt.NDArray[Any]:
        """Largest value of each facet's nodes, or what another function makes of them.

        Args:
            values: Values at all slave nodes, shape (m,).
            function: Reduces them.

        Returns:
            Values, shape (num_facets,).
        """
        result: npt.NDArray[Any] = values[self.corners]
        if len(result) > 0:
            result = function.reduceat(result, self.facets.offsets[:-1])
        return result

    def near(self, which: npt.NDArray[np.bool_]) -> npt.NDArray[np.int8]:
        """How near facets are to some nodes; all ranks must take part.

        Args:
            which: Which owned slave nodes, shape (n,).

        Returns:
            2 where a node of the facet is among them, 1 where one of a neighbour is, else 0, shape
            (num_facets,).
        """
        own = self.of_facets(self.scatter_forward(which))
        sizes = np.diff(self.facets.offsets)
        around = np.bincount(self.corners, np.repeat(own, sizes), len(self.around)) > 0
        beside = self.of_facets(self.scatter_forward(around[: len(self.owned)]))
        level: npt.NDArray[np.int8] = own.astype(np.int8) + beside
        return level

    def sums(self, corners: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Sums at the owned slave nodes of what is given at the corners of the facets, (n,)."""
        sums = np.bincount(self.corners, corners, len(self.around))[: len(self.owned)]
        return sums.astype(np.float64)

    def _padded(self, normal: npt.NDArray[np.float64], gdim: int) -> npt.NDArray[np.float64]:
        every = np.zeros((len(self.around), gdim))
        every[: len(self.owned)] = normal
        return every
