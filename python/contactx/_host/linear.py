# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear solvers of the Newton loop: the saddle point as it is, or condensed."""

from __future__ import annotations

from abc import ABC, abstractmethod
from types import SimpleNamespace

from petsc4py import PETSc

from contactx import cpp as core
from contactx._host.bodies import Bodies
from contactx._host.bulk import Bulk
from contactx._host.callbacks import keeps_its_error, weakly
from contactx._host.condensed.numbering import Array
from contactx._host.condensed.solver import CondensedSolver
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

    def follow(self, loop: core.Loop) -> None:
        """Set how accurate the next solve must be.

        Args:
            loop: The loop, which has tested an iterate.
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

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, bodies: Bodies, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            bodies: The bodies.
            prefix: Prefix of the PETSc options.
        """
        self._bulk = bulk
        self._system = system
        self._solver = CondensedSolver(bulk, system, bodies, prefix + "condensed_")
        self._snes: PETSc.SNES | None = None
        self._has_ended = True
        self._accuracy = core.Accuracy(system.has_friction)
        size = system.x.getSizes()
        self._A = PETSc.Mat().createPython((size, size), self._called(), comm=system.x.comm)
        self._A.setUp()

    def begin_step(self, snes: PETSc.SNES, report: Report) -> None:
        """See ``LinearSolver``."""
        self._snes = snes
        self.start(report)
        snes.setJacobian(weakly(self._jacobian), self._A)
        pc = snes.getKSP().getPC()
        pc.setType("python")
        pc.setPythonContext(self._called())

    def start(self, report: Report) -> None:
        """Start a step without a SNES.

        Args:
            report: Report whose times are added to.
        """
        self._has_ended = False
        self._solver.begin_step(report)
        self._accuracy.begin_step()

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
        """See ``LinearSolver``."""
        self._solver.springs = springs

    def follow(self, loop: core.Loop) -> None:
        """See ``LinearSolver``."""
        row, has_cycled = loop.iterate, loop.active_set.cycles > 0
        if self._solver.is_predicted:
            self._accuracy.skip()
        self._accuracy.set(row.residual, row.tolerance, loop.changing(), has_cycled)
        self._solver.target = self._accuracy.target
        self._solver.is_last = self._accuracy.is_last

    def end_step(self, report: Report) -> None:
        """See ``LinearSolver``."""
        self._has_ended = True
        report.krylov = self._solver.iterations
        report.hierarchies = self._solver.hierarchies
        report.by_bodies = list(self._solver.by_bodies)
        report.uncondensed = list(self._solver.direct)
        report.factorisations = self._solver.factorisations

    def reset(self) -> None:
        """See ``LinearSolver``."""
        self._solver.reset()
        if not self._has_ended and self._snes is not None:
            # PETSc counts the solves under way, and takes no more than two for ever
            ksp = PETSc.KSP().create(comm=self._snes.comm)
            ksp.setOptionsPrefix(self._snes.getOptionsPrefix())
            self._snes.setKSP(ksp)
        self._accuracy.reset()

    def skipped(self) -> dict[str, int]:
        """See ``LinearSolver``."""
        return self._solver.skipped()

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
        self._solver.solve(b, x)

    def mult(self, mat: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply, y = J x; PETSc calls this where the user takes another KSP."""
        self._solver.multiply(x, y)
