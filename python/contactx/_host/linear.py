# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear solvers of the Newton loop: the saddle point as it is, or condensed."""

from __future__ import annotations

from abc import ABC, abstractmethod
from types import SimpleNamespace

from petsc4py import PETSc

from contactx import cpp as core
from contactx._host.algebra import Algebra, Array
from contactx._host.bulk import Bulk
from contactx._host.callbacks import keeps_its_error, weakly
from contactx._host.options import reproducible_options
from contactx._host.system import SaddlePointSystem
from contactx.report import Report


class LinearSolver(ABC):
    """Base of the solvers that give SNES its Jacobian.

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

    def end_step(self, report: Report) -> None:
        """End a step: write what was done into the report."""

    def skipped(self) -> dict[str, int]:
        """Names of the work that was skipped in this step, and how often."""
        return {}

    def reset(self) -> None:
        """Drop matrices and factors: an error inside PETSc may have left them half done."""


class SaddlePoint(LinearSolver):
    """The whole Jacobian as one matrix, for a direct solver or the user's own."""

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

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, problem: core.Problem, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            problem: Driver of the load step, which it follows.
            prefix: Prefix of the PETSc options.
        """
        self._system = system
        self._solver = core.CondensedSolver(problem, Algebra(bulk, system, prefix + "condensed_"))
        self._snes: PETSc.SNES | None = None
        self._has_ended = True
        size = system.x.getSizes()
        self._A = PETSc.Mat().createPython((size, size), self._called(), comm=system.x.comm)
        self._A.setUp()

    @property
    def tuning(self) -> core.Tuning:
        """Costs and limits, which may be changed."""
        return self._solver.tuning

    def begin_step(self, snes: PETSc.SNES, report: Report) -> None:
        """See ``LinearSolver``."""
        self._snes = snes
        self._has_ended = False
        snes.setJacobian(weakly(self._jacobian), self._A)
        pc = snes.getKSP().getPC()
        pc.setType("python")
        pc.setPythonContext(self._called())

    def hand_to(self, ksp: PETSc.KSP) -> None:
        """Give a KSP the Jacobian, and this as its preconditioner.

        Args:
            ksp: The solver.
        """
        self._A.assemble()
        ksp.setOperators(self._A)
        pc = ksp.getPC()
        pc.setType("python")
        pc.setPythonContext(self._called())

    def update(self, springs: Array | None) -> None:
        """See ``LinearSolver``: the core knows them."""

    def end_step(self, report: Report) -> None:
        """See ``LinearSolver``."""
        self._has_ended = True
        found = self._solver.statistics()
        report.krylov = found.iterations
        report.hierarchies = found.hierarchies
        report.by_bodies = found.by_bodies
        report.uncondensed = found.direct
        report.factorisations = found.factorisations
        for part, seconds in found.seconds.items():
            report.times[part] = report.times.get(part, 0.0) + seconds

    def reset(self) -> None:
        """See ``LinearSolver``."""
        self._solver.reset()
        if not self._has_ended and self._snes is not None:
            # PETSc counts the solves under way, and takes no more than two for ever
            ksp = PETSc.KSP().create(comm=self._snes.comm)
            ksp.setOptionsPrefix(self._snes.getOptionsPrefix())
            self._snes.setKSP(ksp)

    def skipped(self) -> dict[str, int]:
        """See ``LinearSolver``."""
        found = self._solver.statistics()
        direct = len(found.direct)
        others = direct + len(found.by_bodies)
        return {
            "hierarchy": max(0, found.solves - others - found.hierarchies),
            "factorisation": max(0, direct - found.factorised),
        }

    @keeps_its_error
    def _jacobian(self, snes: PETSc.SNES, x: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        self._system.unpack(x)
        A.assemble()

    def _called(self) -> SimpleNamespace:
        """Context of a matrix or preconditioner that PETSc calls."""
        return SimpleNamespace(apply=weakly(self.apply), mult=weakly(self.mult))

    @keeps_its_error
    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b; PETSc calls this."""
        with reproducible_options().in_database():
            self._solver.solve(b.array_r, x.array)

    def mult(self, mat: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = J x; PETSc calls this where the user takes another KSP."""
        self._solver.multiply(x.array_r, y.array)
