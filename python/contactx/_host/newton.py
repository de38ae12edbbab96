# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton loop of PETSc's SNES on the semismooth system of bulk and contacts.

All objects that take part in a solve, from contacts to linear solvers, have the same life cycle:

===================== ==================================================================
``begin_step``        a load step starts
``update``            bring what is derived up to the current iterate
``rebuild``           make objects anew as a structure has changed: pairs, halo, sparsity
``halo_changed``      called when the set of nodes on this rank has changed
``accept``            the step has converged
``reset``             drop what was derived: back to as created
``save``, ``load``    the state goes out, and comes in
===================== ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host.callbacks import keeps_its_error, weakly
from contactx._host.linear import LinearSolver
from contactx._host.system import SaddlePointSystem
from contactx.report import Report

_CODE = PETSc.SNES.ConvergedReason
_REASONS = {
    _CODE.CONVERGED_FNORM_ABS: "the residual is below the tolerance",
    _CODE.DIVERGED_LINEAR_SOLVE: "the linear solver failed: is a body free to move without "
    "touching anything? Support it; with a Krylov solver of your own try pc_type lu "
    "(manual: errors/linear-solver-failed)",
    _CODE.DIVERGED_FUNCTION_NANORINF: "the residual is not finite: the material fails, or a body "
    "is free to move without touching anything. Take smaller load steps, or support the body "
    "(manual: errors/residual-not-finite)",
    _CODE.DIVERGED_LINE_SEARCH: "no step is short enough to lead on: cells would turn inside out, "
    "or the residual does not fall. Take smaller load steps (manual: errors/no-step-leads-on)",
}


