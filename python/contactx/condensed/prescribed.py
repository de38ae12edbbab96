# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Multipliers that follow from their own rows of the law."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.condensed.blocks import (
    Array,
    ContactBlocks,
    Entries,
    Index,
    NotCondensable,
    entries_of,
    joined,
    multiplied,
)
from contactx.interface import Interface


class Prescribed:
    """Takes multipliers p that follow from their own rows of the law out of the contact blocks.

    The bulk has no row that gives those along prescribed displacements, as where a plane of
    symmetry holds a slave node and there is no friction across it; those of soft contact are the
    forces of springs. With the law's derivatives D by
    the multipliers of a node, C by the displacements and the traction block T, and G = D_pp^-1,

        l_p = G (d - C u - D_pf l_f)

    goes into the other rows: C - D G C, D - D G D and T - T G D take the place of C, D and T, and
    -T G C is added to the stiffness.

    All of it is of one rank alone: its slave nodes' constraints, in all nodes' displacements.

    Attributes:
        blocks: Contact blocks without these multipliers.
        by_multiplier: The law's derivatives D without them, one array (n, k, k) a contact.
        own: Whether each multiplier follows from a row of the bulk, one array (n, k) a contact.
        springs: What these multipliers add to the stiffness, entries (dof, dof).
    """

    def __init__(
        self, interfaces: Sequence[Interface], blocks: ContactBlocks, free: Array, gdim: int
    ):
        """Take them out.

        Args:
            interfaces: Discrete sides of the contacts.
            blocks: Contact blocks of the Jacobian.
            free: 1 at displacements that are not prescribed, else 0, shape (num_local,).
            gdim: Geometric dimension.

        Raises:
            NotCondensable: Where the law does not give such a multiplier.
        """
        self.blocks = blocks
        self.own = []
        self.by_multiplier = []
        self._places: list[Index] = []
        self._D: list[Array] = []
        self._G: list[Array] = []
        first = 0
        for interface in interfaces:
            by, own = self._node_by_node(interface, first, free, gdim)
            self.by_multiplier.append(by)
            self.own.append(own)
            first += own.size
        self._size = first
        self._num_local = len(free)
        self.springs = Entries(np.zeros(0, int), np.zeros(0, int), np.zeros(0))
        if self._places:
            self._take_out()

    def _node_by_node(
        self, interface: Interface, first: int, free: Array, gdim: int
    ) -> tuple[Array, npt.NDArray[np.bool_]]:
        nodes = interface.nodes
        n, size = len(nodes.area), nodes.size
        by, own = nodes.by_multiplier, np.ones((n, size), dtype=bool)
        if size == gdim:
            dofs = interface.slaves[:, None] * gdim + np.arange(gdim)
            own = (free[dofs] == 1) | ~nodes.closed[:, None]
        elif nodes.softness > 0:
            own = ~nodes.closed[:, None]
        some = np.flatnonzero(~own.all(axis=1))
        if len(some) == 0:
            return by, own
        D, inside = by[some], own[some]
        # D_pp, and ones elsewhere on the diagonal
        both = ~(inside[:, :, None] | inside[:, None, :])
        area = nodes.area[some, None, None]
        block = np.where(both, D / area, 0) + inside[:, :, None] * np.eye(size)
        if np.any(np.abs(np.linalg.det(block)) < 1e-8):
            raise NotCondensable("a slave node with a prescribed displacement moves its master")
        G = np.where(both, np.linalg.inv(block) / area, 0)
        self._places.append(first + some[:, None] * size + np.arange(size))
        self._D.append(D)
        self._G.append(G)
        by = by.copy()
        by[some] = np.where(inside[:, None, :], D - D @ G @ D, 0)
        return by, own

    def _take_out(self) -> None:
        self._at = np.concatenate(self._places)
        D, G = np.concatenate(self._D), np.concatenate(self._G)
        size = self._size
        shape = (size, size)
        self._law = self._nodal(D).matrix(shape)
        self._inverse = self._nodal(G).matrix(shape)
        rows = self._nodal(-D @ G, one=True).matrix(shape)
        columns = self._nodal(-G @ D, one=True).matrix(shape)
        C = self.blocks.constraint.matrix((size, self._num_local))
        T = self.blocks.traction.matrix((self._num_local, size))
        stiffness = entries_of(T.matMult(self._inverse).matMult(C))
        self.springs = stiffness.scaled(-1.0)
        self.blocks = ContactBlocks(
            stiffness=joined([self.blocks.stiffness, self.springs]),
            traction=entries_of(T.matMult(columns)),
            constraint=entries_of(rows.matMult(C)),
        )
        self._T, self._C, self._L = T, C, rows

    def _nodal(self, blocks: Array, *, one: bool = False) -> Entries:
        """Block diagonal matrix of the nodes concerned, one elsewhere where asked for."""
        k = blocks.shape[1]
        rows, columns = np.repeat(self._at, k, axis=1), np.tile(self._at, (1, k))
        part = Entries(rows.ravel(), columns.ravel(), blocks.ravel())
        every = np.arange(self._size if one else 0)
        return joined([part, Entries(every, every, np.ones(len(every)))])

    def right_hand_side(self, d: Array) -> tuple[Array, Array]:
        """What these multipliers change in the right-hand sides.

        Args:
            d: Right-hand side of the multipliers' rows, shape (num_multipliers,).

        Returns:
            What is added to that of all nodes' displacements, shape (num_local,), and that of the
            multipliers' rows without them.
        """
        if not self._places:
            return np.zeros(self._num_local), d
        return -multiplied(self._T, multiplied(self._inverse, d)), multiplied(self._L, d)

    def recover(self, d: Array, u: Array, multipliers: Array) -> None:
        """Add these multipliers.

        Args:
            d: Right-hand side of the multipliers' rows, shape (num_multipliers,).
            u: Displacements of all nodes, shape (num_local,).
            multipliers: The others, zero where these are to go, shape (num_multipliers,).
        """
        if self._places:
            left = d - multiplied(self._C, u) - multiplied(self._law, multipliers)
            multipliers += multiplied(self._inverse, left)
