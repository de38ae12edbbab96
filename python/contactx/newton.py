# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton loop of PETSc's SNES on the semismooth system of bulk and contacts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import compat
from contactx import cpp as core
from contactx.bulk import Bulk
from contactx.interface import Interface
from contactx.report import Iteration, Report
from contactx.system import SaddlePointSystem

# Share of the closed nodes that may change their status or facet before the pairs are held
_FEW = 0.2

# Rounding errors of a sum of a few terms
_EPS = 16 * np.finfo(np.float64).eps

_REASONS = {
    PETSc.SNES.ConvergedReason.CONVERGED_FNORM_ABS: "the residual is below the tolerance",
    PETSc.SNES.ConvergedReason.DIVERGED_MAX_IT: "no convergence in snes_max_it iterations",
    PETSc.SNES.ConvergedReason.DIVERGED_LINEAR_SOLVE: "the linear solver failed: is a body free "
    "to move without touching anything?",
    PETSc.SNES.ConvergedReason.DIVERGED_FUNCTION_NANORINF: "the residual is not finite: the "
    "material fails, or a body is free to move without touching anything",
    PETSc.SNES.ConvergedReason.DIVERGED_LINE_SEARCH: "the line search failed",
}


class NewtonLoop:
    """Semismooth Newton method.

    Pairs and status change once an accepted iterate, in SNES's convergence test: never inside a
    line search, and the residual that is judged is always that of the new pairs and status. So a
    small residual means equilibrium and complementarity at once.

    Attributes:
        snes: The solver.
    """

    def __init__(
        self,
        bulk: Bulk,
        interfaces: Sequence[Interface],
        system: SaddlePointSystem,
        prefix: str,
        options: Mapping[str, Any],
    ):
        """Create the solver.

        Args:
            bulk: The bulk.
            interfaces: Discrete sides of the contacts.
            system: The coupled system.
            prefix: Prefix of the PETSc options.
            options: Options of the user.
        """
        self._bulk = bulk
        self._interfaces = interfaces
        self._system = system
        self._options = {**_defaults(), **options}
        self._prefix = prefix
        self._A: PETSc.Mat | None = None
        self._A_is_current = False
        self._report = Report()
        self._least_scale = 0.0
        self._held = self._stale = False
        self._changes = (0, 0)
        self._stiffness = np.zeros(0)
        self.snes = PETSc.SNES().create(system.x.comm)
        self.snes.setOptionsPrefix(prefix)
        self.snes.setConvergenceTest(self._test)

    def run(self, report: Report) -> None:
        """Run the loop from the state of the displacement and the contacts.

        Args:
            report: Report to fill in.
        """
        self._report = report
        before = (self._bulk.assemblies, self._bulk.skipped)
        self._system.forget()
        self._system.renew()
        self.snes.setFunction(self._function, self._system.b)
        self._held = False
        for interface in self._interfaces:
            interface.begin_step()
        with self._petsc_options():
            self.snes.setFromOptions()
            self._time_linear_solves(report)
            with report.timing("bulk stiffness"):
                self._stiffness = self._bulk.nodal_stiffness()
            for interface in self._interfaces:
                interface.set_factor(self._stiffness)
            self._changes = self._settle()
            self._system.gather()
            self._A = None
            self._provide_matrix()
            self.snes.solve(None, self._system.x)
        self._system.scatter(self._system.x)
        code = self.snes.getConvergedReason()
        report.converged = code > 0
        report.reason = _REASONS.get(code, f"SNES stopped with reason {code}")
        report.skipped["bulk Jacobian assembly"] = self._bulk.skipped - before[1]

    def _time_linear_solves(self, report: Report) -> None:
        timer = ExitStack()
        ksp = self.snes.getKSP()
        ksp.setPreSolve(lambda *_: timer.enter_context(report.timing("linear solve")))
        ksp.setPostSolve(lambda *_: timer.close())

    @contextmanager
    def _petsc_options(self) -> Iterator[None]:
        """Hold the options in PETSc's database while its objects set themselves up."""
        database = PETSc.Options(self._prefix)
        for name, value in self._options.items():
            database[name] = value
        try:
            yield
        finally:
            for name in self._options:
                del database[name]

    def _function(self, snes: PETSc.SNES, x: PETSc.Vec, b: PETSc.Vec) -> None:
        with self._report.timing("residual"):
            self._system.scatter(x)
            self._system.residual(b)

    def _jacobian(self, snes: PETSc.SNES, x: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        if not self._A_is_current:
            with self._report.timing("Jacobian"):
                self._system.scatter(x)
                self._system.jacobian(A)
        self._A_is_current = False

    def _provide_matrix(self) -> None:
        """Give SNES a matrix that has the pattern of the current pairs."""
        if self._A is not None and self._system.fits():
            return
        with self._report.timing("Jacobian"):
            self._A = self._system.jacobian()
        self._A_is_current = True
        self.snes.setJacobian(self._jacobian, self._A)

    def _settle(self) -> tuple[int, int]:
        """Renew pairs and status at an accepted iterate.

        While many nodes change, the pressures belong to an active set that is far off, and so
        does the deformation: pairs found on it, and the stiffness that its normals have, lead
        astray. So they are held as they are, which makes the contact conditions linear, and the
        active set finds its way as surely as in small sliding. Once few nodes change they follow.

        Returns:
            Number of nodes that changed their status, and of those that changed their facet.
        """
        status, pairs = self._renew()
        self._stale = self._held and self._many(status)
        if self._held and not self._stale:
            self._hold(False)
            more, pairs = self._renew()
            status += more
        self._hold(self._many(status + pairs))
        if self._many(status):
            # What flips on an active set that is far off says nothing of the solution
            for interface in self._interfaces:
                interface.master.forget_flips()
        for interface in self._interfaces:
            interface.drop_open_pressures()
            interface.evaluate_law()
        return status, pairs

    def _renew(self) -> tuple[int, int]:
        status = pairs = 0
        with self._report.timing("search"):
            for interface in self._interfaces:
                pairs += interface.search()
        for interface in self._interfaces:
            interface.update_gap()
            status += interface.update_status()
        return status, pairs

    def _many(self, changes: int) -> bool:
        return changes > max(1, _FEW * self._num_closed())

    def _num_closed(self) -> int:
        return sum(int(np.count_nonzero(i.status != core.OPEN)) for i in self._interfaces)

    def _hold(self, held: bool) -> None:
        self._held = held and any(i.sliding == "finite" for i in self._interfaces)
        for interface in self._interfaces:
            interface.hold(held)

    def _test(
        self, snes: PETSc.SNES, number: int, norms: tuple[float, float, float]
    ) -> PETSc.SNES.ConvergedReason:
        """Accept an iterate: renew pairs and status, and judge the residual they give."""
        reason = PETSc.SNES.ConvergedReason
        if not np.isfinite(norms[2]):
            return reason.DIVERGED_FUNCTION_NANORINF
        if number > 0:
            self._changes = self._settle()
        self._system.gather()
        self._function(snes, self._system.x, self._system.b)
        row = self._judge(number)
        self._report.history.append(row)
        if not np.isfinite(row.residual):
            return reason.DIVERGED_FUNCTION_NANORINF
        size = np.abs(self._bulk.u.x.array).max(initial=0.0)
        small = row.residual <= row.tolerance and row.dirichlet_defect <= 1e-10 * size
        # Held pairs that are not those of this iterate give no true residual
        if small and not self._stale:
            return reason.CONVERGED_FNORM_ABS
        self._provide_matrix()
        return reason.CONVERGED_ITERATING

    def _judge(self, number: int) -> Iteration:
        """Measure the residual against the forces of the problem.

        Displacements enter the Dirichlet rows and are judged apart from the forces, so that the
        judgement does not depend on the units.
        """
        force, *constraints = self._system.blocks(self._system.b.array_r)
        prescribed = self._bulk.markers == 1
        residual = _norm([force[~prescribed], *constraints])
        forces = [self._system.bulk_residual()[prescribed]]
        for interface in self._interfaces:
            forces.append(interface.state.area.array * interface.state.multiplier.array)
        scale = max(_norm([f]) for f in forces)
        if number == 0:
            # Unloading ends without forces. What the first change of the Dirichlet values asks
            # for says little: a stiff body that moves as a whole asks for much and gets nothing
            self._least_scale = max(scale, 1e-6 * residual)
        scale = max(scale, self._least_scale)
        rtol, atol, _, _ = self.snes.getTolerances()
        return Iteration(
            number=number,
            residual=residual,
            tolerance=max(rtol * scale, atol, self._rounding(scale)),
            closed=self._num_closed(),
            status_changes=self._changes[0],
            pair_changes=self._changes[1],
            held=self._held,
            dirichlet_defect=float(np.abs(force[prescribed]).max(initial=0.0)),
        )

    def _rounding(self, scale: float) -> float:
        """Residual that rounding leaves.

        A gap is a difference of positions, the forces of a stiff body sums of stiffness times
        displacement that cancel. Displacements count only while what they leave is small against
        the forces: a body that has run away is no solution.

        Args:
            scale: Forces of the problem.
        """
        block = self._bulk.u.function_space.dofmap.index_map_bs
        u = np.linalg.norm(self._bulk.u.x.array.reshape(-1, block), axis=1)
        gaps, moved = [], [np.nan_to_num(self._stiffness) * u]
        for interface in self._interfaces:
            weight = interface.state.gap_derivative.array
            gaps.append(weight * np.abs(interface.state.position.array).max())
            moved.append(weight * u.max())
        return _EPS * _norm(gaps) + min(_EPS * _norm(moved), 1e-6 * scale)


def _norm(parts: Sequence[npt.NDArray[np.float64]]) -> float:
    return float(np.sqrt(sum(np.dot(p, p) for p in parts)))


def _defaults() -> dict[str, Any]:
    """PETSc options where the user gives none."""
    options: dict[str, Any] = {
        "snes_type": "newtonls",
        "snes_linesearch_type": "basic",
        "snes_rtol": 1e-11,
        "snes_atol": 0.0,
        "snes_max_it": 50,
        "ksp_type": "preonly",
        "pc_type": "lu",
    }
    solver = compat.direct_solver()
    if solver is not None:
        options["pc_factor_mat_solver_type"] = solver
    if solver == "mumps":
        # Room for pivoting on the zero diagonal of the multipliers
        options["mat_mumps_icntl_14"] = 60
    return options
