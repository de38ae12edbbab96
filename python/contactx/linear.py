# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear solvers of the Newton loop: the saddle point as it is, or condensed."""

from __future__ import annotations

from abc import ABC, abstractmethod
from types import SimpleNamespace

from petsc4py import PETSc

import numpy as np

from contactx.bulk import Bulk
from contactx.callback import keeps_its_error, weakly
from contactx.condensed.numbering import Array
from contactx.condensed.solver import CondensedSolver
from contactx.report import Report
from contactx.system import SaddlePointSystem

# Part of the residual that the next iterate has while the active set changes, at least and at most:
# a linear solve leaves a tenth of it
_ROUGH = (1e-5, 0.1)
# The same where a contact has friction
_EXACT = 1e-10


class LinearSolver(ABC):
    """What gives SNES its Jacobian.

    Attributes:
        error: Error that a callback raised.
    """

    error: BaseException | None = None

    @abstractmethod
    def begin_step(self, snes: PETSc.SNES, report: Report) -> None:
        """Start a step.

        Args:
            snes: The solver.
            report: Report whose times are added to.
        """

    @abstractmethod
    def update(self, springs: Array | None) -> None:
        """Bring the Jacobian up to an accepted iterate.

        Args:
            springs: Stiffness added to the diagonal of the displacements, shape (num_dofs,); None
                if none is.
        """

    def set_accuracy(self, residual: float, tolerance: float, changing: float) -> None:
        """Set how accurate the next solve must be.

        Args:
            residual: Residual of the iterate.
            tolerance: What it must fall below.
            changing: Part of the nodes in contact whose status or pair has changed.
        """

    def end_step(self, report: Report) -> None:
        """End a step: write what was done into the report."""

    def skipped(self) -> dict[str, int]:
        """What was not done again in this step, and how often."""
        return {}

    def reset(self) -> None:
        """Drop matrices and factors: an error inside PETSc may have left them half done."""


class SaddlePoint(LinearSolver):
    """The whole Jacobian as one matrix, for a direct solver or what the user chooses."""

    def __init__(self, system: SaddlePointSystem):
        """Create the solver.

        Args:
            system: The coupled system.
        """
        self._system = system
        self._A: PETSc.Mat | None = None
        self._is_current = False
        self._springs: Array | None = None

    def begin_step(self, snes: PETSc.SNES, report: Report) -> None:
        """See ``LinearSolver``."""
        self._snes, self._report = snes, report
        self._A = None

    def reset(self) -> None:
        """See ``LinearSolver``."""
        self._A = None

    def update(self, springs: Array | None) -> None:
        """See ``LinearSolver``."""
        self._springs = springs
        with self._report.timing("Jacobian"):
            A = self._system.jacobian(self._A, springs)
        self._is_current = True
        if A is not self._A:
            self._A = A
            self._snes.setJacobian(weakly(self._jacobian), A)

    @keeps_its_error
    def _jacobian(self, snes: PETSc.SNES, x: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        if not self._is_current:
            with self._report.timing("Jacobian"):
                self._system.unpack(x)
                self._system.jacobian(A, self._springs)
        self._is_current = False


class Condensed(LinearSolver):
    """The condensed solver as a preconditioner that is exact; the Jacobian is not assembled."""

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, x: Array, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            x: Reference positions, those of owned nodes first, shape (num_nodes, gdim).
            prefix: Prefix of the PETSc options.
        """
        self._bulk = bulk
        self._system = system
        self._solver = CondensedSolver(bulk, system, x, prefix + "condensed_")
        self._has_path = any(i.history is not None for i in system.interfaces)
        # Residual of the iterate before, and what Newton's method makes of its square
        self._before = self._curvature = 0.0
        size = system.x.getSizes()
        self._A = PETSc.Mat().createPython((size, size), self._called(), comm=system.x.comm)
        self._A.setUp()

    def begin_step(self, snes: PETSc.SNES, report: Report) -> None:
        """See ``LinearSolver``."""
        self._snes, self._has_ended = snes, False
        self._solver.begin_step(report)
        self._before = 0.0
        snes.setJacobian(weakly(self._jacobian), self._A)
        pc = snes.getKSP().getPC()
        pc.setType("python")
        pc.setPythonContext(self._called())

    def update(self, springs: Array | None) -> None:
        """See ``LinearSolver``."""
        self._solver.springs = springs

    def set_accuracy(self, residual: float, tolerance: float, changing: float) -> None:
        """See ``LinearSolver``; no more accurate than what the next residual will show.

        While the active set changes, its change dominates the next residual. Once it has settled,
        Newton's method leaves a multiple of the residual's square, as seen in the last iteration.
        Where nodes slip from where they touch first, the solution depends on the iterates: these
        must depend neither on the linear solver nor on the number of ranks.
        """
        if changing == 0 and self._before > 0:
            seen = residual / self._before**2
            # What the solve itself has left says no more than that it is not larger
            shown = residual > 10 * self._solver.target
            self._curvature = seen if shown else min(seen, self._curvature)
        self._before = residual if changing == 0 else 0.0
        left = min(self._curvature * residual**2, 0.1 * residual)
        if changing > 0 and self._has_path:
            left = _EXACT * residual
        elif changing > 0:
            left = max(left, float(np.clip(changing, *_ROUGH)) * residual)
        # At the end far below the tolerance: errors must not decide between stick and slip
        self._solver.target = max(0.1 * left, 0.01 * tolerance)
        self._solver.is_last = self._solver.target < 0.1 * tolerance

    def end_step(self, report: Report) -> None:
        """See ``LinearSolver``."""
        self._has_ended = True
        report.krylov = self._solver.iterations
        report.hierarchies = self._solver.hierarchies
        report.uncondensed = list(self._solver.direct)
        report.factorisations = self._solver.factorisations

    def reset(self) -> None:
        """See ``LinearSolver``."""
        self._solver.reset()
        if not self._has_ended:
            # PETSc counts the solves under way, and takes no more than two for ever
            ksp = PETSc.KSP().create(comm=self._snes.comm)
            ksp.setOptionsPrefix(self._snes.getOptionsPrefix())
            self._snes.setKSP(ksp)
        self._before = self._curvature = 0.0

    def skipped(self) -> dict[str, int]:
        """See ``LinearSolver``."""
        return self._solver.skipped()

    @keeps_its_error
    def _jacobian(self, snes: PETSc.SNES, x: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        self._system.unpack(x)
        A.assemble()

    def _called(self) -> SimpleNamespace:
        """What PETSc calls as a matrix or a preconditioner."""
        return SimpleNamespace(apply=weakly(self.apply), mult=weakly(self.mult))

    @keeps_its_error
    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b; PETSc calls this."""
        self._solver.solve(b, x)

    def mult(self, mat: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = J x; PETSc calls this where the user takes another KSP."""
        self._solver.multiply(x, y)
