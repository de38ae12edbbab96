# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The condensed matrix as a product, and what contact changes in it."""

from __future__ import annotations

from dataclasses import dataclass

from petsc4py import PETSc

import numpy as np

from contactx.bulk import Bulk
from contactx.condensed.blocks import Array, ContactBlocks, Entries, Index
from contactx.condensed.elimination import Elimination


class CondensedOperator:
    """K_c = (I + left) (K + S) (I + right) + law (I + right), with ones for what is eliminated.

    It is applied as it stands: the bulk's matrix is neither copied nor changed, and the others have
    entries in contact rows alone.

    Attributes:
        diagonal: Entries that stand for the eliminated displacements, shape (k,).
        eliminated: The eliminated displacements, shape (k,).
        is_symmetric: Whether the condensed matrix is symmetric.
    """

    def __init__(
        self,
        bulk: Bulk,
        blocks: ContactBlocks,
        elimination: Elimination,
        springs: Array | None,
    ):
        """Create the operator.

        Args:
            bulk: The bulk.
            blocks: Contact blocks of the Jacobian.
            elimination: How the multipliers are eliminated.
            springs: What is added to the diagonal, shape (num_dofs,).
        """
        self._bulk = bulk
        self._K = bulk.matrix()
        size = self._K.getSize()[0]
        self.is_symmetric = bulk.is_symmetric and elimination.is_symmetric
        self._S = _sparse(blocks.stiffness, size)
        self._right = _sparse(elimination.right, size)
        # Where left is the transpose of right it is not made
        self._transposed = self._right if elimination.is_symmetric else None
        self._left = None if elimination.is_symmetric else _sparse(elimination.left, size)
        self._law = _sparse(elimination.law, size)
        self._elimination = elimination
        self._springs = springs
        self.slave_dofs = elimination.slave_dofs
        self.eliminated = elimination.eliminated
        self.diagonal = np.abs(self._K.getDiagonal().array)[self.eliminated]
        self._z, self._w = self._K.createVecs()
        self._work = self._w.duplicate()

    def bulk(self, z: PETSc.Vec, w: PETSc.Vec) -> None:
        """Multiply by the bulk, w = (K + S) z."""
        self._K.mult(z, w)
        if self._S is not None:
            self._S.multAdd(z, w, w)
        if self._springs is not None:
            w.array[:] += self._springs * z.array_r

    def expand(self, v: PETSc.Vec, z: PETSc.Vec) -> None:
        """Give all displacements, z = (I + right) v."""
        if self._right is None:
            v.copy(z)
        else:
            self._right.multAdd(v, v, z)

    def combine(self, w: PETSc.Vec, y: PETSc.Vec) -> None:
        """Combine rows, y = (I + left) w, zero in the eliminated ones."""
        if self._transposed is not None:
            self._transposed.multTransposeAdd(w, w, y)
        elif self._left is None:
            w.copy(y)
        else:
            self._left.multAdd(w, w, y)
        y.array[self.eliminated] = 0

    def add_law(self, z: PETSc.Vec, y: PETSc.Vec, sign: float) -> None:
        """Add the law's rows, y += sign law z."""
        if self._law is not None:
            self._law.mult(z, self._work)
            y.axpy(sign, self._work)

    def mult(self, mat: PETSc.Mat, v: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = K_c v; PETSc calls this."""
        self.expand(v, self._z)
        self.bulk(self._z, self._w)
        self.combine(self._w, y)
        self.add_law(self._z, y, 1.0)
        y.array[self.eliminated] = self.diagonal * v.array_r[self.eliminated]

    def change(self) -> Change:
        """What contact changes in the bulk's matrix, without what friction adds."""
        size = self._K.getSize()[0]
        order = np.sort(self.eliminated).astype(PETSc.IntType)
        eliminated = PETSc.IS().createGeneral(order, comm=PETSc.COMM_SELF)
        places = np.searchsorted(self.slave_dofs, order).astype(PETSc.IntType)
        chosen = PETSc.IS().createGeneral(places, comm=PETSc.COMM_SELF)
        whole = PETSc.IS().createStride(size, comm=PETSc.COMM_SELF)
        block = self._bulk.rows(self.slave_dofs).createSubMatrix(chosen, eliminated)
        right = (self._right or _empty(size)).createSubMatrix(eliminated, whole)
        springs = None
        if self._springs is not None:
            held = np.setdiff1d(np.flatnonzero(self._springs), order)
            springs = Entries(held, held, self._springs[held]).matrix((size, size))
        return Change(places, right, block, springs, self._bound())

    def _bound(self) -> PETSc.Vec:
        """Diagonal D with which the condensed matrix has no larger eigenvalue than the bulk's.

        With K <= lambda D_K and displacements sum_l R_sl v_l of the eliminated s, Cauchy's
        inequality gives D = D_K + sum_s D_s (sum_l |R_sl|) |R_s|.
        """
        bound = self._K.getDiagonal()
        D = np.abs(bound.array_r)
        R = self._elimination.right
        R = R.select(R.rows != R.columns)
        size = np.abs(R.values)
        total = np.bincount(R.rows, size, len(D))
        D = D + np.bincount(R.columns, (D * total)[R.rows] * size, len(D))
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
class Change:
    """What contact changes in the bulk's matrix K, by the eliminated displacements e in order.

    Attributes:
        places: Their places among the displacements of the slave nodes, shape (k,).
        right: Their rows of ``right``, (k, num_dofs).
        block: Block K_ee, (k, k).
        springs: Springs elsewhere, (num_dofs, num_dofs); None where there are none.
        bound: Diagonal with which the eigenvalues stay those of the bulk.
    """

    places: Index
    right: PETSc.Mat
    block: PETSc.Mat
    springs: PETSc.Mat | None
    bound: PETSc.Vec


def _sparse(entries: Entries, size: int) -> PETSc.Mat | None:
    return entries.matrix((size, size)) if len(entries.rows) > 0 else None


def _empty(size: int) -> PETSc.Mat:
    none = np.zeros(0, dtype=np.int64)
    return Entries(none, none, np.zeros(0)).matrix((size, size))
