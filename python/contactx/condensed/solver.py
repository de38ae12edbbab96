# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Solver of the condensed system."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx.bulk import Bulk
from contactx.callback import Quiet
from contactx.condensed.guess import Guess
from contactx.condensed.multigrid import Multigrid
from contactx.condensed.numbering import Array, Numbering, Surroundings
from contactx.condensed.operator import CondensedOperator
from contactx.factorised import FactorisedSolver
from contactx.options import ROUNDING
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.report import Report
from contactx.system import SaddlePointSystem

_SLOW = "multigrid is slow here"
# Most solves of nearly the same system for one solution, and how accurate each is
_CORRECTIONS = 30
_NEARLY = 0.1


class CondensedSolver:
    """Solves the system of the Jacobian.

    The multipliers are eliminated and the displacements found by CG, or GMRES where friction slips,
    with a multigrid hierarchy that is updated with the contact. What cannot be condensed, and
    bodies on which multigrid is slow, go to a direct solver whose factors serve several Jacobians.

    Attributes:
        target: What the norm of the next solve's residual must fall below, a force.
        finer_target: The same where what is condensed is nearly the system.
        is_last: Whether it is to be the last one of the step.
        direct: Solves that were not condensed since ``begin_step``, and why.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, x: Array, prefix: str):
        """Create the solver.

        Args:
            bulk: The bulk.
            system: The coupled system.
            x: Reference positions, those of owned nodes first, shape (num_nodes, gdim).
            prefix: Prefix of the options of the inner solver.
        """
        self._bulk = bulk
        self._system = system
        self._surroundings = Surroundings(bulk, system)
        self._factorised = FactorisedSolver(system, prefix + "direct_")
        self._guess = Guess()
        self._multigrid = Multigrid(bulk, x[: system.num_bulk // system.block], prefix)
        self.target = self.finer_target = 0.0
        self.is_last = False
        self._failures = self._failures_before = 0
        self.springs: Array | None = None
        self.begin_step(Report())

    def begin_step(self, report: Report) -> None:
        """Start a step.

        Args:
            report: Report whose times are added to.
        """
        self._report = report
        self._failures_before = self._failures
        self._guess.begin_step()
        self._multigrid.iterations = self._multigrid.hierarchies = 0
        self._factorised.iterations = self._factorised.factorisations = 0
        self.direct: list[str] = []
        self._solves = 0

    def reset(self) -> None:
        """Drop what earlier solves have left: after a failed step it is of no use, or half done.

        What the failed step found of multigrid does not count either.
        """
        self._failures = self._failures_before
        self._surroundings.reset()
        self._guess.reset()
        self._multigrid.reset()
        self._factorised.reset()

    @property
    def iterations(self) -> int:
        """Krylov iterations since ``begin_step``, with a hierarchy or with older factors."""
        return self._multigrid.iterations + self._factorised.iterations

    @property
    def hierarchies(self) -> int:
        """Hierarchies made since ``begin_step``."""
        return self._multigrid.hierarchies

    @property
    def factorisations(self) -> int:
        """Factorisations since ``begin_step``, where it could not be condensed."""
        return self._factorised.factorisations

    def skipped(self) -> dict[str, int]:
        """Hierarchies and factorisations of solves that used an older one."""
        direct = len(self.direct)
        return {
            "hierarchy": max(0, self._solves - direct - self.hierarchies),
            "factorisation": max(0, direct - self.factorisations),
        }

    def solve(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve J x = b.

        Args:
            b: Right-hand side in all unknowns.
            x: Solution, overwritten.
        """
        self._solves += 1
        # What does not converge twice will not, and each attempt is dear
        if self._failures == 2:
            self._solve_directly(b, x, _SLOW)
            return
        try:
            with self._report.timing("condensation"):
                A, system, is_exact = self._condense(b)
        except core.NotCondensable as reason:
            self._solve_directly(b, x, str(reason))
            return
        solve = partial(self._solve, system)
        if not (solve(b, x, self.target) if is_exact else self._correct(solve, A, b, x)):
            self._failures += 1
            self._solve_directly(b, x, _SLOW)

    def _condense(self, b: PETSc.Vec) -> tuple[core.ContactBlock, _Condensed, bool]:
        """Eliminate the multipliers.

        Returns:
            This rank's contact entries, the condensed system, and whether it stands for them.

        Raises:
            core.NotCondensable: On all ranks, where a multiplier has no equation of its own.
        """
        around = self._surroundings
        around.rebuild()
        numbering = around.numbering
        with agreed(numbering.comm):
            A = self._system.contact_block(b)
            condensation = core.Condensation(
                A,
                self._system.interfaces,
                around.is_slave,
                around.free,
                self._system.block,
            )
        condensation.check_chains(numbering.nodes)
        self._bulk.update()
        self._bulk.rows(condensation.slave_dofs)
        self._bulk.keep_half()
        operator = CondensedOperator(self._bulk, numbering, condensation, self.springs)
        is_exact = reduce.everywhere(numbering.comm, condensation.is_exact)
        return A, _Condensed(numbering, operator, condensation), is_exact

    def _correct(
        self,
        solve: Callable[[PETSc.Vec, PETSc.Vec, float], bool],
        contact: core.ContactBlock,
        b: PETSc.Vec,
        x: PETSc.Vec,
    ) -> bool:
        """Solve J x = b by FGMRES with a solver of nearly the same system."""
        norm = b.norm()
        part = max(_NEARLY, 0.5 * self.finer_target / norm) if norm > 0 else 1.0
        nearly = _Nearly(solve, partial(self._multiply, contact), part)
        J = PETSc.Mat().createPython((x.getSizes(), x.getSizes()), nearly, comm=x.comm)
        ksp = PETSc.KSP().create(comm=x.comm)
        ksp.setOperators(J)
        ksp.setType("fgmres")
        ksp.getPC().setType("python")
        ksp.getPC().setPythonContext(nearly)
        ksp.setTolerances(rtol=ROUNDING, atol=self.finer_target, max_it=_CORRECTIONS)
        with nearly.quiet:
            ksp.solve(b, x)
        converged = ksp.getConvergedReason() > 0 and not nearly.has_failed
        # The matrix refers back to the solver
        ksp.destroy()
        J.destroy()
        return converged

    def multiply(self, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply by the Jacobian, y = J x.

        Args:
            x: Vector of all unknowns.
            y: Product, overwritten.
        """
        self._multiply(self._system.contact_block(), x, y)

    def _multiply(self, contact: core.ContactBlock, x: PETSc.Vec, y: PETSc.Vec) -> None:
        self._system.multiply_contact(contact, x, y)
        n = self._system.num_bulk
        u, w = self._bulk.matrix().createVecs()
        u.array[:] = x.array_r[:n]
        self._bulk.matrix().mult(u, w)
        y.array[:n] += w.array_r
        if self.springs is not None:
            y.array[:n] += self.springs * u.array_r

    def _solve(self, system: _Condensed, b: PETSc.Vec, x: PETSc.Vec, target: float) -> bool:
        """Solve with the multipliers eliminated; whether the iterations converged."""
        numbering, operator = system.numbering, system.operator
        condensation = system.condensation
        n = numbering.num_owned
        given, constraints = np.split(b.array_r, [n])
        forces, shift, extra, multipliers = condensation.right_hand_side(constraints)
        h, w = self._bulk.matrix().createVecs()
        rhs, v = w.duplicate(), h.duplicate()
        w.array[:] = given + numbering.scatter_reverse(forces)
        balance = w.duplicate()
        w.copy(balance)
        h.array[:] = shift[:n]
        work = w.duplicate()
        operator.bulk(h, work)
        w.axpy(-1.0, work)
        operator.combine(w, rhs)
        operator.add_law(h, rhs, -1.0)
        rhs.array[:] += extra[:n]
        rhs.array[operator.eliminated] = 0
        v.set(0.0)
        self._guess.start(operator, rhs, v)
        if not self._multigrid.solve(operator, rhs, v, target, self._report):
            return False
        self._guess.keep(v)
        operator.expand(v, work)
        h.axpy(1.0, work)
        operator.bulk(h, work)
        balance.axpy(-1.0, work)
        u = numbering.scatter_forward(h.array_r)
        condensation.recover(constraints, balance.array_r, u, multipliers)
        x.array[:n] = np.where(self._surroundings.free[:n] == 1, h.array_r, given)
        x.array[n:] = multipliers / self._system.core.factors
        return True

    def _solve_directly(self, b: PETSc.Vec, x: PETSc.Vec, reason: str) -> None:
        self.direct.append(reason)
        # With factors one more digit costs nothing
        target = (0.1 if self.is_last else 1.0) * self.target
        self._factorised.solve(b, x, target, self.springs, self._report, last=self.is_last)


@dataclass(frozen=True)
class _Condensed:
    """The system without multipliers, and the way there and back."""

    numbering: Numbering
    operator: CondensedOperator
    condensation: core.Condensation


class _Nearly:
    """A matrix with a solver of nearly the same system, as PETSc calls them."""

    def __init__(
        self,
        solve: Callable[[PETSc.Vec, PETSc.Vec, float], bool],
        multiply: Callable[[PETSc.Vec, PETSc.Vec], None],
        part: float,
    ):
        """Take both, and the part of a right-hand side that a solve may leave."""
        self._solve, self._multiply, self._part = solve, multiply, part
        self.has_failed = False
        self.quiet = Quiet()

    def apply(self, pc: PETSc.PC, b: PETSc.Vec, x: PETSc.Vec) -> None:
        """Solve, to a part of the right-hand side."""
        self.quiet.call(lambda: self._apply(b, x), x)

    def _apply(self, b: PETSc.Vec, x: PETSc.Vec) -> None:
        if self.has_failed or not self._solve(b, x, self._part * b.norm()):
            self.has_failed = True
            x.zeroEntries()

    def mult(self, mat: PETSc.Mat, x: PETSc.Vec, y: PETSc.Vec) -> None:
        """Multiply."""
        self.quiet.call(lambda: self._multiply(x, y), y)
