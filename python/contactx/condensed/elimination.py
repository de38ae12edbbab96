# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which displacements and equations the multipliers are eliminated with."""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.condensed.blocks import Array, Entries, Index, NotCondensable, joined
from contactx.condensed.prescribed import Prescribed
from contactx.interface import Interface


class Elimination:
    """Transforms that take the multipliers out of J (du, dl) = (b, d).

    A multiplier follows from its slave node's own rows, T_s dl = b_s - K_s du, as the slave side is
    diagonal. What it does to other rows is taken over by ``left``; a constraint without the
    multiplier gives a displacement of the slave node, du = (I + right) v + shift, and where it
    slips the tangential rows are those of the law: with tangential vectors tau_i the row of the
    displacement i becomes tau_i (C_l A^-1 K_s + C_u), the natural one for no friction.

    All of it is of one rank alone: its slave nodes, in the numbers of all nodes' displacements on
    the rank, those of its own nodes first.

    Attributes:
        left: Change of the rows' combinations, entries (dof, dof).
        right: Change of the displacements, entries (dof, dof).
        law: Rows of the law that are added, entries (dof, dof).
        eliminated: Displacements that the constraints give, in order, shape (k,).
        recovered: Displacements whose rows give multipliers, shape (m,).
        slave_dofs: Displacements of all slave nodes, in order.
        slips: Whether a node slips with friction.
    """

    def __init__(
        self, interfaces: Sequence[Interface], contact: Prescribed, free: Array, gdim: int
    ):
        """Find the transforms.

        Args:
            interfaces: Discrete sides of the contacts.
            contact: Contact blocks of the Jacobian, without multipliers that the bulk cannot give.
            free: 1 at displacements that are not prescribed, else 0, shape (num_local,).
            gdim: Geometric dimension.

        Raises:
            NotCondensable: Where a multiplier has no equation of its own.
        """
        self._blocks = contact.blocks
        self._free = free
        self._gdim = gdim
        self._left: list[Entries] = []
        self._right: list[Entries] = []
        self._law: list[Entries] = []
        # Of each pivot: the displacement, its multiplier's row and the factors of rows of d
        self._pivots: list[tuple[Index, Entries]] = []
        self._extra: list[Entries] = []
        self._recover: list[tuple[Index, Index, Array]] = []
        self._open: list[tuple[Index, Array]] = []
        self.slips = False
        slaves = np.unique(np.concatenate([i.slaves for i in interfaces]))
        self.slave_dofs = (slaves[:, None] * gdim + np.arange(gdim)).ravel().astype(PETSc.IntType)
        first = 0
        for k, interface in enumerate(interfaces):
            self._add(interface, first, contact.by_multiplier[k], contact.own[k])
            first += len(interface.nodes.multiplier)
        self.num_multipliers = first
        self.left, self.right, self.law = (
            joined(parts or [_none()]) for parts in (self._left, self._right, self._law)
        )
        self.eliminated = np.sort(_all_of([dofs for dofs, _ in self._pivots]))
        self.recovered = _all_of([rows for _, rows, _ in self._recover])
        if len(np.unique(self.recovered)) < len(self.recovered):
            raise NotCondensable("a node is slave in several contacts that are closed")

    def _add(self, interface: Interface, first: int, by: Array, own: npt.NDArray[np.bool_]) -> None:
        nodes = interface.nodes
        n = len(nodes.area)
        multipliers = first + np.arange(n * nodes.size).reshape(n, nodes.size)
        closed = nodes.closed
        diagonal = np.einsum("nii->ni", nodes.by_multiplier)[~closed]
        self._open.append((multipliers[~closed].ravel(), diagonal.ravel()))
        slaves = interface.slaves
        if nodes.size == 1:
            closed = closed & own[:, 0]
            self._add_scalar(slaves[closed], multipliers[closed, 0])
            return
        dofs = slaves[:, None] * self._gdim + np.arange(self._gdim)
        constrained = closed[:, None] & own
        self._add_forces(dofs[constrained], multipliers[constrained])
        stick = nodes.status == core.STICK
        slip = nodes.status == core.SLIP
        self._add_stick(dofs[stick], multipliers[stick], own[stick])
        if slip.any():
            self.slips = True
            by = by[slip] / nodes.area[slip, None, None]
            self._add_slip(dofs[slip], multipliers[slip], nodes.normal[slip], by, own[slip])

    def _add_scalar(self, slaves: Index, multipliers: Index) -> None:
        """Frictionless nodes: the pressure follows from one row of the slave node."""
        if len(slaves) == 0:
            return
        C, T = self._rows_of(multipliers), self._columns_of(multipliers)
        dofs = slaves[:, None] * self._gdim + np.arange(self._gdim)
        # Coefficients of the slave node's displacements in its constraint
        own = np.zeros((len(slaves), self._gdim))
        component = C.columns - dofs[C.rows, 0]
        mine = (component >= 0) & (component < self._gdim)
        np.add.at(own, (C.rows[mine], component[mine]), C.values[mine])
        k = np.argmax(np.abs(own) * self._free[dofs], axis=1)
        pivot = dofs[np.arange(len(slaves)), k]
        factor = own[np.arange(len(slaves)), k] * self._free[pivot]
        if np.any(factor == 0):
            raise NotCondensable("all displacements of a slave node are prescribed")
        self._eliminate(pivot, C, factor)
        self._pivots.append((pivot, Entries(np.arange(len(pivot)), multipliers, 1 / factor)))
        t = np.zeros(len(slaves))
        at = T.rows == pivot[T.columns]
        np.add.at(t, T.columns[at], T.values[at])
        self._left.append(Entries(T.rows, pivot[T.columns], -T.values / t[T.columns]).select(~at))
        self._recover.append((multipliers, pivot, t))

    def _add_forces(self, rows: Index, multipliers: Index) -> None:
        """Vector multipliers: master rows take over the slave nodes' rows."""
        T = self._columns_of(multipliers)
        own = T.rows == rows[T.columns]
        factor = np.zeros(len(multipliers))
        np.add.at(factor, T.columns[own], T.values[own])
        self._left.append(
            Entries(T.rows, rows[T.columns], -T.values / factor[T.columns]).select(~own)
        )
        self._recover.append((multipliers, rows, factor))

    def _add_stick(self, dofs: Index, multipliers: Index, own: npt.NDArray[np.bool_]) -> None:
        """Sticking and tied nodes: the constraints give the displacements of the slave node."""
        if len(dofs) == 0:
            return
        g = self._gdim
        C = self._rows_of(multipliers.ravel())
        node, component = C.rows // g, C.columns - dofs[C.rows // g, 0]
        mine = (component >= 0) & (component < g)
        block = ~own[:, :, None] * np.eye(g)
        np.add.at(block, (node[mine], C.rows[mine] % g, component[mine]), C.values[mine])
        inverse = np.linalg.inv(block)
        other = C.select(~mine)
        k = other.rows // g
        for i in range(g):
            factor = inverse[k, i, other.rows % g]
            part = Entries(dofs[k, i], other.columns, -factor * other.values)
            self._right.append(part.select(own[k, i]))
        flat = dofs[own]
        self._right.append(Entries(flat, flat, np.full(len(flat), -1.0)))
        place = np.repeat(np.arange(len(flat)), g)
        columns = np.repeat(multipliers, g, axis=0)[own.ravel()].ravel()
        self._pivots.append((flat, Entries(place, columns, inverse[own].ravel())))

    def _add_slip(
        self,
        dofs: Index,
        multipliers: Index,
        normal: Array,
        by: Array,
        own: npt.NDArray[np.bool_],
    ) -> None:
        """Slipping nodes: the normal row gives a displacement, the others are the law's."""
        g = self._gdim
        n = len(dofs)
        every = np.arange(n)
        C = self._rows_of(multipliers.ravel())
        node = C.rows // g
        along = Entries(node, C.columns, normal[node, C.rows % g] * C.values)
        k = np.argmax(np.abs(normal) * own, axis=1)
        pivot = dofs[every, k]
        factor = np.zeros(n)
        at = along.columns == pivot[along.rows]
        np.add.at(factor, along.rows[at], along.values[at])
        if np.any(factor == 0):
            raise NotCondensable("all displacements of a slave node are prescribed")
        self._eliminate(pivot, along, factor)
        weights = (normal / factor[:, None]).ravel()
        self._pivots.append((pivot, Entries(np.repeat(every, g), multipliers.ravel(), weights)))
        for step in range(1, g):
            i = (k + step) % g
            free = own[every, i]
            row = dofs[every, i]
            tau = np.zeros((n, g))
            tau[every, i] = 1
            tau[every, k] = -normal[every, i] / normal[every, k]
            # by is C_l / A
            combination = np.einsum("ni,nij->nj", tau, by)
            combination[every, i] -= 1
            combined = Entries(np.repeat(row, g), dofs.ravel(), combination.ravel())
            self._left.append(combined.select((free[:, None] & own).ravel()))
            law = Entries(row[node], C.columns, tau[node, C.rows % g] * C.values)
            self._law.append(law.select(free[node]))
            extra = Entries(np.repeat(row, g), multipliers.ravel(), tau.ravel())
            self._extra.append(extra.select(np.repeat(free, g)))

    def _eliminate(self, pivot: Index, C: Entries, factor: Array) -> None:
        self._right.append(Entries(pivot[C.rows], C.columns, -C.values / factor[C.rows]))

    def _rows_of(self, multipliers: Index) -> Entries:
        """Rows of the constraint block, numbered by their place in ``multipliers``."""
        C = self._blocks.constraint
        place = self._place(multipliers)
        part = C.select(place[C.rows] >= 0)
        part.rows = place[part.rows]
        return part

    def _columns_of(self, multipliers: Index) -> Entries:
        T = self._blocks.traction
        place = self._place(multipliers)
        part = T.select(place[T.columns] >= 0)
        part.columns = place[part.columns]
        return part

    def _place(self, multipliers: Index) -> Index:
        size = 1 + max(
            multipliers.max(initial=-1),
            self._blocks.constraint.rows.max(initial=-1),
            self._blocks.traction.columns.max(initial=-1),
        )
        place = np.full(size, -1)
        place[multipliers] = np.arange(len(multipliers))
        return place

    def shift(self, d: Array) -> Array:
        """What the constraints' right-hand side gives of displacements, shape (num_local,)."""
        shift = np.zeros(len(self._free))
        for dofs, factors in self._pivots:
            np.add.at(shift, dofs[factors.rows], factors.values * d[factors.columns])
        return shift

    def extra(self, d: Array) -> Array:
        """What the law's right-hand side adds to the rows, shape (num_local,)."""
        extra = np.zeros(len(self._free))
        for part in self._extra:
            np.add.at(extra, part.rows, part.values * d[part.columns])
        return extra

    def open_multipliers(self, d: Array) -> Array:
        """Multipliers that no displacement enters, zero elsewhere, shape (num_multipliers,)."""
        result = np.zeros(self.num_multipliers)
        for multipliers, diagonal in self._open:
            result[multipliers] = d[multipliers] / diagonal
        return result

    def recover(self, defect: Array, multipliers: Array) -> None:
        """Set the multipliers of closed nodes.

        Args:
            defect: b - K du, shape (num_owned,).
            multipliers: Values to write into, shape (num_multipliers,).
        """
        for which, rows, factor in self._recover:
            multipliers[which] = defect[rows] / factor


def _all_of(parts: list[Index]) -> Index:
    """All of several arrays, of which there may be none."""
    return np.concatenate([np.zeros(0, dtype=np.int64), *parts])


def _none() -> Entries:
    none = np.zeros(0, dtype=np.int64)
    return Entries(none, none, np.zeros(0))
