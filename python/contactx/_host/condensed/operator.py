# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The condensed matrix as a product, and what contact changes in it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host.bulk import Bulk
from contactx._host.condensed.chains import Chains
from contactx._host.condensed.diagonal_blocks import Transforms
from contactx._host.condensed.numbering import Array, Index, Numbering, index_set
from contactx._host.options import ROUNDING
from contactx._host.parallel import reduce


class CondensedOperator:
    """K_c = (I + left) (K + S) (I + right) + law (I + right), with ones for what is eliminated.

    Where eliminations need one another (I - C_r)^-1 right and left (I - C_l)^-1 take the place of
    right and left; see ``condense/elimination.h``. It is applied as it stands: the bulk's matrix is
    neither copied nor changed, and the others have entries in contact rows alone. All ranks must
    take part in making and applying it.

    Attributes:
        diagonal: Entries that stand for the eliminated displacements, shape (k,).
        eliminated: The eliminated displacements, shape (k,).
        slave_dofs: Displacements of all slave nodes, in order.
        is_symmetric: Whether the condensed matrix is symmetric.
        retained: Owned prescribed dofs in whose places multipliers remain unknowns, shape (n,).
        numbering: Displacements on this rank.
    """

    def __init__(
        self,
        bulk: Bulk,
        numbering: Numbering,
        condensation: core.Condensation,
        springs: Array | None,
    ):
        """Create the operator.

        Args:
            bulk: The bulk.
            numbering: Displacements on this rank.
            condensation: How the multipliers are eliminated.
            springs: What is added to the diagonal, shape (num_owned,), on all ranks or on none.
        """
        self._bulk = bulk
        self.numbering = numbering
        self._K = bulk.matrix()
        self._condensation = condensation
        self._springs = springs
        self.slave_dofs = condensation.slave_dofs
        self.eliminated = condensation.eliminated
        self.retained, self._retained_multipliers, self._retained_scale = condensation.retained
        # Rows of the eliminated displacements alone
        self._right = numbering.matrix(condensation.right, rows=self.eliminated)
        self._some = self._right.createVecLeft()
        self._transposed = condensation.is_symmetric(numbering.nodes)
        self.is_symmetric = bulk.is_symmetric and self._transposed
        left = (condensation.left, condensation.rows)
        others = ((condensation.stiffness,), left, (condensation.law,))
        counts = reduce.largest(numbering.comm, np.array([sum(map(len, p)) for p in others]))
        # Where left is the transpose of right it is not made
        needed = (counts > 0) & [True, not self._transposed, True]
        self._S, self._left, self._law = (
            numbering.matrix(*parts) if is_needed else None
            for parts, is_needed in zip(others, needed, strict=True)
        )
        self._chains = of_right, of_left = condensation.dependent_constraints(numbering.nodes)
        self._of_right = Chains.of(numbering, of_right, self.eliminated)
        self._of_left, self._recovered = self._of_right, self.eliminated
        if not self._transposed:
            self._recovered = np.sort(condensation.recovered)
            self._of_left = Chains.of(numbering, of_left, self._recovered)
        self.diagonal = np.abs(self._K.getDiagonal().array_r)[self.eliminated]
        self._z, self._w = self._K.createVecs()
        self._work = self._w.duplicate()

    def unknowns(self, x: Array, factors: Array) -> Array:
        """Unknowns of the condensed matrix.

        Args:
            x: Unknowns of the whole system, shape (num_owned + num_multipliers,).
            factors: Multipliers over their unknowns, shape (num_multipliers,).

        Returns:
            Displacements, zero where eliminated, and multipliers in the places of prescribed ones,
            shape (num_owned,).
        """
        n = self.numbering.num_owned
        v = x[:n].copy()
        v[self.eliminated] = 0
        of_retained = self._retained_multipliers
        v[self.retained] = x[n + of_retained] * factors[of_retained] / self._retained_scale
        return v

    def parts(self, bodies: core.Bodies) -> tuple[Index, Index]:
        """Owned unknowns of soft bodies and of stiff ones, the same bodies on all ranks.

        Args:
            bodies: The bodies.
        """
        n = self.numbering.num_owned
        of_body = self._condensation.stiff_bodies(bodies, self._free_diagonal)
        is_stiff = np.repeat(of_body[bodies.number] == 1, self.numbering.gdim)[:n]
        # Where multipliers may be, whose rows are constraints of their masters
        if np.any(of_body):
            slaves = self.slave_dofs
            is_stiff[slaves[self._bulk.markers[slaves] == 1]] = True
        return np.flatnonzero(~is_stiff), np.flatnonzero(is_stiff)

    def softness(self, bodies: core.Bodies, residual: Array) -> float:
        """Part of a residual that counts for the softest body; all ranks must take part.

        Args:
            bodies: The bodies.
            residual: Residual of the owned displacements, shape (num_owned,).
        """
        return core.residual_weight(bodies, self._free_diagonal, residual, self.numbering.gdim)

    @cached_property
    def _free_diagonal(self) -> Array:
        """The bulk's diagonal, zero where displacements are prescribed, shape (num_owned,)."""
        diagonal: Array = self._K.getDiagonal().array_r.copy()
        diagonal[self._bulk.markers[: len(diagonal)] == 1] = 0
        return diagonal

    def master_springs(self, stiffness: Array) -> Array:
        """Springs at masters that stand for the bodies of their slaves; all ranks must take part.

        Args:
            stiffness: Stiffness of these bodies for each unit of contact area at owned
                displacements, zero where there is to be no spring, shape (num_owned,).

        Returns:
            Springs at owned displacements, shape (num_owned,).
        """
        every = self.numbering.scatter_forward(stiffness)
        return self.numbering.scatter_reverse(self._condensation.master_springs(every))

    def areas(self) -> Array:
        """Contact area of each owned displacement, by its forces for a multiplier of one.

        Zero where nothing is closed, shape (num_owned,).
        """
        traction = self._condensation.traction
        areas = np.bincount(
            traction.rows, np.abs(traction.values), minlength=self.numbering.num_local
        )
        return areas[: self.numbering.num_owned]

    def reduction(self, rhs: PETSc.Vec, v: PETSc.Vec, target: float) -> float:
        """Logarithm of what iterations must reduce the residual by; all ranks must take part.

        Args:
            rhs: Right-hand side.
            v: Start of the iterations.
            target: What the norm of the residual must fall below.

        Returns:
            At least one.
        """
        start = size = float(rhs.norm())
        if v.norm() > 0:
            residual = rhs.duplicate()
            self.mult(v, residual)
            residual.aypx(-1.0, rhs)
            start = float(residual.norm())
        goal = max(target, ROUNDING * size)
        return max(1.0, float(np.log(start / goal))) if start > goal > 0 else 1.0

    def transforms(self) -> Transforms:
        """What turns the bulk's matrix into the condensed one; all ranks must take part."""
        of_right, of_left = (
            entries if solver is not None else None
            for entries, solver in zip(self._chains, (self._of_right, self._of_left), strict=True)
        )
        return Transforms(self.numbering, self._condensation, self._springs, (of_right, of_left))

    def bulk(self, z: PETSc.Vec, w: PETSc.Vec) -> None:
        """Multiply by the bulk, w = (K + S) z."""
        self._K.mult(z, w)
        if self._S is not None:
            self._S.multAdd(z, w, w)
        if self._springs is not None:
            w.array[:] += self._springs * z.array_r

    def place(self, values: Array) -> Array:
        """What of eliminated displacements the constraints' right-hand side gives.

        Args:
            values: The same where none needs another one, shape (num_owned,); overwritten.
        """
        if self._of_right is not None:
            self._of_right.solve_at(values, self.eliminated)
        return values

    def release(self, values: Array) -> Array:
        """Rows that give multipliers, each with one multiplier alone.

        Args:
            values: Rows, shape (num_owned,); overwritten.
        """
        if self._of_left is not None:
            self._of_left.solve_at(values, self._recovered, transposed=self._transposed)
        return values

    def expand(self, v: PETSc.Vec, z: PETSc.Vec) -> None:
        """Give all displacements, z = (I + right) v."""
        self._right.mult(v, self._some)
        if self._of_right is not None:
            self._of_right.solve(self._some)
        v.copy(z)
        z.array[self.eliminated] += self._some.array_r

    def combine(self, w: PETSc.Vec, y: PETSc.Vec) -> None:
        """Combine rows, y = (I + left) w, zero in the eliminated ones."""
        if self._transposed:
            self._some.array[:] = w.array_r[self.eliminated]
            if self._of_left is not None:
                self._of_left.solve(self._some, transposed=True)
            self._right.multTransposeAdd(self._some, w, y)
        elif self._left is None:
            w.copy(y)
        elif self._of_left is None:
            self._left.multAdd(w, w, y)
        else:
            w.copy(self._work)
            self.release(self._work.array)
            self._left.multAdd(self._work, w, y)
        y.array[self.eliminated] = 0

    def add_law(self, z: PETSc.Vec, y: PETSc.Vec, sign: float) -> None:
        """Add the law's rows, y += sign law z."""
        if self._law is not None:
            self._law.mult(z, self._work)
            y.axpy(sign, self._work)

    def mult(self, v: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = K_c v."""
        self.expand(v, self._z)
        self.bulk(self._z, self._w)
        self.combine(self._w, y)
        self.add_law(self._z, y, 1.0)
        y.array[self.eliminated] = self.diagonal * v.array_r[self.eliminated]

    def contact_update(self) -> ContactUpdate:
        """Update of the bulk's matrix by contact, without what friction adds."""
        rows = self._bulk.rows(self.slave_dofs)
        places = np.searchsorted(self.slave_dofs, self.eliminated)
        block = rows.createSubMatrix(
            index_set(places, rows), self.numbering.index_set(self.eliminated)
        )
        springs = self._elastic()
        chains = None if self._of_right is None else self._of_right.C
        return ContactUpdate(places, self._right, chains, block, springs, self._bound())

    def _elastic(self) -> PETSc.Mat | None:
        """Springs and soft contact as a matrix, without rows of eliminated displacements."""
        # The same on all ranks
        if self._springs is None and not self._condensation.is_soft:
            return None
        numbering = self.numbering
        return numbering.matrix(self._condensation.elastic(numbering.nodes, self._springs))

    def _bound(self) -> PETSc.Vec:
        """Diagonal with which the condensed matrix has no larger eigenvalue than the bulk's."""
        bound = self._K.getDiagonal()
        D = self._condensation.bound(self.numbering.nodes, np.abs(bound.array_r))
        if self._S is not None:
            indptr, _, values = self._S.getValuesCSR()
            rows = np.repeat(np.arange(len(D)), np.diff(indptr))
            D += np.bincount(rows, np.abs(values), len(D))
        if self._springs is not None:
            D += self._springs
        bound.array[:] = D
        bound.array[self.eliminated] = self.diagonal
        return bound


@dataclass(frozen=True)
class ContactUpdate:
    """What contact changes in the bulk's matrix K, by the eliminated displacements e in order.

    Attributes:
        places: Their places among the displacements of this rank's slave nodes, shape (k,).
        right: Their rows of ``right``, (k, num_dofs).
        chains: What they need of one another, (k, k); None where they do not.
        block: Block K_ee, (k, k).
        springs: Springs elsewhere, (num_dofs, num_dofs); None where there are none.
        bound: Diagonal with which the eigenvalues stay those of the bulk.
    """

    places: Index
    right: PETSc.Mat
    chains: PETSc.Mat | None
    block: PETSc.Mat
    springs: PETSc.Mat | None
    bound: PETSc.Vec
