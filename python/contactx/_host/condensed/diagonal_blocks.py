# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Diagonal blocks of the condensed matrix, entry by entry."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host.condensed.chains import add_terms
from contactx._host.condensed.numbering import DIFFERENT, Array, Index, Numbering, diagonal_matrix
from contactx._host.parallel import reduce

# Relative difference, in the Frobenius norm, below which two matrices are equal but for round-off
_ROUND_OFF = 1e-12


class Transforms:
    """What turns the bulk's matrix into the condensed one, as matrices over all displacements.

    See ``CondensedOperator``; of what eliminations need of one another the first terms of the
    series are in right and left.

    Attributes:
        right: Eliminated displacements by the others.
        left: Rows that take over others.
        law: Rows of the law.
        stiffness: Contact's part of the stiffness, springs among them.
    """

    def __init__(
        self,
        numbering: Numbering,
        condensation: core.Condensation,
        springs: Array | None,
        chains: tuple[core.Triplets | None, core.Triplets | None],
    ):
        """Make the matrices; all ranks must take part.

        Args:
            numbering: Displacements on this rank.
            condensation: How the multipliers are eliminated.
            springs: What is added to the diagonal, shape (num_owned,); None if nothing is.
            chains: What right and left need of one another; None on all ranks where nothing.
        """
        of_right, of_left = chains
        self.right = numbering.matrix(condensation.right)
        if of_right is not None:
            add_terms(self.right, numbering.matrix(of_right))
        self.left = numbering.matrix(condensation.left, condensation.rows)
        if of_left is not None:
            add_terms(self.left, numbering.matrix(of_left), is_left=True)
        self.law = numbering.matrix(condensation.law)
        self.stiffness = numbering.matrix(condensation.stiffness)
        if springs is not None:
            diagonal = diagonal_matrix(springs, numbering.comm)
            self.stiffness.axpy(1.0, diagonal, DIFFERENT)


class DofBlock:
    """Block of dofs, those of soft bodies or of stiff ones.

    Attributes:
        dofs: Owned displacements, ascending, shape (n,).
        index_set: The same in PETSc's numbers.
        K: The bulk's block.
        group: Number of displacements of a node if they are of whole nodes on all ranks, else one.
    """

    def __init__(self, numbering: Numbering, dofs: Index, K: PETSc.Mat):
        """Take a block out of the bulk's matrix; all ranks must take part.

        Args:
            numbering: Displacements on this rank.
            dofs: Owned displacements, ascending.
            K: The bulk's matrix in rows.
        """
        self.dofs = dofs
        self.index_set = numbering.index_set(dofs)
        self.K = K.createSubMatrix(self.index_set, self.index_set)
        self._places = np.full(numbering.num_owned, -1)
        self._places[dofs] = np.arange(len(dofs))
        gdim = numbering.gdim
        is_whole = len(dofs) == gdim * len(np.unique(dofs // gdim))
        self.group = gdim if reduce.everywhere(numbering.comm, is_whole) else 1

    def places(self, dofs: Index) -> Index:
        """Places of owned displacements among these, of those that are there."""
        places: Index = self._places[dofs]
        return places[places >= 0]

    def of(self, A: PETSc.Mat, columns: DofBlock | None = None) -> PETSc.Mat:
        """Block of a matrix over all displacements; all ranks must take part.

        Args:
            A: The matrix.
            columns: Displacements of the columns; those of the rows if None.
        """
        return A.createSubMatrix(self.index_set, (columns or self).index_set)

    def with_added(self, change: PETSc.Mat) -> PETSc.Mat:
        """K and what is added to it, a matrix of its own."""
        A = self.K.copy()
        A.axpy(1.0, change, DIFFERENT)
        return A

    def add_diagonal(self, A: PETSc.Mat, values: Array) -> None:
        """Add to the diagonal of a block; all ranks must take part.

        Args:
            A: A matrix of these displacements.
            values: What is added at all owned displacements, shape (num_owned,).
        """
        A.axpy(1.0, diagonal_matrix(values[self.dofs], A.comm), DIFFERENT)

    def block(self, change: PETSc.Mat, eliminated: Index) -> PETSc.Mat:
        """K and what contact adds to it, with K's own diagonal for what is eliminated.

        So factors serve where displacements are no longer eliminated.

        Args:
            change: What contact adds.
            eliminated: Owned displacements that are eliminated.
        """
        A = self.with_added(change)
        places = self.places(eliminated)
        first, _ = A.getOwnershipRange()
        A.zeroRowsColumns((first + places).astype(PETSc.IntType), diag=1.0)
        diagonal = A.getDiagonal()
        diagonal.array[places] = np.abs(self.K.getDiagonal().array_r[places])
        A.setDiagonal(diagonal)
        return A


def change_of(part: DofBlock, transforms: Transforms) -> tuple[PETSc.Mat, bool]:
    """What contact adds to the bulk's block of a part; all ranks must take part.

    Args:
        part: The displacements.
        transforms: What contact does.

    Returns:
        (I + L) (K + S) (I + R) + law (I + R) - K, and whether it is symmetric where K is.
    """
    R, L, law, S = (
        part.of(A)
        for A in (transforms.right, transforms.left, transforms.law, transforms.stiffness)
    )
    change = S.copy()
    # Rows and columns of what is eliminated are zeroed; a displacement itself is no other one
    is_symmetric = not _has_entries(law) and _is_transposed(L, R)
    if _has_entries(R):
        change.axpy(1.0, _sum_of_products(part.K, S, R), DIFFERENT)
    if _has_entries(L):
        product = L.matMult(part.K)
        if _has_entries(S):
            product.axpy(1.0, L.matMult(S), DIFFERENT)
        if _has_entries(R):
            product.axpy(1.0, product.matMult(R), DIFFERENT)
        change.axpy(1.0, product, DIFFERENT)
    if _has_entries(law):
        if _has_entries(R):
            law.axpy(1.0, law.matMult(R), DIFFERENT)
        change.axpy(1.0, law, DIFFERENT)
    return change, is_symmetric


def _sum_of_products(K: PETSc.Mat, S: PETSc.Mat, R: PETSc.Mat) -> PETSc.Mat:
    """(K + S) R without the sum, which would be a second K; all ranks must take part."""
    product = K.matMult(R)
    if _has_entries(S):
        product.axpy(1.0, S.matMult(R), DIFFERENT)
    return product


def _is_transposed(L: PETSc.Mat, R: PETSc.Mat) -> bool:
    """Whether L = R^T but for round-off, or both are empty; the same on all ranks."""
    if not (_has_entries(L) or _has_entries(R)):
        return True
    size = max(L.norm(), R.norm())
    difference = R.transpose(PETSc.Mat())
    difference.axpy(-1.0, L, DIFFERENT)
    return bool(difference.norm() <= _ROUND_OFF * size)


def _has_entries(A: PETSc.Mat) -> bool:
    """Whether a matrix has any entries; the same on all ranks."""
    return bool(A.getInfo(PETSc.Mat.InfoType.GLOBAL_SUM)["nz_used"] > 0)
