# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A direct solver whose factors serve several Jacobians."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx._host.options import ROUNDING, direct_options
from contactx._host.parallel import reduce
from contactx._host.system import SaddlePointSystem
from contactx.report import Report

# Iterations that cost what a factorisation costs, as measured from 24,000 to 176,000 displacements
_COST = 40
# Iterations with the factors of the same Jacobian, but for rounding
_AT_ONCE = 4


class FactorisedSolver:
    """GMRES with the factors of an older Jacobian, for as long as that pays.

    Between two Jacobians little differs: rows of nodes that have changed their status, normals that
    have turned. So iterations are few, and a new factorisation is made once those since the last
    one have cost as much.

    Attributes:
        factorisations: Factorisations made.
        iterations: Iterations with older factors.
    """

    def __init__(self, system: SaddlePointSystem, prefix: str):
        """Create a solver.

        Args:
            system: The coupled system.
            prefix: Prefix of the PETSc options.
        """
        self._system = system
        self._prefix = prefix
        self._ksp: PETSc.KSP | None = None
        self._A: PETSc.Mat | None = None
        # Patterns so far, and that of the factors
        self._pattern = self._factorised = 0
        self._lost = 0
        self.factorisations = self.iterations = 0

    def reset(self) -> None:
        """Drop the factors: an error inside PETSc may have left them half done."""
        self._ksp = self._A = None
        self._lost = 0

    def solve(
        self,
        b: PETSc.Vec,
        x: PETSc.Vec,
        target: float,
        springs: npt.NDArray[np.float64] | None,
        report: Report,
        *,
        last: bool,
    ) -> None:
        """Solve J x = b with the Jacobian J at the system's state.

        Args:
            b: Right-hand side.
            x: Solution, overwritten; not finite where the Jacobian is singular.
            target: What the norm of the residual must fall below.
            springs: What is added to the diagonal of the displacements, shape (num_dofs,).
            report: Report whose times are added to.
            last: Whether it is to be the last solve of a step. Where nodes are on the edge of stick
                and slip the next step starts from them as they are, so what is left of an older
                Jacobian must not move them.
        """
        with report.timing("Jacobian"):
            A = self._system.jacobian(self._A, springs)
            if A is not self._A:
                self._A = A
                self._pattern += 1
        if self._ksp is not None and self._lost <= _COST:
            self._ksp.setOperators(A)
            with report.timing("old factors"):
                if self._iterate(b, x, target, _AT_ONCE if last else _COST):
                    return
        with report.timing("factorisation"):
            if self._factorise(A):
                self._iterate(b, x, target, _COST)
            else:
                x.set(np.inf)

    def _iterate(self, b: PETSc.Vec, x: PETSc.Vec, target: float, most: int) -> bool:
        ksp = self._ksp
        assert ksp is not None
        ksp.setTolerances(rtol=ROUNDING, atol=target, max_it=most)
        ksp.solve(b, x)
        count = ksp.getIterationNumber()
        self._lost += count
        self.iterations += count
        return bool(ksp.getConvergedReason() > 0)

    def _factorise(self, A: PETSc.Mat) -> bool:
        """Factorise a matrix; whether it has factors. All ranks must take part."""
        if self._ksp is not None and self._factorised != self._pattern:
            # Two factorisations at once would be the largest part of the memory
            self._ksp.destroy()
            self._ksp = None
        # The options of factors are read from the database when they are made
        with direct_options(self._prefix).in_database():
            if self._ksp is None:
                self._ksp = PETSc.KSP().create(comm=A.comm)
                self._ksp.setOptionsPrefix(self._prefix)
                self._ksp.setFromOptions()
            # A matrix of the same pattern needs no new analysis
            pc = self._ksp.getPC()
            pc.setReusePreconditioner(False)
            self._ksp.setOperators(A)
            self._ksp.setUp()
            pc.setReusePreconditioner(True)
        self.factorisations += 1
        if reduce.anywhere(A.comm.tompi4py(), pc.getFailedReason() != 0):
            # PETSc would keep the failure for matrices of this pattern, or solve without factors
            self._ksp.destroy()
            self._ksp = None
            return False
        self._factorised = self._pattern
        self._lost = 0
        return True
