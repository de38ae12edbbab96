# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bulk and contacts as one system, for any Newton loop."""

from __future__ import annotations

import math
import warnings
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from petsc4py import PETSc

import numpy as np

import ufl
from contactx import compat
from contactx import cpp as core
from contactx.arguments import is_number
from contactx.audit.audit import Audit
from contactx.bodies import Bodies
from contactx.bulk import Bulk
from contactx.bulk_input import (
    as_blocks,
    check_compiler_options,
    check_conditions,
    check_coupled_forms,
    check_displacement,
    check_finite,
    check_forms,
    check_prescribed,
    have_changed,
)
from contactx.conductance import Conductance, check_conductances
from contactx.contact import Contact, check_contacts
from contactx.coupled import CoupledBulk
from contactx.errors import ConvergenceError, NotFiniteError
from contactx.geometry.cells import check_cells
from contactx.interface import check_drag, check_over_constrained
from contactx.linear import Condensed
from contactx.newton import NewtonLoop
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo
from contactx.refined import reference_positions
from contactx.report import Report
from contactx.settled import Settled, no_convergence, settled
from contactx.state import Snapshot
from contactx.summary import complete, warning_of
from contactx.system import SaddlePointSystem
from contactx.unknowns import unknowns_of
from contactx.weight import is_axisymmetric
from dolfinx import fem, la

# Methods that all ranks must call at the same time
_CALLS = ("begin_step", "settle", "residual", "jacobian", "set_up", "limit", "update", "accept")


