# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Solver of the condensed system."""

from __future__ import annotations

from dataclasses import dataclass

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx._host.bodies import Bodies
from contactx._host.bulk import Bulk
from contactx._host.condensed.multigrid import SLOW_RATE, Multigrid
from contactx._host.condensed.numbering import Array, NodeLayout, Numbering
from contactx._host.condensed.operator import CondensedOperator
from contactx._host.condensed.predictor import Predictor
from contactx._host.condensed.soft_stiff import SoftStiffSolver
from contactx._host.factorised import FactorisedSolver
from contactx._host.options import reproducible_options
from contactx._host.parallel import reduce
from contactx._host.parallel.reduce import agreed
from contactx._host.system import SaddlePointSystem
from contactx.report import Report

# Reasons, as the report says them
_SLOW_MULTIGRID = "multigrid is slow here"
_OPTION = "condensed_pc_type asks for it"
_RETAINED_MULTIPLIERS = "a slave node with a prescribed displacement moves its master"
# Residual of a predicted solution over the tolerance of a solve, up to which it is taken: Newton's
# method leaves as much
_MAX_PREDICTED_RESIDUAL = 300.0
# Residual over right-hand side that no iterate needs to fall below
_MIN_RTOL = 1e-11
# As SLOW_RATE, where stiff bodies and soft ones can be told apart and have a block preconditioner
_SLOW_RATE_OF_MIXED = 6


