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

import weakref
from itertools import pairwise
from typing import TYPE_CHECKING

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.callback import keeps_its_error, weakly
from contactx.linear import Condensed, LinearSolver, SaddlePoint
from contactx.report import Report
from contactx.settled import no_convergence
from contactx.step_length import StepLength

if TYPE_CHECKING:
    from contactx.assembler import ContactAssembler

# Difference of a Jacobian from a difference quotient that is no rounding
_WRONG = 1e-3
# Displacements of difference quotients, over the size of the scene
_SIZES = (1e-4, 1e-6, 1e-8)
# Iterates in turn with about the same residual that the bulk alone leaves
_STAGNANT = 4
_WRONG_JACOBIAN = (
    "the Jacobian is not the derivative of F: along the last step it differs by {:.2g} % from a "
    "difference quotient of F. {} (manual: errors/wrong-jacobian)"
)
_ADVICE = {
    True: "Correct J, or leave it out to have it derived",
    False: "F has what ufl.derivative cannot see, such as a coefficient that depends on u: give J",
}
_STAGNATES = (
    "the residual stagnates at {:.3g} while no node changes its status, and the tolerance is "
    "{:.3g}: forces that cancel may leave that much by rounding. Raise snes_rtol, or set snes_atol "
    "to a force that may be neglected (manual: errors/residual-stagnates)"
)
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

    The assembler settles and judges once an accepted iterate, in SNES's convergence test, never
    inside a line search.

    Attributes:
        snes: The solver.
        error: Error of Python inside PETSc; whoever deals with it sets it to None.
    """

    def __init__(self, assembler: ContactAssembler, snes: PETSc.SNES, *, condensed: bool):
        """Set the callbacks of a solver.

        Args:
            assembler: The coupled system.
            snes: The solver.
            condensed: Whether the preconditioner is the condensed solver.
        """
        self._assembler = weakref.ref(assembler)
        self._bulk, self._system = assembler.bulk, assembler.system
        self._loop, self._halo = assembler.loop, assembler.halo
        prefix = snes.getOptionsPrefix() or ""
        self._linear: LinearSolver = (
            Condensed(self._bulk, self._system, assembler.bodies, prefix)
            if condensed
            else SaddlePoint(self._system)
        )
        self._report = Report()
        self.error: BaseException | None = None
        # Version of the state that the Jacobian was made for
        self._version = -1
        self._length = StepLength(self._loop)
        # Why the step has failed, and whether no other way may lead to a solution
        self._failure, self._is_final = "", False
        self._has_full_steps = False
        self.snes = snes
        self.snes.setConvergenceTest(weakly(self._test))
        self.snes.setLineSearchPreCheck(weakly(self._shorten))

    @property
    def assembler(self) -> ContactAssembler:
        """The coupled system."""
        assembler = self._assembler()
        assert assembler is not None
        return assembler

    def begin(self, report: Report) -> None:
        """Start a step that the assembler has started.

        Args:
            report: Report of the step.
        """
        self._report = report
        self._failure, self._is_final = "", False
        self._has_full_steps = self.snes.getLineSearch().getType() == "basic"
        self.snes.setFunction(weakly(self._function), self._system.b)
        self._linear.begin_step(self.snes, report)
        self._version = -1
        self._update_jacobian()

    def end(self, report: Report) -> None:
        """End a step: say why; all ranks must take part.

        Args:
            report: Report of the step, which is written to.
        """
        converged = self.assembler.converged
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
        update = self.snes.getSolutionUpdate()
        way = update.array_r[: self._system.num_displacements].reshape(-1, self._system.block)
        way = self._halo.scatter_forward(way).ravel()[: len(self._bulk.u.x.array)]
        error = self._jacobian_error(way)
        if error > _WRONG:
            return _WRONG_JACOBIAN.format(100 * error, _ADVICE[self._bulk.has_own_jacobian])
        last = self._report.history[-_STAGNANT:]
        residuals = [row.residual for row in last]
        changes = sum(row.status_changes + row.pair_changes for row in last)
        # What falls all the time, if slowly, is not rounding
        falls = all(b < a for a, b in pairwise(residuals))
        stagnant = len(last) == _STAGNANT and max(residuals) <= 4 * min(residuals) and not falls
        if stagnant and changes == 0 and self._loop.convergence.may_be_rounding(min(residuals)):
            return _STAGNATES.format(min(residuals), last[-1].tolerance)
        return ""

    def _jacobian_error(self, way: npt.NDArray[np.float64]) -> float:
        """Smallest of some relative differences of the Jacobian from a difference quotient.

        Args:
            way: Direction, ghosts included.
        """
        extent = self._loop.convergence.extent
        # One size may be too large where the material is about to fail, or too small for rounding
        places = [(part * extent, 0.0) for part in _SIZES]
        # An iterate may lie on kinks of F, such as where bodies begin to yield: one of its
        # derivatives there is as right as another, but none is a quotient across the kink
        places += [(part * extent, _SIZES[0] * extent) for part in _SIZES[1:]]
        error = np.inf
        for size, ahead in places:
            if error > _WRONG:
                error = min(error, self._bulk.jacobian_error(way, size, ahead))
        return error

    @property
    def damping_may_help(self) -> bool:
        """True if damped steps may converge where the last run has failed.

        Not where steps solve what they solve exactly, nor on a user's own line search.
        """
        is_curved = not self._bulk.is_linear or any(
            i.updates_kinematics for i in self.assembler.interfaces
        )
        return is_curved and not self._is_final and self._has_full_steps

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
            self.assembler.moved()
        rtol, atol, _, _ = snes.getTolerances()
        found = self.assembler.judge(rtol, atol)
        if found.is_final:
            self._failure, self._is_final = found.failure, True
            return _CODE.DIVERGED_FUNCTION_DOMAIN
        if found.converged:
            return _CODE.CONVERGED_FNORM_ABS
        if found.failure:
            is_finite = np.isfinite(found.residual)
            return _CODE.DIVERGED_LINE_SEARCH if is_finite else _CODE.DIVERGED_FUNCTION_NANORINF
        self._update_jacobian()
        self._linear.follow(self._loop)
        return _CODE.CONVERGED_ITERATING

    def _update_jacobian(self) -> None:
        """Bring the Jacobian up to the iterate, where something has changed since."""
        if self._version != self._loop.version:
            self._linear.update(self._loop.free_bodies.springs)
        self._version = self._loop.version

    @keeps_its_error
    def _shorten(self, x: PETSc.Vec, step: PETSc.Vec) -> bool:
        """Shorten a Newton step before the line search; returns whether it may have changed."""
        # A line search of the user's would have nowhere to go
        if self._has_full_steps and self._loop.softens(step.array_r):
            step.zeroEntries()
        else:
            self._length.shorten(self.snes, x, step, self._function)
        return True

    def _reason_of(self, code: int, converged: bool) -> str:
        """Why SNES ended.

        Args:
            code: Its reason.
            converged: Whether the contact has converged, too.
        """
        if code == _CODE.DIVERGED_MAX_IT:
            limit = "snes_max_it"
            return no_convergence(limit, limit, is_homogeneous=self._loop.is_homogeneous)
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