class NewtonLoop:
    """Semismooth Newton method, the primal-dual active set strategy.

    Pairs and active set are updated once an accepted iterate, in SNES's convergence test, never
    inside a line search.

    Attributes:
        snes: The solver.
        error: Error of Python inside PETSc; whoever deals with it sets it to None.
    """

    def __init__(
        self,
        snes: PETSc.SNES,
        linear: LinearSolver,
        system: SaddlePointSystem,
        problem: core.Problem,
        check: Callable[[float, float], core.Settled],
    ):
        """Set the callbacks of a solver.

        Args:
            snes: The solver.
            linear: What gives it its Jacobian.
            system: The coupled system.
            problem: Driver of the load step.
            check: Updates pairs and active set at an iterate and tests its residual, by the
                relative and the absolute tolerance.
        """
        self._linear = linear
        self._system = system
        self._problem, self._loop = problem, problem.loop
        self._check = check
        self._report = Report()
        self.error: BaseException | None = None
        # Version of the state that the Jacobian was made for
        self._version = -1
        # Why the step has failed, and whether damped steps cannot lead to a solution either
        self._failure, self._is_final = "", False
        self._has_full_steps = False
        # Vectors of the parts of a step that are tried
        self._trial: tuple[PETSc.Vec, ...] | None = None
        self.snes = snes
        self.snes.setConvergenceTest(weakly(self._test))
        self.snes.setLineSearchPreCheck(weakly(self._shorten))

    def begin(self, report: Report) -> None:
        """Start a step that the driver has started.

        Args:
            report: Report of the step.
        """
        self._report = report
        self._failure, self._is_final = "", False
        self._has_full_steps = self.snes.getLineSearch().getType() == "basic"
        if not self._has_full_steps:
            # A line search of the user's would have nowhere to go
            self._loop.bar_path()
        self.snes.setFunction(weakly(self._function), self._system.b)
        self._linear.begin_step(self.snes, report)
        self._version = -1
        self._update_jacobian()

    def end(self, report: Report) -> None:
        """End a step: say why; all ranks must take part.

        Args:
            report: Report of the step, which is written to.
        """
        converged = self._problem.converged
        self._system.unpack(self._system.x)
        code = self.snes.getConvergedReason()
        if not converged and not self._failure:
            self._failure = self._why_slow(code)
            self._is_final = bool(self._failure)
        report.converged = converged
        report.reason = self._failure or self._reason_of(code, converged)
        self._linear.end_step(report)

    def skipped(self) -> dict[str, int]:
        """Names of the work that linear solves have skipped in this step, and how often."""
        return self._linear.skipped()

    def _why_slow(self, code: int) -> str:
        """Reason why iterations came to nothing, if it is not one of the contacts; else empty.

        All ranks must take part.

        Args:
            code: SNES's reason.
        """
        if code not in (_CODE.DIVERGED_MAX_IT, _CODE.DIVERGED_LINE_SEARCH):
            return ""
        return self._problem.why_slow(self.snes.getSolutionUpdate().array_r)

    @property
    def damping_may_help(self) -> bool:
        """True unless damped steps cannot help either, or a line search is the user's own."""
        return not self._is_final and self._has_full_steps

    def take_error(self) -> BaseException | None:
        """Error that a callback raised, once."""
        errors = [keeper.error for keeper in (self, self._linear) if keeper.error is not None]
        self.error = self._linear.error = None
        return errors[0] if errors else None

    def reset(self) -> None:
        """Drop PETSc's work vectors and factors: an error inside PETSc leaves them locked."""
        self.snes.reset()
        self._linear.reset()

    @keeps_its_error
    def _function(self, snes: PETSc.SNES, x: PETSc.Vec, b: PETSc.Vec) -> None:
        with self._report.timing("residual"):
            self._system.unpack(x)
            self._system.residual(b)

    @keeps_its_error
    def _test(
        self, snes: PETSc.SNES, number: int, norms: tuple[float, float, float]
    ) -> PETSc.SNES.ConvergedReason:
        """Update pairs and the active set at an iterate, and test the residual that they give."""
        if not np.isfinite(norms[2]):
            return _CODE.DIVERGED_FUNCTION_NANORINF
        if number > 0:
            self._problem.moved()
        rtol, atol, _, _ = snes.getTolerances()
        found = self._check(rtol, atol)
        if found.is_final:
            self._failure, self._is_final = found.failure, True
            return _CODE.DIVERGED_FUNCTION_DOMAIN
        if found.converged:
            return _CODE.CONVERGED_FNORM_ABS
        if found.failure:
            is_finite = np.isfinite(found.residual)
            return _CODE.DIVERGED_LINE_SEARCH if is_finite else _CODE.DIVERGED_FUNCTION_NANORINF
        self._update_jacobian()
        return _CODE.CONVERGED_ITERATING

    def _update_jacobian(self) -> None:
        """Bring the Jacobian up to the iterate, where something has changed since."""
        if self._version != self._loop.version:
            self._linear.update(self._loop.free_bodies.springs)
        self._version = self._loop.version

    @keeps_its_error
    def _shorten(self, x: PETSc.Vec, step: PETSc.Vec) -> bool:
        """Shorten a Newton step before the line search; returns whether it may have changed."""
        if self._loop.corrects(step.array_r):
            self._function(self.snes, x, self._system.b)
            self.snes.getKSP().solve(self._system.b, step)
        part = self._loop.limit(step.array_r, lambda part: self._next_size(x, step, part))
        if part < 1:
            step.scale(part)
        if self._trial is not None:
            self._function(self.snes, x, self._system.b)
            self._trial = None
        return True

    def _next_size(self, x: PETSc.Vec, step: PETSc.Vec, part: float) -> float:
        """Size of the correction, by the same Jacobian, after a part of a step.

        Args:
            x: The iterate.
            step: What is taken off it.
            part: Part of it.
        """
        if self._trial is None:
            self._trial = tuple(x.duplicate() for _ in range(3))
        there, force, correction = self._trial
        there.waxpy(-part, step, x)
        self._function(self.snes, there, force)
        if not np.isfinite(force.norm()):
            return np.inf
        self.snes.getKSP().solve(force, correction)
        return self._loop.size_of(correction.array_r)

    def _reason_of(self, code: int, converged: bool) -> str:
        """Why SNES ended.

        Args:
            code: Its reason.
            converged: Whether the contact has converged, too.
        """
        if code == _CODE.DIVERGED_MAX_IT:
            limit = "snes_max_it"
            return self._problem.no_convergence(limit, limit)
        return _reason_of(code, converged)


def _reason_of(code: int, converged: bool) -> str:
    """Why SNES ended, if not for the number of iterations.

    Args:
        code: Its reason.
        converged: Whether the contact has converged, too.
    """
    if code > 0 and not converged:
        return (
            f"SNES stopped by itself, with reason {code}, before contact and bulk were in "
            "equilibrium: leave out the option that ends it early, such as a snes_type of another "
            "method or a large snes_stol (manual: errors/snes-stopped)"
        )
    unknown = (
        f"SNES stopped with reason {code}, a negative number of PETSc's SNESConvergedReason: check "
        "the options of SNES, KSP and PC (manual: errors/snes-stopped)"
    )
    return _REASONS.get(code, unknown)
