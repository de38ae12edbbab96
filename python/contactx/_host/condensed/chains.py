# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Eliminated displacements that depend on one another."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host.condensed.numbering import DIFFERENT, Array, Index, Numbering, diagonal_matrix
from contactx._host.parallel import reduce

# Number of terms of a Neumann series after the first one
_NUM_SERIES_TERMS = 2


class Chains:
    """Solves (I - C) y = x, C being what eliminations need of one another.

    C joins eliminated displacements of one facet, or of a slave node and its master, so that its
    factors are sparse. Several ranks have the factors of all of it each: iterations would wait for
    one another in every product of the condensed matrix.

    Attributes:
        C: The matrix, (k, k).
    """

    def __init__(self, numbering: Numbering, entries: core.Triplets, dofs: Index):
        """Factorise the matrix; all ranks must take part.

        Args:
            numbering: Displacements on this rank.
            entries: Entries of C in local numbers.
            dofs: Owned displacements that its rows and columns stand for, in order.
        """
        self.C = numbering.matrix(entries, rows=dofs, is_square=True)
        A = diagonal_matrix(np.ones(len(dofs)), numbering.comm)
        A.axpy(-1.0, self.C, DIFFERENT)
        # Of a matrix whose pattern has grown PETSc's LU reads sizes of inodes that were never set
        A = A.copy()
        self._ksp = PETSc.KSP().create(comm=numbering.comm)
        self._ksp.setOperators(A)
        self._ksp.setType("preonly")
        self._ksp.getPC().setType("lu" if numbering.comm.size == 1 else "redundant")
        self._b = A.createVecRight()

    def solve(self, x: PETSc.Vec, *, transposed: bool = False) -> None:
        """Solve in place; all ranks must take part.

        Args:
            x: Right-hand side, overwritten by the solution.
            transposed: Whether with the matrix transposed.

        Raises:
            core.NotCondensable: On all ranks, where the matrix is singular.
        """
        x.copy(self._b)
        if transposed:
            self._ksp.solveTranspose(self._b, x)
        else:
            self._ksp.solve(self._b, x)
        if self._ksp.getConvergedReason() < 0:
            raise core.NotCondensable("slave nodes that are masters hold one another")

    def solve_at(self, values: Array, dofs: Index, *, transposed: bool = False) -> None:
        """Solve in place for some values of an array; see ``solve``.

        Args:
            values: Array that holds the right-hand side and is overwritten, shape (num_owned,).
            dofs: Displacements of the rows, in order.
            transposed: Whether with the matrix transposed.
        """
        x = self._b.duplicate()
        x.array[:] = values[dofs]
        self.solve(x, transposed=transposed)
        values[dofs] = x.array_r

    @classmethod
    def of(cls, numbering: Numbering, entries: core.Triplets, dofs: Index) -> Chains | None:
        """Make a solver of the chains, or None where no rank has entries; collective."""
        if not reduce.anywhere(numbering.comm, len(entries) > 0):
            return None
        return cls(numbering, entries, dofs)


def add_terms(X: PETSc.Mat, C: PETSc.Mat, *, is_left: bool = False) -> None:
    """Make a matrix the first terms of (I - C)^-1 X; all ranks must take part.

    Args:
        X: The matrix, overwritten.
        C: What eliminations need of one another.
        is_left: Whether of X (I - C)^-1.
    """
    term = X
    for _ in range(_NUM_SERIES_TERMS):
        term = term.matMult(C) if is_left else C.matMult(term)
        X.axpy(1.0, term, DIFFERENT)
