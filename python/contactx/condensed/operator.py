# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The condensed matrix, as a product and assembled for a preconditioner."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx.condensed.blocks import Array, ContactBlocks, Entries
from contactx.condensed.elimination import Elimination


class CondensedOperator:
    """K_c = (I + left) (K + S) (I + right) + law (I + right), with ones for what is eliminated.

    It is applied as it stands: the bulk's matrix is neither copied nor changed, and the others have
    entries in contact rows alone.

    Attributes:
        diagonal: Entries that stand for the eliminated displacements, shape (num_dofs,).
    """

    def __init__(
        self,
        K: PETSc.Mat,
        blocks: ContactBlocks,
        elimination: Elimination,
        springs: Array | None,
    ):
        """Create the operator.

        Args:
            K: Jacobian of the bulk with unit rows at Dirichlet conditions.
            blocks: Contact blocks of the Jacobian.
            elimination: How the multipliers are eliminated.
            springs: What is added to the diagonal, shape (num_dofs,).
        """
        self._K = K
        size = K.getSize()[0]
        self._S = _sparse(blocks.stiffness, size)
        self._left = _sparse(elimination.left, size)
        self._right = _sparse(elimination.right, size)
        self._law = _sparse(elimination.law, size)
        self._elimination = elimination
        self._springs = springs
        self._taken = elimination.eliminated
        self.diagonal = np.abs(K.getDiagonal().array)[self._taken]
        self._z, self._w = K.createVecs()

    def bulk(self, z: PETSc.Vec, w: PETSc.Vec) -> None:
        """Multiply by the bulk, w = (K + S) z."""
        self._K.mult(z, w)
        if self._S is not None:
            self._S.multAdd(z, w, w)
        if self._springs is not None:
            w.array[:] += self._springs * z.array_r

    def expand(self, v: PETSc.Vec, z: PETSc.Vec) -> None:
        """Give all displacements, z = (I + right) v."""
        v.copy(z)
        if self._right is not None:
            self._right.multAdd(v, z, z)

    def combine(self, w: PETSc.Vec, y: PETSc.Vec) -> None:
        """Combine rows, y = (I + left) w, zero in the eliminated ones."""
        w.copy(y)
        if self._left is not None:
            self._left.multAdd(w, y, y)
        y.array[self._taken] = 0

    def add_law(self, z: PETSc.Vec, y: PETSc.Vec, sign: float) -> None:
        """Add the law's rows, y += sign law z."""
        if self._law is not None:
            work = y.duplicate()
            self._law.mult(z, work)
            y.axpy(sign, work)

    def mult(self, mat: PETSc.Mat, v: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = K_c v; PETSc calls this."""
        self.expand(v, self._z)
        self.bulk(self._z, self._w)
        self.combine(self._w, y)
        self.add_law(self._z, y, 1.0)
        y.array[self._taken] = self.diagonal * v.array_r[self._taken]

    def assembled(self) -> PETSc.Mat:
        """(I + right)^T (K + S) (I + right): symmetric, without what friction adds."""
        size = self._K.getSize()[0]
        every = np.arange(size)
        right = self._elimination.right
        T = Entries(
            np.concatenate([every, right.rows]),
            np.concatenate([every, right.columns]),
            np.concatenate([np.ones(size), right.values]),
        ).matrix(size)
        K = self._K
        if self._S is not None:
            K = K.copy()
            K.axpy(1.0, self._S, PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
        A = K.ptap(T)
        extra = np.zeros(size)
        extra[self._taken] = self.diagonal
        if self._springs is not None:
            extra += np.where(np.isin(every, self._taken), 0.0, self._springs)
        diagonal = A.createVecRight()
        diagonal.array[:] = extra
        A.setDiagonal(diagonal, addv=PETSc.InsertMode.ADD)
        return A


def _sparse(entries: Entries, size: int) -> PETSc.Mat | None:
    return entries.matrix(size) if len(entries.rows) > 0 else None
