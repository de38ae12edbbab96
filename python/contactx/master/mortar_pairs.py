# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pairs of facets with their integrals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from contactx.forms import Pairs
from contactx.parallel.slaves import SlaveNodes
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int32]


@dataclass(frozen=True)
class Mortar:
    """Pairs of facets with their integrals.

    Attributes:
        slave: Slave facet of each pair, shape (num_pairs,).
        master: Its master facet, shape (num_pairs,).
        weight: Integrals of the dual functions with the master's shape functions, shape
            (num_pairs, 4, 4).
        gap: Integrals with the gap along the slave facet's normal, shape (num_pairs, 4).
    """

    slave: Index
    master: Index
    weight: Array
    gap: Array

    def scaled(self, factor: Array) -> Mortar:
        """With rows multiplied by factors, shape (num_pairs, 4)."""
        return Mortar(self.slave, self.master, self.weight * factor[:, :, None], self.gap * factor)

    def joined(self, other: Mortar) -> Mortar:
        """With the pairs of another one, of both those that have any weight."""
        both = [(part, part.weight.any(axis=(1, 2))) for part in (self, other)]
        return Mortar(
            *(
                np.concatenate([getattr(part, name)[used] for part, used in both])
                for name in ("slave", "master", "weight", "gap")
            )
        )


class Sides:
    """Facets of a slave and a master surface as arrays of four nodes.

    Triangles and segments repeat their last node; their integrals are zero there.

    Attributes:
        slaves: Slave nodes of this rank in order, shape (n,).
        around: All slave nodes in order, those of other ranks last, shape (m,).
        nodes: Nodes of the slave and of the master facets, each of shape (num_facets, 4).
        sizes: Numbers of their nodes, each of shape (num_facets,).
        numbers: Nodes of the slave facets by their place in ``around``, shape (num_facets, 4).
        inradius: Radius of the smallest slave facet's circle inside, about.
    """

    def __init__(self, slave: SlaveNodes, x: Array):
        """Take the slave's side.

        Args:
            slave: Slave nodes.
            x: Reference positions.
        """
        facets = slave.facets
        self.slaves, self.around = slave.owned, slave.around
        none = FacetList(np.zeros(1, dtype=np.int32), np.zeros(0, dtype=np.int32))
        self.nodes = _padded(facets), _padded(none)
        self.sizes = np.diff(facets.offsets), np.diff(none.offsets)
        self.numbers: Index = np.searchsorted(self.around, self.nodes[0]).astype(np.int32)
        corners = x[self.nodes[0]]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        # Twice the area over the perimeter is no less than a third of it over the longest edge
        area = longest**2 if x.shape[1] == 2 else np.linalg.norm(np.cross(first, second), axis=1)
        self.inradius = float((area / longest).min(initial=np.inf) / 3)

    def meet(self, master: FacetList) -> None:
        """Take the master's side."""
        self.nodes = self.nodes[0], _padded(master)
        self.sizes = self.sizes[0], np.diff(master.offsets)

    def at_corners(self, values: Array, facets: Index | slice = slice(None)) -> Array:
        """Values of slave nodes at the corners of their facets, zero at nodes of other ranks.

        Args:
            values: Values, shape (n,).
            facets: The facets, shape (m,); all of them by default.

        Returns:
            Values, shape (m, 4).
        """
        every = np.concatenate([values, np.zeros(len(self.around) - len(values))])
        return every[self.numbers[facets]]

    def total(self, values: Array, facets: Index | slice = slice(None)) -> Array:
        """Sums over the facets of each slave node.

        Args:
            values: Values at the nodes of slave facets, shape (m, 4).
            facets: The facets, shape (m,); all of them by default.

        Returns:
            Sums, shape (n,).
        """
        total = np.bincount(self.numbers[facets].ravel(), values.ravel(), len(self.around))
        # Of no values at all NumPy makes integers
        return total[: len(self.slaves)].astype(np.float64)

    def pairs(
        self, mortar: Mortar, dual: Array, normal: Array, *, is_movement: bool = False
    ) -> list[Pairs]:
        """Pairs with what the kernels read, by the kinds of both facets.

        Args:
            mortar: Pairs with their integrals.
            dual: Coefficients of the dual functions of the slave facets, shape (num_facets, 4, 4).
            normal: Their normals, those of the master, shape (num_facets, 3).
            is_movement: Whether they measure slip alone.
        """
        kind = 5 * self.sizes[0][mortar.slave] + self.sizes[1][mortar.master]
        groups = []
        for one in np.unique(kind):
            some = np.flatnonzero(kind == one)
            n, m = divmod(int(one), 5)
            e, f = mortar.slave[some], mortar.master[some]
            parts = [mortar.weight[some, :n, :m], dual[e, :n, :n], mortar.gap[some, :n], normal[e]]
            data = np.concatenate([part.reshape(len(some), -1) for part in parts], axis=1)
            nodes = np.concatenate([self.nodes[0][e, :n], self.nodes[1][f, :m]], axis=1)
            groups.append(Pairs(self.numbers[e, :n], nodes, data, is_movement=is_movement))
        return groups

    def frames(self, x: Array) -> Array:
        """Unit normal and directions along one facet of each slave node, in columns.

        Args:
            x: Positions.

        Returns:
            Frames, shape (n, gdim, gdim).
        """
        facet = np.zeros(len(self.around), dtype=np.int64)
        facet[self.numbers] = np.arange(len(self.numbers))[:, None]
        corners = x[self.nodes[0][facet[: len(self.slaves)]]]
        along = corners[:, 1] - corners[:, 0]
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        if x.shape[1] == 2:
            normal = np.column_stack([along[:, 1], -along[:, 0]])
            return np.stack([normal, along], axis=2)
        normal = np.cross(along, corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.stack([normal, along, np.cross(normal, along)], axis=2)

    def between(self, x: Array, slave: Index, master: Index, weight: Array, normal: Array) -> Array:
        """Normals midway between those of each slave facet and its master, shape (num_facets, 3).

        Small sliding keeps the normals of the reference, and two surfaces that are pressed
        together meet midway.

        Args:
            x: Positions.
            slave: Slave facet of each pair, shape (num_pairs,).
            master: Its master facet, shape (num_pairs,).
            weight: Integrals of the pairs, shape (num_pairs, 4, 4).
            normal: Normals of the slave facets, those of the master, shape (num_facets, 3).
        """
        share = weight.sum(axis=(1, 2))
        mean = np.zeros_like(normal)
        np.add.at(mean, slave, share[:, None] * self._master_normals(x, master))
        return unit(normal + unit(mean))

    def _master_normals(self, x: Array, facets: Index) -> Array:
        """Unit normals at the middle of some master facets, shape (m, 3)."""
        corners = x[self.nodes[1][facets]]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        if x.shape[1] == 2:
            normal = np.stack([first[:, 1], -first[:, 0], np.zeros(len(first))], axis=1)
        else:
            # The diagonals of a quadrilateral, whose last node is opposite to its first
            diagonals = np.cross(corners[:, 3] - corners[:, 0], corners[:, 2] - corners[:, 1])
            is_quadrilateral = self.sizes[1][facets, None] == 4
            normal = np.where(is_quadrilateral, diagonals, np.cross(first, second))
        return unit(normal)


def unit(vectors: Array) -> Array:
    """Vectors of unit length; zero stays zero."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def _padded(facets: FacetList) -> Index:
    size = np.diff(facets.offsets)
    place = np.minimum(np.arange(4), size[:, None] - 1)
    nodes: Index = facets.nodes[facets.offsets[:-1, None] + place]
    return nodes
