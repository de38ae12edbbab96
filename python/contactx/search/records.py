# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets as all ranks know them, and those around the nodes of a rank."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from contactx.parallel.halo import Halo
from contactx.surface import FacetList

type Index = npt.NDArray[np.int64]

_MOST = 4
# Where a facet has fewer nodes
_NONE = np.iinfo(np.int64).max


@dataclass(frozen=True)
class FacetRecords:
    """Facets by numbers that mean the same on all ranks.

    Attributes:
        numbers: Global numbers of their nodes, in order, shape (m, 4).
        owners: Ranks that own these nodes, shape (m, 4).
        original: Numbers of these nodes in the mesh as it was made, shape (m, 4).
    """

    numbers: Index
    owners: Index
    original: Index

    @staticmethod
    def of(facets: FacetList, halo: Halo) -> FacetRecords:
        """Records of facets whose nodes are on this rank."""
        m = len(facets.offsets) - 1
        numbers, owners, original = (np.full((m, _MOST), _NONE, dtype=np.int64) for _ in range(3))
        for which, nodes in facets.groups():
            width = nodes.shape[1]
            numbers[which, :width] = halo.numbers(nodes)
            owners[which, :width] = halo.owners(nodes)
            original[which, :width] = halo.original[nodes]
        return FacetRecords(numbers, owners, original)

    @staticmethod
    def joined(parts: list[FacetRecords]) -> FacetRecords:
        """All of several, each facet once, in the order of their original numbers."""
        tables = [np.concatenate([vars(part)[name] for part in parts]) for name in _NAMES]
        every = FacetRecords(*tables)
        first = np.unique(every.key, axis=0, return_index=True)[1]
        return every.select(first)

    @staticmethod
    def none() -> FacetRecords:
        """No facets."""
        return FacetRecords(*(np.zeros((0, _MOST), dtype=np.int64) for _ in _NAMES))

    def __len__(self) -> int:
        """Number of facets."""
        return len(self.numbers)

    @property
    def key(self) -> Index:
        """What tells facets apart, and orders them alike on any number of ranks, shape (m, 3)."""
        return np.sort(self.original, axis=1)[:, :3]

    def select(self, which: npt.NDArray[np.integer] | npt.NDArray[np.bool_]) -> FacetRecords:
        """Some of the facets."""
        return FacetRecords(self.numbers[which], self.owners[which], self.original[which])

    def add_to(self, halo: Halo, *, for_good: bool = False) -> None:
        """Add the facets' nodes to the halo; all ranks must take part."""
        used = self.numbers != _NONE
        halo.grow(self.numbers[used], self.owners[used].astype(np.int32), for_good=for_good)

    def here(self, halo: Halo) -> FacetList:
        """The facets with the numbers of this rank, whose halo must have their nodes."""
        used = self.numbers != _NONE
        offsets = np.concatenate([[0], np.cumsum(used.sum(axis=1))]).astype(np.int32)
        return FacetList(offsets, halo.find(self.numbers[used]))


_NAMES = tuple(FacetRecords.__dataclass_fields__)


def around_nodes(halo: Halo, facets: FacetRecords) -> dict[int, FacetRecords]:
    """Facets at the nodes that this rank owns, by the rank that has them.

    Args:
        halo: Nodes of this rank.
        facets: Facets that this rank has.
    """
    out = {}
    for rank in np.unique(facets.owners[facets.numbers != _NONE]).tolist():
        out[rank] = facets.select((facets.owners == rank).any(axis=1))
    return dict(halo.exchange(out))


def around_facets(
    halo: Halo, facets: FacetRecords, at_nodes: dict[int, FacetRecords]
) -> FacetRecords:
    """Facets that share a node with those of this rank, which are among them.

    Args:
        halo: Nodes of this rank.
        facets: Facets that this rank has.
        at_nodes: What ``around_nodes`` gave for them.
    """
    every = FacetRecords.joined([FacetRecords.none(), *at_nodes.values()])
    out = {}
    for rank, theirs in at_nodes.items():
        nodes = np.unique(theirs.numbers[theirs.owners == halo.comm.rank])
        out[rank] = every.select(np.isin(every.numbers, nodes).any(axis=1))
    found = halo.exchange(out)
    return FacetRecords.joined([facets, *found.values()])


def slave_facets(halo: Halo, facets: FacetList) -> FacetList:
    """Facets of a slave surface that this rank needs: all around its own nodes.

    Args:
        halo: Nodes of this rank, to which those of the facets are added for good.
        facets: Facets of the surface that this rank has.
    """
    if halo.comm.size == 1:
        return facets
    found = around_nodes(halo, FacetRecords.of(facets, halo))
    every = FacetRecords.joined([FacetRecords.none(), *found.values()])
    every.add_to(halo, for_good=True)
    return every.here(halo)
