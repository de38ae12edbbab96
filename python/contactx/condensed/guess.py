# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A first guess of a step's first solution from those of the steps before."""

from __future__ import annotations

from petsc4py import PETSc

from contactx.condensed.operator import CondensedOperator

# Steps that are remembered: loads grow evenly, or their growth changes evenly
_STEPS = 2
# Part of the right-hand side that a guess must leave at most
_USEFUL = 0.5
# Part of a solution's product that must be new
_SAME = 1e-10


class Guess:
    """Combines the first solutions of earlier steps so that the residual is smallest.

    Where the status has settled and the load grows evenly, the next step's increment is that of the
    last one but for a factor.

    PETSc's guess after Fischer keeps products of the matrices that were: its preconditioner is
    reused, so PETSc takes them for those of today's. With 20 vectors instead of these two it takes
    up to 6 % more iterations, 2 % in the mean; without any guess it is 16 %.
    """

    def __init__(self) -> None:
        """Create a guess that knows nothing."""
        self._solutions: list[PETSc.Vec] = []
        self._is_first = False

    def reset(self) -> None:
        """Drop the solutions."""
        self._solutions = []

    def begin_step(self) -> None:
        """The next solve is the first of a step."""
        self._is_first = True

    def start(self, operator: CondensedOperator, rhs: PETSc.Vec, v: PETSc.Vec) -> None:
        """Set a start of the iterations.

        Args:
            operator: The condensed matrix.
            rhs: Right-hand side.
            v: Start, overwritten where there is one.
        """
        if not self._is_first or not self._solutions:
            return
        start, left = v.duplicate(), rhs.copy()
        start.zeroEntries()
        # Orthonormal products of the matrix, each with its vector
        basis: list[tuple[PETSc.Vec, PETSc.Vec]] = []
        for solution in self._solutions:
            vector, product = solution.copy(), rhs.duplicate()
            vector.array[operator.eliminated] = 0
            operator.mult(vector, product)
            size = product.norm()
            for other, of_other in basis:
                factor = of_other.dot(product)
                product.axpy(-factor, of_other)
                vector.axpy(-factor, other)
            new = product.norm()
            if new <= _SAME * size:
                continue
            vector.scale(1 / new)
            product.scale(1 / new)
            basis.append((vector, product))
            factor = product.dot(left)
            start.axpy(factor, vector)
            left.axpy(-factor, product)
        if left.norm() <= _USEFUL * rhs.norm():
            start.copy(v)

    def keep(self, v: PETSc.Vec) -> None:
        """Remember a solution, where it is the first of a step."""
        if self._is_first:
            self._solutions = [v.copy(), *self._solutions][:_STEPS]
        self._is_first = False
