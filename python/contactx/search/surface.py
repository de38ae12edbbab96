# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces that are searched, with the names that Python has for facets."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int32]


class MasterSurface:
    """Facets of a master surface, as the slave nodes of a rank see them; see the core.

    Attributes:
        surface: The same in the core.
        own: Facets of this rank.
        around: Those and all that share a node with them.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Take the facets; all ranks must take part.

        Args:
            halo: Nodes of this rank.
            own: Facets of the surface that this rank has.
        """
        self.surface = core.MasterSurface(halo.nodes, own.offsets, own.nodes)
        self.own = FacetList(*self.surface.own)
        self.around = FacetList(*self.surface.around)
        self._facets, self._version = FacetList(*self.surface.facets), self.surface.version

    @property
    def facets(self) -> FacetList:
        """Facets that pairs are with; the same object until they change."""
        if self._version != self.surface.version:
            self._facets, self._version = FacetList(*self.surface.facets), self.surface.version
        return self._facets

    def find(self, x: Array, points: Array, normals: Array, reach: float) -> core.Found:
        """Search for points; all ranks must take part, and the halo and ``facets`` may grow."""
        return self.surface.find(x, points, normals, reach)

    def pair(
        self,
        pairing: core.Pairing,
        slave: FacetList,
        x: Array,
        reach: float,
        closed: npt.NDArray[np.int8],
    ) -> int:
        """Pair slave nodes; returns how many in contact changed their facet."""
        return self.surface.pair(pairing, slave.offsets, slave.nodes, x, reach, closed)

    def look(self, x: Array, slave: FacetList, reach: float, margin: float) -> None:
        """Add to ``facets`` all that are in front of slave facets; all ranks must take part."""
        self.surface.look(x, slave.offsets, slave.nodes, reach, margin)

    def keep(self, used: npt.NDArray[np.integer]) -> Index:
        """Keep some facets and drop the others, once the halo has shrunk; returns their numbers."""
        return self.surface.keep(np.ascontiguousarray(used, dtype=np.int32))

    def distance(self, x: Array, points: Array) -> float:
        """Distance from the nearest of some points; all ranks must take part."""
        return self.surface.distance(x, points)

    def mean(self, nodal: Array) -> float:
        """Mean of nodal values over the nodes of all facets; all ranks must take part."""
        return self.surface.mean(nodal)

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """Arrays that tell this surface from another one: the names of this rank's facets."""
        return self.surface.identity()

    def names(self, which: Index) -> npt.NDArray[np.int64]:
        """Original numbers of the nodes of facets, -1 where there is none, shape (n, 4)."""
        return self.surface.names(which)

    def named(self, names: npt.NDArray[np.int64]) -> Index:
        """Facets by what ``names`` gave; all ranks must take part."""
        return self.surface.named(names)


def onlooker(halo: Halo, facets: FacetList) -> core.Onlooker:
    """Looks at a surface, of which each rank may have a part."""
    return core.Onlooker(halo.nodes, facets.offsets, facets.nodes)


def outside(halo: Halo, own: FacetList) -> core.Outside:
    """Tells points that penetrate a body from those outside; all ranks must take part."""
    return core.Outside(halo.nodes, own.offsets, own.nodes)


def slave_facets(halo: Halo, facets: FacetList) -> FacetList:
    """Facets of a slave surface that this rank needs: all around its own nodes.

    Args:
        halo: Nodes of this rank, to which those of the facets are added for good.
        facets: Facets of the surface that this rank has.
    """
    if halo.comm.size == 1:
        return facets
    return FacetList(*core.slave_facets(halo.nodes, facets.offsets, facets.nodes))


def in_order(facets: FacetList, halo: Halo) -> FacetList:
    """Facets in the order of their original numbers, the same on any number of ranks."""
    return FacetList(*core.in_order(halo.nodes, facets.offsets, facets.nodes))
