# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets of a master surface, as the slave nodes of a rank see them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import total
from contactx.search.records import FacetRecords
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int32]


@dataclass(frozen=True)
class Found:
    """What a search finds for points.

    Attributes:
        distance: Distance to the nearest facet that faces a point, infinite without one,
            shape (n,).
        facet: Facet that contact is measured with, -1 without one, shape (n,).
        feature: Its feature that the point is on, shape (n,).
        gap: Gap, shape (n,).
        xi: Local coordinates of the projection, shape (n, 2).
        normal: Unit normal, shape (n, 3).
    """

    distance: Array
    facet: Index
    feature: Index
    gap: Array
    xi: Array
    normal: Array


class MasterSurface:
    """Facets of a master surface on one rank: all of them.

    Attributes:
        facets: Facets that pairs are with.
        own: Facets of this rank.
        around: Those and all that share a node with them.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Take the facets.

        Args:
            halo: Nodes of this rank.
            own: Facets of the surface that this rank has.
        """
        self._halo = halo
        self.own = self.facets = self.around = own
        self._finder = core.Finder(own.offsets, own.nodes, halo.gdim)

    def find(self, x: Array, points: Array, normals: Array, reach: float) -> Found:
        """Search for points; all ranks must take part.

        The halo and ``facets`` may grow.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            points: Points, shape (n, gdim).
            normals: Outward normals there; zero accepts facets of any normal, shape (n, gdim).
            reach: Largest distance.
        """
        found = self._finder.find(x, points, normals, np.full(len(points), reach))
        return Found(**{name: found[name] for name in Found.__dataclass_fields__})

    def pair(
        self,
        pairing: core.Pairing,
        slave: FacetList,
        x: Array,
        reach: float,
        closed: npt.NDArray[np.int8],
    ) -> int:
        """Pair slave nodes; all ranks must take part.

        Args:
            pairing: Pairs, which are updated.
            slave: Facets around the slave nodes.
            x: Positions of all nodes, shape (num_nodes, gdim).
            reach: Largest distance of a pair.
            closed: Whether slave nodes are in contact, shape (n,).

        Returns:
            Number of this rank's nodes in contact that changed their facet.
        """
        return pairing.update(x, reach, closed)

    def look(self, x: Array, slave: FacetList, reach: float, margin: float) -> None:
        """Add to ``facets`` all that are in front of slave facets; all ranks must take part.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            slave: Slave facets.
            reach: Largest distance.
            margin: By which part slave facets are enlarged.
        """

    def keep(self, used: Index) -> Index:
        """Keep some facets and drop the others, once the halo has shrunk; all ranks must take part.

        Args:
            used: Facets to keep, -1 for none.

        Returns:
            Their new numbers, shape (n,).
        """
        return used

    def distance(self, x: Array, points: Array) -> float:
        """Distance from the nearest of some points; all ranks must take part.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            points: Points, shape (n, gdim).
        """
        found = self.find(x, points, np.zeros_like(points), np.inf)
        return float(found.distance.min(initial=np.inf))

    def mean(self, nodal: Array) -> float:
        """Mean of nodal values over the nodes of all facets; all ranks must take part.

        Args:
            nodal: Values at all nodes, shape (num_nodes,).
        """
        values = nodal[self.own.nodes]
        sum_, count = total(self._halo.comm, np.array([values.sum(), len(values)]))
        return float(sum_ / count)

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """Arrays that tell this surface from another one: the names of this rank's facets."""
        m = len(self.own.offsets) - 1
        names = np.full((m, 4), -1, dtype=np.int64)
        for which, nodes in self.own.groups():
            names[which, : nodes.shape[1]] = self._halo.original[nodes]
        return {"facets": names}

    def names(self, which: Index) -> npt.NDArray[np.int64]:
        """Original numbers of the nodes of facets, -1 where there is none, shape (n, 4)."""
        names = np.full((len(which), 4), -1, dtype=np.int64)
        sizes = np.diff(self.facets.offsets)
        for k in range(int(sizes.max(initial=0))):
            has = np.flatnonzero(which >= 0)
            has = has[sizes[which[has]] > k]
            nodes = self.facets.nodes[self.facets.offsets[which[has]] + k]
            names[has, k] = self._halo.original[nodes]
        return names

    def named(self, names: npt.NDArray[np.int64]) -> Index:
        """Facets by what ``names`` gave; all ranks must take part.

        Raises:
            ValueError: If there is no such facet, on all ranks.
        """
        every = np.arange(len(self.facets.offsets) - 1, dtype=np.int32)
        return _numbered(names, self.names(every))


def _numbered(names: npt.NDArray[np.int64], known: npt.NDArray[np.int64]) -> Index:
    """Places of names among known ones, -1 for no name.

    Raises:
        ValueError: If one is not there.
    """
    which = np.full(len(names), -1, dtype=np.int32)
    some = np.flatnonzero((names >= 0).any(axis=1))
    both = np.sort(np.concatenate([known, names[some]]), axis=1)
    _, first, place = np.unique(both, axis=0, return_index=True, return_inverse=True)
    found = first[place.ravel()[len(known) :]]
    if np.any(found >= len(known)):
        raise ValueError("a pair with a facet that does not exist")
    which[some] = found
    return which


def in_order(facets: FacetList, halo: Halo) -> FacetList:
    """Facets in the order of their original numbers, the same on any number of ranks."""
    offsets, nodes = facets.offsets, facets.nodes
    order = np.lexsort(FacetRecords.of(facets, halo).key.T[::-1])
    sizes = np.diff(offsets)[order]
    first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    place = np.repeat(offsets[:-1][order] - first[:-1], sizes) + np.arange(first[-1])
    return FacetList(first, nodes[place])
