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

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.audit.audit import Audit
from contactx.bodies import Bodies, BulkSide
from contactx.bulk import Bulk
from contactx.callback import keeps_its_error, weakly
from contactx.convergence import ConvergenceCriterion
from contactx.interface import Interface
from contactx.linear import Condensed, LinearSolver, SaddlePoint
from contactx.options import is_condensed, newton_options
from contactx.parallel.reduce import largest
from contactx.report import Iteration, Report
from contactx.step_length import StepLength
from contactx.system import SaddlePointSystem

# Iterates with unbalanced forces on a free body and settled status after which the loop gives up
_MOST_UNBALANCED = 10

# Why the loop ended, and what to do about it
_UNBALANCED = (
    "the loads on a body cannot be balanced: it has no support and nothing is in its way, or "
    "friction barely could. Support it, or turn the loads so that they press the bodies together"
)
_RAN_AWAY = (
    "a body that nothing holds has moved by {:.3g}, more than the size of the scene: no place was "
    "found where the forces of contact balance. Support it. Where a ring can turn in another one, "
    'take method="surface-to-surface", or numbers of facets that are no multiples of each other'
)
_HIDDEN = (
    "pairs went back and forth between facets and were frozen, and hide a penetration: refine the "
    "coarser surface there, swap slave and master where that is the slave, or take smaller load "
    "steps"
)
# Difference of a Jacobian from a difference quotient that is no rounding
_WRONG = 1e-3
# Iterates in turn with about the same residual that the bulk alone leaves
_STAGNANT = 4
_WRONG_JACOBIAN = (
    "the Jacobian is not the derivative of F: along the last step it differs by {:.2g} % from a "
    "difference quotient of F. "
)
_ADVICE = {
    True: "Correct J, or leave it out to have it derived",
    False: "F has what ufl.derivative cannot see, such as a coefficient that depends on u: give J",
}
_STAGNATES = (
    "the residual stagnates at {:.3g} while no node changes its status, and the tolerance is "
    "{:.3g}: forces that cancel may leave that much by rounding. Raise snes_rtol, or set snes_atol "
    "to a force that may be neglected"
)
_CODE = PETSc.SNES.ConvergedReason
_REASONS = {
    _CODE.CONVERGED_FNORM_ABS: "the residual is below the tolerance",
    _CODE.DIVERGED_MAX_IT: "no convergence in snes_max_it iterations: take smaller load steps; "
    "where nodes still change their status at the end, refine the mesh in contact, else raise "
    "snes_max_it",
    _CODE.DIVERGED_LINEAR_SOLVE: "the linear solver failed: is a body free to move without "
    "touching anything? Support it; with a Krylov solver of your own try pc_type lu",
    _CODE.DIVERGED_FUNCTION_NANORINF: "the residual is not finite: the material fails, or a body "
    "is free to move without touching anything. Take smaller load steps, or support the body",
    _CODE.DIVERGED_LINE_SEARCH: "no step is short enough to lead on: cells would turn inside out, "
    "or the residual does not fall. Take smaller load steps",
}