class ContactAssembler:
    """The system of a bulk and its contacts, for a Newton loop of your own.

    The unknowns of a rank are the displacements of its nodes, as ``u`` has them, followed by the
    multipliers of its slave nodes, one contact after the other, divided by each node's
    complementarity factor c so that they are lengths, too. A loop reads::

        assembler = cx.ContactAssembler(F, u, contacts=[contact], bcs=bcs)
        b, dx = assembler.create_vector(), assembler.create_vector()
        assembler.begin_step()
        while not assembler.settle().converged:
            assembler.residual(b)
            assembler.set_up(ksp)
            b.scale(-1)
            ksp.solve(b, dx)
            assembler.update(dx, assembler.limit(dx))
        assembler.accept()

    and ends with a ConvergenceError where no solution is to be expected any more. It is as safe as
    ``ContactProblem``: pairs and status change at accepted iterates only, no step turns cells
    inside out, and a converged iterate is audited before it is accepted. ``ContactProblem`` does
    two more things: it tries damped steps where full ones do not converge, and where a loop fails
    it checks for a wrong Jacobian and for rounding errors.

    All ranks must call all methods, in the same order.

    Attributes:
        u: Displacement of the nodes; a copy where the user's function has more than that.
        functions: Functions that are solved for, the displacement among them.
        contacts: Contacts.
        conductances: Conductances across the contacts.
        report: Report of the step.
    """

    def __init__(
        self,
        F: ufl.Form | Sequence[ufl.Form],
        u: fem.Function | Sequence[fem.Function],
        *,
        contacts: Sequence[Contact],
        displacement: int | None = None,
        bcs: Sequence[fem.DirichletBC] | None = None,
        J: ufl.Form | Sequence[Sequence[ufl.Form | None]] | None = None,
        conductances: Sequence[Conductance] | None = None,
        audit: str = "refuse",
        form_compiler_options: dict[str, Any] | None = None,
        jit_options: dict[str, Any] | None = None,
    ):
        """Couple a bulk with contacts; the arguments are those of ``ContactProblem``.

        Args:
            F: Residual of the bulk, or of each function.
            u: Displacement; or a function of a mixed space, or functions, one of which has it.
            contacts: Contacts.
            displacement: Number of the part or function that is the displacement.
            bcs: Dirichlet conditions.
            J: Jacobian of F; derived if None.
            conductances: Conductances across the contacts, of heat for example.
            audit: "refuse" or "warn".
            form_compiler_options: Options of FFCx.
            jit_options: Options of the compilation.

        Raises:
            TypeError: As ``ContactProblem`` does.
            ValueError: As ``ContactProblem`` does.
        """
        compat.require_real_double()
        unknowns = unknowns_of(u, displacement)
        functions: list[fem.Function] = [u] if unknowns is None else unknowns.functions
        if unknowns is None:
            check_displacement(u)
            check_forms(F, J, u)
        else:
            check_coupled_forms(F, J, functions, is_list=isinstance(u, Sequence))
        field: fem.Function = u if unknowns is None else unknowns.u
        check_conditions(bcs, functions)
        check_compiler_options(form_compiler_options, jit_options)
        check_contacts(contacts)
        self.conductances = check_conductances(conductances, list(contacts), functions, field)
        if audit not in ("refuse", "warn"):
            raise ValueError(f'audit must be "refuse" or "warn", not {audit!r}')

        V = field.function_space
        X = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
        gdim = V.mesh.geometry.dim
        X.array[:] = reference_positions(V).ravel()
        check_finite(V.mesh.comm, coordinates_of_the_mesh_are=X)

        self.u = field
        self.functions = functions
        self.contacts = list(contacts)
        self.report = Report()
        self._bcs: Sequence[fem.DirichletBC] = [] if bcs is None else bcs
        self._refuses = audit == "refuse"
        options = form_compiler_options, jit_options
        residuals, jacobians = as_blocks(F, J)
        self.bulk = (
            Bulk(residuals[0], field, bcs or [], jacobians and jacobians[0][0], *options)
            if unknowns is None
            else CoupledBulk(residuals, jacobians, unknowns, bcs or [], *options)
        )
        self.halo = Halo(field, X.array.reshape(-1, gdim))
        self._comm = self.halo.comm
        self.bodies = Bodies(V, self.halo)
        self.interfaces = []
        try:
            for contact in self.contacts:
                self.interfaces.append(contact.attach(self.halo, self.bulk.markers, self.bodies))
            check_cells(V.mesh)
            for conductance in self.conductances:
                conductance.check()
            if isinstance(self.bulk, CoupledBulk):
                self.bulk.follow(self.conductances)
            self.system = SaddlePointSystem(self.bulk, self.interfaces, self.halo)
            self.loop = core.Loop(self.system.core, self.bodies)
            self._audit = Audit(self.bulk, self.interfaces, self.halo)
        except BaseException:
            for contact in self.contacts[: len(self.interfaces)]:
                contact.detach()
            raise
        self._warn_of_weights(residuals[unknowns.index if unknowns else 0])
        self._names = [f"contact {k} ({contact})" for k, contact in enumerate(self.contacts)]
        self._before: Snapshot | None = None
        # Whether a step has begun, whether a part of it was taken since the last iterate settled,
        # and what that one was
        self._has_begun = self._has_moved = False
        self._found: Settled | None = None
        self._solves = self._skipped = 0
        self._has_modes = False
        # Whether bodies may leave one another for good: no warning then
        self.may_fly = False
        self._A: PETSc.Mat | None = None
        self._condensed: Condensed | None = None
        # Solvers that are reset where the Dirichlet conditions change
        self.solvers: list[Condensed | NewtonLoop] = []
        self._attached: NewtonLoop | None = None

    def create_vector(self) -> PETSc.Vec:
        """Create a vector of all unknowns: displacements, then multipliers over the factor c.

        Returns:
            A new vector, zero; both parts are lengths.
        """
        return self.system.x.duplicate()

    def attach(self, snes: PETSc.SNES, *, condensed: bool = False) -> None:
        """Let a SNES of your own solve the system.

        In each step it is called between ``begin_step`` and ``accept``::

            assembler.attach(problem.solver)
            assembler.begin_step()
            problem.solver.solve(None, assembler.x)
            assembler.accept()

        Its residual, Jacobian, convergence test and the check before its line search are set; what
        options say of its tolerances, line search, KSP and PC stays. snes_rtol is relative to the
        forces of the problem: 1e-11 is usual.

        Args:
            snes: The solver.
            condensed: Whether its preconditioner is contactx's condensed solver, which is exact.
        """
        self._check_condensed(condensed)
        self._attached = NewtonLoop(self, snes, condensed=condensed)
        self.solvers.append(self._attached)

    @property
    def x(self) -> PETSc.Vec:
        """The unknowns that an attached SNES solves for."""
        return self.system.x

    def begin_step(self) -> None:
        """Start a load step from ``u``, with the current loads and Dirichlet values.

        Raises:
            ConvergenceError: If the residual is not finite.
            ValueError: As ``ContactProblem.solve`` does.
        """
        self._enter("begin_step")
        self.prepare()
        try:
            self.start(Report())
            if self._attached is not None:
                self._attached.begin(self.report)
        except NotFiniteError as error:
            self.restore()
            self.report.reason = str(error)
            raise ConvergenceError(str(error), self.report) from None
        except BaseException:
            self.restore()
            raise

    def prepare(self) -> None:
        """Check the state that a step starts from, and save it; ``begin_step`` calls this."""
        self._before, self._has_begun = None, False
        if have_changed(self._bcs, self.bulk.bcs, self._comm):
            self._take_conditions()
        self.bulk.read()
        check_finite(self._comm, the_displacement_u_is=self.u.x)
        for function in self.functions:
            check_finite(self._comm, the_start_of_the_solve_is=function.x)
        prescribed = self.bulk.prescribed()
        check_prescribed(prescribed, self.bulk.markers, self._comm)
        check_over_constrained(self.interfaces, self.contacts, prescribed, self.halo)
        check_drag(self.interfaces, self.contacts)
        self._before = Snapshot(
            self.u, self.contacts, self.halo.update_ghosts, history=self.functions
        )
        self.halo.update_ghosts()

    def _take_conditions(self) -> None:
        """Take the Dirichlet conditions that the user's list has now."""
        check_conditions(self._bcs, self.functions)
        self.bulk.set_conditions(self._bcs)
        for interface in self.interfaces:
            interface.set_prescribed(self.bulk.markers)
        for solver in self.solvers:
            solver.reset()

    def start(self, report: Report) -> None:
        """Start a step that was prepared; ``begin_step`` does so.

        Args:
            report: Report of the step.

        Raises:
            NotFiniteError: If the residual is not finite.
        """
        self.report = report
        self._has_begun = self._has_moved = False
        self._found = None
        self._solves, self._skipped = 0, self.bulk.skipped
        self.system.begin_step()
        if self._condensed is not None:
            self._condensed.start(report)
        with report.timing("bulk stiffness"):
            is_finite = self.loop.begin_step(damped=report.damped)
        if not is_finite:
            raise NotFiniteError(
                "the residual is not finite: the material fails at the start of the step, or a "
                "load or coefficient of F is NaN or infinite. Take smaller load steps, or repair "
                "what sets it (manual: errors/residual-not-finite)"
            )
        self._audit.begin_step()
        self._read_values()
        with report.timing("settle"):
            self.loop.settle_first()
        self.system.pack()
        self._has_begun = True

    def settle(self, rtol: float = 1e-11, atol: float = 0.0, max_it: int = 50) -> Settled:
        """Update pairs and active set at an accepted iterate, and judge its residual.

        The iterate may change a little: where iterates cycle, part of the last step is taken back,
        and the drift of free bodies is subtracted.

        Args:
            rtol: Tolerance relative to the forces of the problem.
            atol: Absolute tolerance, a force.
            max_it: Most linear solves of the step.

        Returns:
            The iterate: its residual, its changes, and whether it is a solution.

        Raises:
            ConvergenceError: If no solution is to be expected any more.
            RuntimeError: If no step has begun.
            ValueError: If friction, offset or an obstacle has a value out of its range.
        """
        self._enter("settle", rtol=rtol, atol=atol, max_it=max_it)
        self._look_anew()
        found = self.judge(rtol, atol)
        reason = found.failure
        if not (reason or found.converged) and found.number >= max_it:
            is_homogeneous = self.loop.is_homogeneous
            reason = no_convergence(str(max_it), "max_it", is_homogeneous=is_homogeneous)
        if reason:
            self.report.reason = reason
            raise ConvergenceError(reason, self.report)
        return found

    def judge(self, rtol: float, atol: float) -> Settled:
        """Do the same as ``settle`` without raising an error, for SNES.

        Args:
            rtol: Tolerance relative to the forces of the problem.
            atol: Absolute tolerance, a force.

        Returns:
            The iterate and its figures; ``failure`` says why the loop should end.
        """
        is_start = self._solves == 0
        if not is_start:
            self._read_values()
        with self.report.timing("settle"):
            verdict = self.loop.judge(is_start, rtol, atol, self.system.b.array)
            # Iterates may have been taken back
            self.system.pack()
        faults = ""
        if verdict == core.Verdict.solution:
            with self.report.timing("audit"):
                self.report.audit = findings = self._audit(self._names)
            if self._refuses:
                faults = "; ".join(findings.faults)
            else:
                findings.warnings += findings.faults
        self._found = settled(
            self._solves,
            verdict,
            self.loop.iterate,
            scale=self.loop.convergence.scale(),
            moved=self._moved(verdict),
            faults=faults,
        )
        if verdict != core.Verdict.hidden:
            self.report.history.append(self._found.row())
        self._has_moved = False
        return self._found

    def _moved(self, verdict: core.Verdict) -> float:
        """What a body that nothing holds has moved by, as the verdict counts it."""
        if verdict == core.Verdict.ran_away:
            return self.loop.way()
        return math.degrees(self.loop.turned()) if verdict == core.Verdict.turned else 0.0

    def _look_anew(self) -> None:
        """Read displacements and loads, which a user may have changed since the last call."""
        self.bulk.read()
        self.halo.update_ghosts()
        self.system.core.begin_step()

    def _read_values(self) -> None:
        """Hand the core friction, offsets and obstacles as they are now."""
        # Only all ranks together can free what they have dropped
        PETSc.garbage_cleanup(self._comm)
        for interface in self.interfaces:
            interface.read_values()

    @property
    def converged(self) -> bool:
        """True if the iterate of the last ``settle`` is a solution and no step was taken since."""
        return self._found is not None and self._found.converged and not self._has_moved

    def residual(self, b: PETSc.Vec) -> None:
        """Assemble the residual of bulk and contacts at ``u`` and the contacts' multipliers.

        Rows of Dirichlet conditions are displacements minus prescribed ones.

        Args:
            b: Vector of ``create_vector``, overwritten.

        Raises:
            RuntimeError: If no step has begun.
            ValueError: If the vector is of another layout.
        """
        self._enter("residual", b)
        self._look_anew()
        self.system.residual(b)

    def jacobian(self, A: PETSc.Mat | None = None) -> PETSc.Mat:
        """Assemble the Jacobian of bulk and contacts: a saddle point.

        Args:
            A: Matrix that the last call returned, to be written to; None for a new one.

        Returns:
            The Jacobian: the same one if the pairs are the same, else a new one.

        Raises:
            RuntimeError: If no step has begun.
            ValueError: If the matrix is none that this has returned last.
        """
        self._enter("jacobian", A)
        if A is not None and (self._A is None or A.handle != self._A.handle):
            raise ValueError(
                "A is not the matrix that jacobian() returned last: pass that one, or None"
            )
        self.halo.update_ghosts()
        self._A = self.system.jacobian(A, self.loop.free_bodies.springs)
        return self._A

    def blocks(self) -> dict[str, PETSc.Mat]:
        """Split the Jacobian into its blocks [[K, B], [C, D]].

        "K" has the rows and columns of the displacements, of bulk and contact; "B" the derivatives
        of the forces by the multipliers; "C" the derivatives of the complementarity conditions by
        the displacements, "D" those by the multipliers. ``Contact.forms`` has the parts of contact
        as forms.

        Returns:
            The four blocks by their names.

        Raises:
            RuntimeError: If no step has begun.
        """
        J = self.jacobian()
        n, size = self.system.num_bulk, self.system.x.getLocalSize()
        first, _ = self.system.x.getOwnershipRange()
        u, w = (
            PETSc.IS().createStride(count, first=first + start, comm=self._comm)
            for start, count in ((0, n), (n, size - n))
        )
        return {
            name: J.createSubMatrix(row, column)
            for name, row, column in (("K", u, u), ("B", u, w), ("C", w, u), ("D", w, w))
        }

    def set_up(self, ksp: PETSc.KSP, *, condensed: bool = False) -> None:
        """Give a KSP of your own the Jacobian of the iterate of the last ``settle``.

        Args:
            ksp: The solver.
            condensed: Whether its preconditioner is contactx's condensed solver: multipliers are
                eliminated, and displacements found by CG or GMRES with multigrid, as accurately as
                the next residual will show. Take "preonly" then.

        Raises:
            RuntimeError: If no iterate has settled since the last step was taken.
        """
        self._enter("set_up", condensed=int(condensed))
        self._check_condensed(condensed)
        if not condensed:
            ksp.setOperators(self.jacobian(self._A))
            return
        if self._condensed is None:
            prefix = ksp.getOptionsPrefix() or "contactx_"
            self._condensed = Condensed(self.bulk, self.system, self.bodies, prefix)
            self.solvers.append(self._condensed)
            self._condensed.start(self.report)
        self._condensed.update(self.loop.free_bodies.springs)
        self._condensed.follow(self.loop)
        self._condensed.hand_to(ksp)

    def _check_condensed(self, condensed: bool) -> None:
        if condensed and self.bulk.fields is not None:
            raise ValueError(
                "the condensed solver is for a displacement alone: leave condensed out where other "
                "fields are solved for with it"
            )

    def limit(self, dx: PETSc.Vec) -> float:
        """Return the part of a step that may be taken.

        It keeps each cell from turning inside out. It is zero where the step would open many nodes
        of slender bodies and contact becomes soft before the next solve: ``update`` by this part
        leaves the iterate as it is, then call ``settle`` again. Bodies that pass through each other
        are found by the audit, once the step has converged.

        Args:
            dx: Increment of the unknowns, in the layout of ``create_vector``.

        Returns:
            Part of it, at most 1.

        Raises:
            RuntimeError: If no iterate has settled since the last step was taken.
            ValueError: If the vector is of another layout.
        """
        self._enter("limit", dx)
        step = -dx.array_r
        if self.loop.softens(step):
            return 0.0
        self.loop.foresee(step)
        size = self.loop.size_of(step)
        self.loop.length.begin(size, self.loop.within_cells(step) if np.isfinite(size) else 1.0)
        return self.loop.length.part

    def update(self, dx: PETSc.Vec, part: float = 1.0) -> None:
        """Add a step to the unknowns: to ``u`` and the contacts' multipliers.

        Args:
            dx: The step.
            part: Part of it.

        Raises:
            RuntimeError: If no step has begun.
            ValueError: If the vector is of another layout, or the part no number.
        """
        self._enter("update", dx, part=part)
        if not np.isfinite(part):
            raise ValueError(f"part is {part}: give a number of at most 1")
        self.system.pack()
        self.system.x.axpy(part, dx)
        self.system.unpack(self.system.x)
        self.moved()

    def moved(self) -> None:
        """Count a linear solve, after which the state is another one; SNES does so."""
        self._has_moved = True
        self._solves += 1

    def accept(self) -> None:
        """Take the solution as the start of the next step: history is committed.

        Raises:
            ConvergenceError: If an attached SNES has not converged; state and contacts are then as
                they were before the step.
            RuntimeError: If no iterate has settled and converged.
            ValueError: If a LevelSet with friction has moved while it is touched.
        """
        if self._attached is not None and self._has_begun:
            self._attached.end(self.report)
            if not self.converged:
                reason = self.report.reason
                self.restore()
                raise ConvergenceError(reason, self.report)
        self._enter("accept")
        self.summarise()
        for solver in (self._attached, self._condensed):
            if solver is not None:
                self.report.skipped.update(solver.skipped())
        self.commit()

    def commit(self) -> None:
        """Do the same as ``accept`` without checking the order of calls."""
        report = self.report
        check_drag(self.interfaces, self.contacts)
        report.converged = True
        self.loop.accept()
        self._has_modes = True
        for contact in self.contacts:
            contact.accept()
        with report.timing("audit"):
            self._audit.accept()
        complete(report, self.contacts, self.halo)
        hidden = self.loop.active_set.hidden_gaps
        for name, interface, gap in zip(self._names, self.interfaces, hidden, strict=True):
            self.say(warning_of(name, interface, gap, self.halo, may_fly=self.may_fly))
        for text in report.audit.warnings:
            self.say(text)
        self._has_begun = False

    def summarise(self) -> None:
        """Write the figures of the step so far into the report; all ranks must take part."""
        report, active_set, bodies = self.report, self.loop.active_set, self.loop.free_bodies
        report.frozen_gap = min(active_set.hidden_gaps, default=0.0)
        report.soft = active_set.soft_iterations
        report.limited, report.shortened = self.loop.length.limited, self.loop.length.damped
        report.cycles = active_set.cycles
        report.corners = active_set.num_corners()
        report.free_modes = bodies.free_modes
        report.closed_for_balance = bodies.closed_for_balance
        report.skipped = Counter({"bulk Jacobian assembly": self.bulk.skipped - self._skipped})
        for interface in self.interfaces:
            report.skipped.update({"search": interface.skipped_searches})
        if self._condensed is not None:
            self._condensed.end_step(report)

    def restore(self) -> None:
        """Return to where the last step began, bit for bit, with all contacts."""
        if self._before is not None:
            self._before.restore()
        self._has_begun = False
        self._found = None
        if self._condensed is not None:
            self._condensed.reset()
        if not self._has_modes:
            self.loop.reset()

    def find_rigid_modes(self) -> None:
        """Find the free rigid modes of the bodies as they are, as the first step does."""
        self._has_modes = True
        self.loop.find_rigid_modes()

    def say(self, text: str) -> None:
        """Warn on rank 0.

        Args:
            text: The warning; nothing happens if it is empty.
        """
        if text and self._comm.rank == 0:
            # Of the user's line, whether that calls solve or a loop of steps does
            warnings.warn(text, skip_file_prefixes=(str(Path(__file__).parent),))

    def _warn_of_weights(self, F: ufl.Form) -> None:
        """Warn of a bulk that is integrated with r where a contact is not."""
        plain = [str(contact) for contact in self.contacts if not contact.is_weighted]
        if plain and is_axisymmetric(F):
            self.say(
                "all that F integrates over cells has a coordinate as a factor, as in an "
                f"axisymmetric model, but {', '.join(plain)} has no weight: give Contact("
                "..., weight=2 * ufl.pi * r), or leave that factor out of F (manual: "
                "errors/missing-weight)"
            )

    def _enter(
        self, call: str, given: PETSc.Vec | PETSc.Mat | None = None, **numbers: float
    ) -> None:
        """Check that a call is in order; all ranks must take part.

        Args:
            call: Name of the method.
            given: Vector or matrix that must fit.
            numbers: Other arguments, which must be the same on all ranks.

        Raises:
            RuntimeError: If ranks call different methods, or it is not this one's turn.
            TypeError: If an argument is no number on any rank.
            ValueError: If a vector or matrix is of another layout, or arguments differ.
        """
        wrong = ", ".join(f"{k}={v!r}" for k, v in numbers.items() if not is_number(v))
        values = [] if wrong else [float(value) for value in numbers.values()]
        calls = self._comm.allgather((_CALLS.index(call), wrong, values))
        if len({k for k, _, _ in calls}) > 1:
            names = ", ".join(f"{_CALLS[k]}() on rank {r}" for r, (k, _, _) in enumerate(calls))
            raise RuntimeError(
                f"all ranks must call the same method of a ContactAssembler: {names}"
            )
        wrong = next((text for _, text, _ in calls if text), "")
        if wrong:
            raise TypeError(f"{call}() was given {wrong}: give a number")
        for name, *each in zip(numbers, *(theirs for _, _, theirs in calls), strict=True):
            # NaN is unlike itself
            if len(set(map(str, each))) > 1:
                raise ValueError(
                    f"{name} of {call}() differs between ranks, {', '.join(map(str, each))}: give "
                    "the same on all"
                )
        if call != "begin_step" and not self._has_begun:
            raise RuntimeError(
                f"{call}() before begin_step(): no step has begun, call begin_step() first"
            )
        if call in ("set_up", "limit", "accept") and (self._has_moved or self._found is None):
            raise RuntimeError(
                f"{call}() before settle(): pairs and active set are not those of the iterate, "
                "call settle() first"
            )
        if call == "accept" and not self.converged:
            raise RuntimeError(
                "accept() of an iterate that is no solution: go on until settle() says converged, "
                "or restore()"
            )
        if given is None:
            return
        with agreed(self._comm):
            wanted, got = self.system.x.getSizes(), given.getSizes()
            if isinstance(given, PETSc.Mat):
                wanted = (wanted, wanted)
            if got != wanted:
                raise ValueError(
                    f"{call}() was given a {type(given).__name__} of the sizes {got} (local, "
                    f"global), but the unknowns are {wanted}: take create_vector(), or the matrix "
                    "that jacobian() returns"
                )
