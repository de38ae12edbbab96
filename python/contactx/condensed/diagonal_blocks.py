# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Diagonal blocks of the condensed matrix, entry by entry."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx.condensed.chains import add_terms
from contactx.condensed.numbering import DIFFERENT, Array, Index, Numbering


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
            first, last = self.stiffness.getOwnershipRange()
            places = np.arange(first, last, dtype=PETSc.IntType)
            diagonal = PETSc.Mat().createAIJ(self.stiffness.getSizes(), comm=numbering.comm)
            diagonal.setPreallocationCOO(places, places)
            diagonal.setValuesCOO(springs)
            self.stiffness.axpy(1.0, diagonal, DIFFERENT)


class Part:
    """Some of the displacements, those of soft bodies or of stiff ones.

    Attributes:
        dofs: Owned displacements, ascending, shape (n,).
        K: The bulk's block.
    """

    def __init__(self, numbering: Numbering, dofs: Index, K: PETSc.Mat):
        """Take a block out of the bulk's matrix; all ranks must take part.

        Args:
            numbering: Displacements on this rank.
            dofs: Owned displacements, ascending.
            K: The bulk's matrix in rows.
        """
        self.dofs = dofs
        self._set = numbering.index_set(dofs)
        self.K = K.createSubMatrix(self._set, self._set)
        self._places = np.full(numbering.num_owned, -1)
        self._places[dofs] = np.arange(len(dofs))

    def places(self, dofs: Index) -> Index:
        """Places of owned displacements among these, of those that are there."""
        places: Index = self._places[dofs]
        return places[places >= 0]

    def of(self, A: PETSc.Mat, columns: Part | None = None) -> PETSc.Mat:
        """Block of a matrix over all displacements; all ranks must take part.

        Args:
            A: The matrix.
            columns: Displacements of the columns; those of the rows if None.
        """
        return A.createSubMatrix(self._set, (columns or self)._set)

    def with_added(self, change: PETSc.Mat) -> PETSc.Mat:
        """K and what is added to it, a matrix of its own."""
        A = self.K.copy()
        A.axpy(1.0, change, DIFFERENT)
        return A

    def block(self, change: PETSc.Mat, eliminated: Index) -> PETSc.Mat:
        """K and what contact adds to it, with ones for what is eliminated.

        Args:
            change: What contact adds.
            eliminated: Owned displacements that are eliminated.
        """
        A = self.with_added(change)
        first, _ = A.getOwnershipRange()
        rows = (first + self.places(eliminated)).astype(PETSc.IntType)
        A.zeroRowsColumns(rows, diag=1.0)
        return A


def exact_change(part: Part, transforms: Transforms) -> tuple[PETSc.Mat, bool]:
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
    K = part.with_added(S) if _has_entries(S) else part.K
    change = S
    # Rows and columns of what is eliminated are zeroed; a displacement itself is no other one
    is_symmetric = not (_has_entries(L) or _has_entries(law))
    if _has_entries(R):
        change.axpy(1.0, K.matMult(R), DIFFERENT)
    if not is_symmetric:
        product = L.matMult(K)
        if _has_entries(R):
            product.axpy(1.0, product.matMult(R), DIFFERENT)
            law.axpy(1.0, law.matMult(R), DIFFERENT)
        change.axpy(1.0, product, DIFFERENT)
        change.axpy(1.0, law, DIFFERENT)
    return change, is_symmetric


def symmetric_change(
    part: Part, soft: Part, transforms: Transforms, springs: PETSc.Vec
) -> PETSc.Mat:
    """What contact adds to the bulk's block of stiff bodies; all ranks must take part.

    Args:
        part: Displacements of stiff bodies.
        soft: Those of soft ones.
        transforms: What contact does; what friction makes unsymmetric is left out.
        springs: Diagonal that stands for the soft bodies.

    Returns:
        (I + R)^T (K + S) (I + R) + R_c^T springs R_c - K, R_c being what soft bodies follow.
    """
    R, S = part.of(transforms.right), part.of(transforms.stiffness)
    K = part.with_added(S) if _has_entries(S) else part.K
    change = S
    if _has_entries(R):
        B = K.matMult(R)
        change.axpy(1.0, B, DIFFERENT)
        change.axpy(1.0, B.transpose(PETSc.Mat()), DIFFERENT)
        change.axpy(1.0, R.transposeMatMult(B), DIFFERENT)
    X = soft.of(transforms.right, part)
    Y = X.copy()
    Y.diagonalScale(springs)
    change.axpy(1.0, X.transposeMatMult(Y), DIFFERENT)
    return change


def _has_entries(A: PETSc.Mat) -> bool:
    """Whether a matrix has any entries; the same on all ranks."""
    return bool(A.getInfo(PETSc.Mat.InfoType.GLOBAL_SUM)["nz_used"] > 0)