class NewtonLoop:
    """Semismooth Newton method, the primal-dual active set strategy.

    Pairs and the active set (the closed nodes, and which of them stick) change once an accepted
    iterate, in SNES's convergence test, never inside a line search. The residual that is tested is
    that of the new pairs and the new active set. So a small residual means equilibrium and
    complementarity at once.

    Attributes:
        snes: The solver.
        error: Error of Python inside PETSc; whoever deals with it sets it to None.
    """

    def __init__(
        self,
        bulk: Bulk,
        interfaces: Sequence[Interface],
        bodies: Bodies,
        system: SaddlePointSystem,
        prefix: str,
        options: Mapping[str, Any],
        *,
        names: Sequence[str],
        refuses: bool,
    ):
        """Create the solver.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            bodies: Bodies of the mesh.
            system: The coupled system.
            prefix: Prefix of the PETSc options.
            options: Options of the user.
            names: Names of the contacts, for messages.
            refuses: Whether what the audit finds fails the step; else it is a warning.
        """
        self._bulk = bulk
        self._interfaces = interfaces
        self._system = system
        self._halo = system.halo
        dofs = bulk.u.x.index_map.size_global * system.block
        condensed = is_condensed(options, dofs, system.block)
        self._options = newton_options(prefix, options, condensed=condensed)
        self._linear: LinearSolver = (
            Condensed(bulk, system, bodies.x, prefix) if condensed else SaddlePoint(system)
        )
        self._report = Report()
        self.error: BaseException | None = None
        self._converged = self._has_modes = self._has_full_steps = False
        # Iterates with unbalanced forces on a free body
        self._unbalanced = 0
        # Displacements at the step's start
        self._start = np.zeros(0)
        self._criterion = ConvergenceCriterion(bulk, interfaces, system)
        halo = system.halo
        self._free_bodies = core.FreeBodies(
            bodies, BulkSide(bulk, halo), list(interfaces), halo.original[: halo.num_owned]
        )
        self._active_set = core.ActiveSet(halo.nodes, list(interfaces), self._free_bodies)
        self._forces = core.Forces(
            system.displacement_residual, system.bulk_residual, self._criterion.scale_of_balance
        )
        # Whether the Jacobian is that of the last iterate
        self._is_current = False
        # The iterate before, with hard contact
        self._last: PETSc.Vec | None = None
        self._audit = Audit(bulk, interfaces, system.halo)
        self._length = StepLength(bulk, system, self._audit.cells)
        self._names, self._refuses = names, refuses
        # Why the step has failed, and whether no other way may lead to a solution
        self._failure, self._is_final = "", False
        self.snes = PETSc.SNES().create(system.x.comm)
        self.snes.setOptionsPrefix(prefix)
        self.snes.setConvergenceTest(weakly(self._test))
        self.snes.setLineSearchPreCheck(weakly(self._shorten))

    def run(self, report: Report) -> None:
        """Run the loop from the state of the displacement and the contacts.

        Args:
            report: Report to fill in.
        """
        self._report = report
        self._converged = False
        self._start = self._bulk.u.x.array.copy()
        skipped = self._bulk.skipped
        self._system.begin_step()
        self.snes.setFunction(weakly(self._function), self._system.b)
        self._failure, self._is_final = "", False
        self._unbalanced = 0
        self._last = None
        self._active_set.begin_step()
        self._length.begin_step(damped=report.damped)
        with self._options.in_database():
            self._options.hand_to(self.snes)
            self._has_full_steps = self.snes.getLineSearch().getType() == "basic"
            self._time_linear_solves(report)
            self._linear.begin_step(self.snes, report)
            self._criterion.check_start()
            with report.timing("bulk stiffness"):
                stiffness = self._bulk.nodal_stiffness()
            self._criterion.begin_step(stiffness)
            self._set_factors(stiffness)
            self._system.take_factors()
            self._free_bodies.begin_step()
            self._audit.begin_step()
            self._settle(is_first=True)
            self._system.pack()
            # What asks for the Jacobian before it asks for the residual
            for interface in self._interfaces:
                interface.law.evaluate(interface.nodes)
            self._update_jacobian()
            self.snes.solve(None, self._system.x)
            report.unread = self._options.unread()
        self._system.unpack(self._system.x)
        code = self.snes.getConvergedReason()
        report.converged = self._converged
        if not self._converged and not self._failure:
            self._failure = self._why_slow(code)
            self._is_final = bool(self._failure)
        report.reason = self._failure or _reason_of(code, self._converged)
        report.frozen_gap = min(self._active_set.hidden_gaps, default=0.0)
        self._has_modes |= self._converged
        if self._converged:
            self._criterion.accept()
        self._linear.end_step(report)
        report.soft = self._active_set.soft_iterations
        report.limited, report.shortened = self._length.limited, self._length.damped
        report.cycles = self._active_set.cycles
        report.corners = self._active_set.num_corners()
        report.free_modes = self._free_bodies.free_modes
        report.closed_for_balance = self._free_bodies.closed_for_balance
        report.skipped = Counter({"bulk Jacobian assembly": self._bulk.skipped - skipped})
        report.skipped.update(self._linear.skipped())
        for interface in self._interfaces:
            report.skipped.update({"search": interface.skipped_searches})

    def _why_slow(self, code: int) -> str:
        """Reason why iterations came to nothing, if it is not one of the contacts; else empty.

        All ranks must take part.

        Args:
            code: SNES's reason.
        """
        if code not in (_CODE.DIVERGED_MAX_IT, _CODE.DIVERGED_LINE_SEARCH):
            return ""
        update = self.snes.getSolutionUpdate()
        way = self._system.blocks(update.array_r)[0].reshape(-1, self._system.block)
        way = self._halo.scatter_forward(way).ravel()[: len(self._bulk.u.x.array)]
        # One size may be too large where the material is about to fail, or too small for rounding
        sizes = [part * self._criterion.extent for part in (1e-4, 1e-6, 1e-8)]
        error = min(self._bulk.jacobian_error(way, size) for size in sizes)
        if error > _WRONG:
            return _WRONG_JACOBIAN.format(100 * error) + _ADVICE[self._bulk.has_own_jacobian]
        last = self._report.history[-_STAGNANT:]
        residuals = [row.residual for row in last]
        changes = sum(row.status_changes + row.pair_changes for row in last)
        stagnant = len(last) == _STAGNANT and max(residuals) <= 4 * min(residuals)
        if stagnant and changes == 0 and self._criterion.may_be_rounding(min(residuals)):
            return _STAGNATES.format(min(residuals), last[-1].tolerance)
        return ""

    @property
    def damping_may_help(self) -> bool:
        """Whether damped steps may converge where the last run has failed.

        Not where steps solve what they solve exactly, nor on a user's own line search.
        """
        is_curved = not self._bulk.is_linear or any(i.updates_kinematics for i in self._interfaces)
        return is_curved and not self._is_final and self._has_full_steps

    @property
    def hidden_gaps(self) -> Sequence[float]:
        """Smallest gap that frozen pairs of each contact hide, at the solution."""
        return self._active_set.hidden_gaps

    def accept(self) -> None:
        """Take the converged state as the start of the next step; all ranks must take part."""
        self._audit.accept()

    def find_rigid_modes(self) -> None:
        """Find the free rigid modes of the bodies as they are, as the first run does."""
        self._has_modes = True
        self._free_bodies.begin_step()

    def take_error(self) -> BaseException | None:
        """Error that a callback raised, once."""
        errors = [keeper.error for keeper in (self, self._linear) if keeper.error is not None]
        self.error = self._linear.error = None
        return errors[0] if errors else None

    def reset(self) -> None:
        """Drop PETSc's work vectors and factors: an error inside PETSc leaves them locked."""
        self.snes.reset()
        self._linear.reset()
        if not self._has_modes:
            self._free_bodies.reset()

    def _set_factors(self, stiffness: npt.NDArray[np.float64]) -> None:
        """Set the factor c of each contact's complementarity.

        Args:
            stiffness: Stiffness of each owned node, force/length, NaN where one cannot move.
        """
        own = np.zeros_like(stiffness)
        np.divide(1, stiffness, out=own, where=stiffness > 0)
        compliance = self._halo.scatter_forward(own)
        for interface in self._interfaces:
            interface.set_factor(compliance)

    def _time_linear_solves(self, report: Report) -> None:
        timer = ExitStack()
        ksp = self.snes.getKSP()
        ksp.setPreSolve(lambda *_: timer.enter_context(report.timing("linear solve")))
        ksp.setPostSolve(lambda *_: timer.close())

    @keeps_its_error
    def _function(self, snes: PETSc.SNES, x: PETSc.Vec, b: PETSc.Vec) -> None:
        with self._report.timing("residual"):
            self._system.unpack(x)
            self._system.residual(b)

    def _settle(self, *, is_first: bool = False) -> None:
        """Update pairs and the active set at an accepted iterate.

        Args:
            is_first: Whether the iterate is the step's start.
        """
        # Only all ranks together can free what they have dropped
        PETSc.garbage_cleanup(self._halo.comm)
        for interface in self._interfaces:
            interface.read_values()
        with self._report.timing("settle"):
            self._active_set.settle(self._forces, is_first)
        self._is_current = False

    @keeps_its_error
    def _test(
        self, snes: PETSc.SNES, number: int, norms: tuple[float, float, float]
    ) -> PETSc.SNES.ConvergedReason:
        """Update pairs and the active set at an iterate, and test the residual that they give."""
        reason = PETSc.SNES.ConvergedReason
        if not np.isfinite(norms[2]):
            return reason.DIVERGED_FUNCTION_NANORINF
        if number > 0:
            self._shorten_circle()
            self._take_off_drift()
            self._settle()
            self._active_set.advance(is_full=self._length.part == 1)
        row, small = self._evaluate(snes, number)
        if small and self._active_set.is_soft:
            self._active_set.harden()
            self._is_current = False
            row, small = self._evaluate(snes, number)
        while small:
            end = self._active_set.may_end(self._forces)
            if end == core.ActiveSet.End.solution:
                break
            if end == core.ActiveSet.End.hidden:
                self._failure, self._is_final = _HIDDEN, True
                return reason.DIVERGED_FUNCTION_DOMAIN
            self._is_current = False
            row, small = self._evaluate(snes, number)
        self._report.history.append(row)
        self._active_set.note(row.residual)
        if not self._active_set.is_soft:
            self._last = self._system.x.copy()
        if not np.isfinite(row.residual):
            return reason.DIVERGED_FUNCTION_NANORINF
        if small:
            self._failure = self._look_again()
            # What geometry refuses, another way to the same place does not mend
            self._is_final = bool(self._failure)
            self._converged = not self._failure
            return reason.DIVERGED_FUNCTION_DOMAIN if self._failure else reason.CONVERGED_FNORM_ABS
        if self._length.is_stuck:
            return reason.DIVERGED_LINE_SEARCH
        # In 3D nodes that all slip may balance a body by turning their friction
        shrinks = any(row.residual < 0.7 * r.residual for r in self._report.history[-2:-1])
        if self._is_unbalanced() and not shrinks:
            self._failure, self._is_final = _UNBALANCED, True
            return reason.DIVERGED_FUNCTION_DOMAIN
        self._update_jacobian()
        # Where an active set has come back, only exact solves tell it from its successor
        changes = sum(self._active_set.changes)
        changing = 0.0 if self._active_set.cycles else changes / max(1, row.closed)
        self._linear.set_accuracy(row.residual, row.tolerance, changing)
        return reason.CONVERGED_ITERATING

    def _update_jacobian(self) -> None:
        """Bring the Jacobian up to the iterate, where something has changed since."""
        if not self._is_current:
            self._linear.update(self._free_bodies.springs)
        self._is_current = True

    def _is_unbalanced(self) -> bool:
        """Whether nothing balances a body, now that the active set has settled."""
        if not self._free_bodies.is_unbalanced:
            self._unbalanced = 0
        elif self._active_set.changes[0] == 0:
            self._unbalanced += 1
        return self._unbalanced >= _MOST_UNBALANCED

    @keeps_its_error
    def _shorten(self, x: PETSc.Vec, step: PETSc.Vec) -> bool:
        """Shorten a Newton step before the line search; returns whether it may have changed."""
        parts = self._system.multipliers(step.array_r)
        # A line search of the user's would have nowhere to go
        is_able = self.snes.getIterationNumber() > 0 and self._has_full_steps
        if is_able and self._active_set.softens([-part for part in parts]):
            step.zeroEntries()
        else:
            self._length.shorten(self.snes, x, step, self._function)
        return True

    def _look_again(self) -> str:
        """What is wrong with a converged iterate although its residual is small, or nothing."""
        way = self._way()
        if self._free_bodies.free_modes > 0 and way > self._criterion.farthest():
            return _RAN_AWAY.format(way)
        with self._report.timing("audit"):
            self._report.audit = findings = self._audit(self._names)
        if self._refuses:
            return "; ".join(findings.faults)
        findings.warnings += findings.faults
        return ""

    def _way(self) -> float:
        """Largest component of what any node has moved by in this step."""
        step = np.abs(self._bulk.u.x.array - self._start)
        return float(largest(self._halo.comm, step.max(initial=0.0)))

    def _shorten_circle(self) -> None:
        """Take back a part of the last step, if iterates go round in a circle."""
        if self._last is not None and self._active_set.shortens():
            part = core.ActiveSet.part
            self._system.x.aypx(part, (1 - part) * self._last)
            self._system.unpack(self._system.x)

    def _take_off_drift(self) -> None:
        """Take off what free bodies have drifted in a step of linear contact conditions.

        With current kinematics pressures resist such motions by a little, and steps seek the place
        where they balance.
        """
        if not self._active_set.is_linear:
            return
        drift = self._free_bodies.drift()
        if drift is not None:
            self._system.blocks(self._system.x.array)[0][:] -= drift
            self._system.unpack(self._system.x)

    def _evaluate(self, snes: PETSc.SNES, number: int) -> tuple[Iteration, bool]:
        """Evaluate the residual of an accepted iterate, and whether it is small enough."""
        self._system.pack()
        self._function(snes, self._system.x, self._system.b)
        rtol, atol, _, _ = snes.getTolerances()
        residual, tolerance, defect = self._criterion(rtol, atol)
        row = Iteration(
            number=number,
            residual=residual,
            tolerance=tolerance,
            closed=self._active_set.num_closed(),
            status_changes=self._active_set.changes[0],
            pair_changes=self._active_set.changes[1],
            frozen_kinematics=self._active_set.is_frozen,
            dirichlet_defect=defect,
        )
        size = largest(self._halo.comm, np.abs(self._bulk.u.x.array).max(initial=0.0))
        return row, bool(residual <= tolerance and defect <= 1e-10 * size)


def _reason_of(code: int, converged: bool) -> str:
    """Why SNES ended.

    Args:
        code: Its reason.
        converged: Whether the contact has converged, too.
    """
    if code > 0 and not converged:
        return f"SNES stopped by itself, with reason {code}, before the end"
    return _REASONS.get(code, f"SNES stopped with reason {code}")