class CondensedSolver:
    """Solves the system of the Jacobian.

    The multipliers are eliminated and the displacements found by CG, or GMRES where friction slips,
    with a multigrid hierarchy that is updated with the contact. Where multigrid is slow, and where
    multipliers remain unknowns, a block preconditioner of soft and stiff bodies takes its place.
    What cannot be condensed goes to a direct solver whose factors serve several
    Jacobians.

    Attributes:
        target: What the norm of the next solve's residual must fall below, a force.
        is_last: Whether it is to be the last one of the step.
        is_predicted: Whether the last solution was extrapolated from steps before, not solved for.
        by_bodies: Why condensed solves since ``begin_step`` had the block preconditioner of bodies.
        direct: Solves that were not condensed since ``begin_step``, and why.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, bodies: Bodies, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            bodies: The bodies.
            prefix: Prefix of the options of the inner solver.
        """
        self._bulk = bulk
        self._system = system
        self._node_layout = NodeLayout(bulk, system)
        self._factorised = FactorisedSolver(system, prefix + "direct_")
        self._predictor = Predictor(bulk, system)
        owned = bodies.x[: system.num_bulk // system.block]
        self._multigrid = Multigrid(bulk, owned, prefix)
        self._bodies = bodies
        self._soft_stiff = SoftStiffSolver(bulk, bodies, prefix + "bodies_")
        self._prefix = prefix
        self.target = 0.0
        self.is_last = self.is_predicted = False
        # Failures of multigrid, and of the block preconditioner
        self._failures = self._failures_before = (0, 0)
        self.springs: Array | None = None
        self.begin_step(Report())

    def begin_step(self, report: Report) -> None:
        """Start a step.

        Args:
            report: Report whose times are added to.
        """
        self._report = report
        self._failures_before = self._failures
        self._predictor.begin_step()
        self._multigrid.iterations = self._multigrid.hierarchies = 0
        self._factorised.iterations = self._factorised.factorisations = 0
        self._soft_stiff.iterations = self._soft_stiff.factorisations = 0
        self.direct: list[str] = []
        self.by_bodies: list[str] = []
        self._solves = 0

    def reset(self) -> None:
        """Drop the results of earlier solves: after a failed step they are of no use, or half done.

        What the failed step found of multigrid does not count either.
        """
        self._failures = self._failures_before
        self._node_layout.reset()
        self._predictor.reset()
        self._multigrid.reset()
        self._soft_stiff.reset()
        self._factorised.reset()

    @property
    def iterations(self) -> int:
        """Krylov iterations since ``begin_step``, by any of the solvers."""
        solvers = (self._multigrid, self._soft_stiff, self._factorised)
        return sum(solver.iterations for solver in solvers)

    @property
    def hierarchies(self) -> int:
        """Hierarchies made since ``begin_step``."""
        return self._multigrid.hierarchies

    @property
    def factorisations(self) -> int:
        """Factorisations since ``begin_step``, of blocks or of the whole."""
        return self._soft_stiff.factorisations + self._factorised.factorisations

    def skipped(self) -> dict[str, int]:
        """Hierarchies and factorisations of solves that used an older one."""
        direct = len(self.direct)
        others = direct + len(self.by_bodies)
        return {
            "hierarchy": max(0, self._solves - others - self.hierarchies),
            "factorisation": max(0, direct - self._factorised.factorisations),
        }

    def solve(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b.

        Args:
            b: Right-hand side in all unknowns.
            x: Solution, overwritten.
        """
        with reproducible_options().in_database():
            self._solve_somehow(b, x)

    def _solve_somehow(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b, condensed where that serves."""
        self._solves += 1
        self.is_predicted = False
        # What does not converge twice will not, and each attempt is dear
        if self._failures[1] == 2:
            self._solve_directly(b, x, _SLOW_MULTIGRID)
            return
        try:
            with self._report.timing("condensation"):
                system = self._condense(b)
            is_solved = self._solve(system, b, x)
        except core.NotCondensable as reason:
            self._solve_directly(b, x, str(reason))
            return
        if not is_solved:
            self._solve_directly(b, x, _SLOW_MULTIGRID)

    def _solve_condensed(
        self, operator: CondensedOperator, rhs: PETSc.Vec, v: PETSc.Vec, target: float
    ) -> bool:
        """Solve the condensed system, by multigrid where it is fast; whether iterations converged.

        Args:
            operator: The condensed matrix.
            rhs: Right-hand side.
            v: Start of the iterations, overwritten by the solution.
            target: What the norm of the residual must fall below.
        """
        of_multigrid, of_bodies = self._failures
        is_needed = reduce.anywhere(operator.numbering.comm, len(operator.retained) > 0)
        is_asked = PETSc.Options(self._prefix).getString("pc_type", "gamg") == "bodies"
        reason = _OPTION if is_asked else _SLOW_MULTIGRID
        if is_needed:
            reason = _RETAINED_MULTIPLIERS
        if not (is_needed or is_asked) and of_multigrid < 2:
            # Where bodies can be told apart the other solver is fast: one slow solve tells enough
            is_mixed = self._soft_stiff.tells_apart(operator)
            slow = _SLOW_RATE_OF_MIXED if is_mixed else SLOW_RATE
            if self._multigrid.solve(operator, rhs, v, target, self._report, slow):
                return True
            of_multigrid += 2 if is_mixed else 1
        is_solved = self._soft_stiff.solve(operator, rhs, v, target, self._report)
        if is_solved:
            self.by_bodies.append(reason)
        self._failures = of_multigrid, of_bodies + (not is_solved)
        return is_solved

    def _condense(self, b: PETSc.Vec) -> _Condensed:
        """Eliminate the multipliers.

        Raises:
            core.NotCondensable: On all ranks, where a multiplier has no equation of its own.
        """
        nodes = self._node_layout
        nodes.rebuild()
        numbering = nodes.numbering
        with agreed(numbering.comm):
            condensation = core.Condensation(
                self._system.contact_block(b),
                self._system.discrete_contacts,
                nodes.free,
                self._system.block,
                holds=True,
            )
        self._bulk.update()
        self._bulk.rows(condensation.slave_dofs)
        self._bulk.keep_half()
        operator = CondensedOperator(self._bulk, numbering, condensation, self.springs)
        return _Condensed(numbering, operator, condensation)

    def multiply(self, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the Jacobian, y = J x.

        Args:
            x: Vector of all unknowns.
            y: Product, overwritten.
        """
        self._system.multiply_contact(self._system.contact_block(), x, y)
        n = self._system.num_bulk
        u, w = self._bulk.matrix().createVecs()
        u.array[:] = x.array_r[:n]
        self._bulk.matrix().mult(u, w)
        y.array[:n] += w.array_r
        if self.springs is not None:
            y.array[:n] += self.springs * u.array_r

    def _solve(self, system: _Condensed, b: PETSc.Vec, x: PETSc.Vec) -> bool:
        """Solve with the multipliers eliminated; whether the iterations converged."""
        numbering, operator = system.numbering, system.operator
        condensation = system.condensation
        n = numbering.num_owned
        given, constraints = np.split(b.array_r, [n])
        forces, shift, extra, multipliers, held = condensation.right_hand_side(constraints)
        h, w = self._bulk.matrix().createVecs()
        rhs, v = w.duplicate(), h.duplicate()
        w.array[:] = given + numbering.scatter_reverse(forces)
        w.array[operator.retained] = held
        balance = w.duplicate()
        w.copy(balance)
        h.array[:] = operator.place(shift[:n])
        work = w.duplicate()
        operator.bulk(h, work)
        w.axpy(-1.0, work)
        operator.combine(w, rhs)
        operator.add_law(h, rhs, -1.0)
        rhs.array[:] += extra[:n]
        rhs.array[operator.eliminated] = 0
        v.set(0.0)
        predicted = self._predictor.start(
            operator, b, rhs, v, _MAX_PREDICTED_RESIDUAL * self.target
        )
        self.is_predicted = predicted is not None
        if predicted is not None:
            x.array[:] = predicted
            return True
        target = self.target
        if not self.is_last:
            # A small part of what loads a stiff body is much for a soft one
            softness = operator.softness(self._bodies, given)
            target = min(target, max(target * softness, _MIN_RTOL * rhs.norm()))
        if not self._solve_condensed(operator, rhs, v, target):
            return False
        operator.expand(v, work)
        h.axpy(1.0, work)
        operator.bulk(h, work)
        balance.axpy(-1.0, work)
        u = numbering.scatter_forward(h.array_r)
        condensation.recover(constraints, operator.release(balance.array), u, multipliers)
        x.array[:n] = np.where(self._node_layout.free[:n] == 1, h.array_r, given)
        x.array[n:] = multipliers / self._system.core.factors
        return True

    def _solve_directly(self, b: PETSc.Vec, x: PETSc.Vec, reason: str) -> None:
        self.direct.append(reason)
        # With factors one more digit costs nothing
        target = (0.1 if self.is_last else 1.0) * self.target
        self._factorised.solve(b, x, target, self.springs, self._report, last=self.is_last)


@dataclass(frozen=True)
class _Condensed:
    """The system without multipliers, and how they are eliminated and recovered."""

    numbering: Numbering
    operator: CondensedOperator
    condensation: core.Condensation
