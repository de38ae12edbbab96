# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bulk and contacts as one system, for any Newton loop."""

from __future__ import annotations

import logging
import warnings
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from petsc4py import PETSc

import numpy as np

import ufl
from contactx import cpp as core
from contactx._host import compat
from contactx._host.bodies import Bodies
from contactx._host.bulk import Bulk
from contactx._host.callbacks import weakly
from contactx._host.checkpoint.snapshot import FunctionValues, Snapshot
from contactx._host.checks import (
    as_blocks,
    check_compiler_options,
    check_conditions,
    check_coupled_forms,
    check_finite,
    check_forms,
    have_changed,
    is_number,
)
from contactx._host.linear import Condensed, SaddlePoint
from contactx._host.newton import NewtonLoop
from contactx._host.nodal_values import is_axisymmetric
from contactx._host.nodes import check_cells, reference_positions
from contactx._host.parallel.halo import Halo
from contactx._host.parallel.reduce import agreed
from contactx._host.system import SaddlePointSystem
from contactx._host.unknowns import unknowns_of
from contactx.conductance import Conductance, check_conductances
from contactx.contact import Contact, check_contacts
from contactx.errors import ConvergenceError, NotFiniteError
from contactx.report import Iteration, Report
from dolfinx import fem, la

_logger = logging.getLogger("contactx.iterates")


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
        functions, field = unknowns.functions, unknowns.u
        if displacement is None:
            check_forms(F, J, field)
        else:
            check_coupled_forms(F, J, functions, is_list=isinstance(u, Sequence))
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
        options = form_compiler_options, jit_options
        residuals, jacobians = as_blocks(F, J)
        self.bulk = Bulk(residuals, jacobians, unknowns, bcs or [], *options)
        self.halo = Halo(field, X.array.reshape(-1, gdim))
        self._comm = self.halo.comm
        self.bodies = Bodies(V, self.halo)
        self.discrete_contacts = []
        try:
            for contact in self.contacts:
                self.discrete_contacts.append(
                    contact.attach(self.halo, self.bulk.markers, self.bodies)
                )
            check_cells(V.mesh, self.halo.nodes)
            for conductance in self.conductances:
                conductance.check()
            self.bulk.follow(self.conductances)
            self.system = SaddlePointSystem(self.bulk, self.discrete_contacts, self.halo)
            names = (f"contact {k} ({contact})" for k, contact in enumerate(self.contacts))
            parts = [
                (name, contact.values, contact.fields.results)
                for name, contact in zip(names, self.contacts, strict=True)
            ]
            refuses = audit == "refuse"
            self.core = core.Problem(self.system.core, self.bodies, parts, refuses=refuses)
        except BaseException:
            for contact in self.contacts[: len(self.discrete_contacts)]:
                contact.detach()
            raise
        self._warn_of_weights(residuals[unknowns.index])
        self.loop = self.core.loop
        self._before: FunctionValues | None = None
        self._skipped = 0
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
        self._attached = self.newton_loop(snes, condensed=condensed)

    def newton_loop(self, snes: PETSc.SNES, *, condensed: bool) -> NewtonLoop:
        """Set the callbacks of a SNES; ``attach`` calls this.

        Args:
            snes: The solver.
            condensed: Whether its preconditioner is contactx's condensed solver.

        Returns:
            The loop that runs in it.
        """
        prefix = snes.getOptionsPrefix() or ""
        linear = (
            Condensed(self.bulk, self.system, self.core, prefix)
            if condensed
            else SaddlePoint(self.system)
        )
        loop = NewtonLoop(snes, linear, self.system, self.core, weakly(self.check))
        self.solvers.append(loop)
        return loop

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
        self.enter("begin_step")
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
        self._before = None
        if have_changed(self._bcs, self.bulk.bcs, self._comm):
            self._take_conditions()
        self._collect()
        self.core.prepare()
        for function in self.functions:
            check_finite(self._comm, the_start_of_the_solve_is=function.x)
        self._before = self._function_values()

    def _function_values(self, history: Sequence[fem.Function] = ()) -> FunctionValues:
        """Copy the functions, and further ones that belong to the state."""
        fields = [contact.fields for contact in self.contacts]
        return FunctionValues([self.u, *self.functions, *history], fields)

    def snapshot(self, history: Sequence[fem.Function] = ()) -> Snapshot:
        """Copy the state.

        Args:
            history: Further functions that belong to it.

        Returns:
            The copy; its ``restore()`` brings the state back.
        """
        return Snapshot(self.core, self._function_values(history))

    def _take_conditions(self) -> None:
        """Take the Dirichlet conditions that the user's list has now."""
        check_conditions(self._bcs, self.functions)
        self.bulk.set_conditions(self._bcs)
        for discrete in self.discrete_contacts:
            discrete.set_prescribed(self.bulk.markers)
        for solver in self.solvers:
            solver.reset()

    def _collect(self) -> None:
        """Free PETSc's objects that were dropped, which only all ranks together can."""
        PETSc.garbage_cleanup(self._comm)

    def start(self, report: Report) -> None:
        """Start a step that was prepared; ``begin_step`` does so.

        Args:
            report: Report of the step.

        Raises:
            NotFiniteError: If the residual is not finite.
        """
        self.report = report
        self._skipped = self.bulk.skipped
        self.system.begin_step()
        self.core.start(damped=report.damped)
        self.system.pack()

    def settle(self, rtol: float = 1e-11, atol: float = 0.0, max_it: int = 50) -> core.Settled:
        """Update pairs and active set at an accepted iterate, and test its residual.

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
        self.enter("settle", rtol=rtol, atol=atol, max_it=max_it)
        self._collect()
        found = self._settled(self.core.settle(rtol, atol, int(max_it)))
        if found.failure:
            self.report.reason = found.failure
            raise ConvergenceError(found.failure, self.report)
        return found

    def check(self, rtol: float, atol: float) -> core.Settled:
        """Do the same as ``settle`` without raising an error, for SNES.

        Args:
            rtol: Tolerance relative to the forces of the problem.
            atol: Absolute tolerance, a force.

        Returns:
            The iterate and its figures; ``failure`` says why the loop should end.
        """
        self._collect()
        return self._settled(self.core.judge(rtol, atol, self.system.b.array))

    def _settled(self, found: core.Settled) -> core.Settled:
        """Take note of an iterate that was tested, which may have been taken back."""
        self.system.pack()
        row = Iteration.of(found)
        self.report.history.append(row)
        self.report.take(self.core.report)
        if self._comm.rank == 0:
            _logger.debug("%s", row)
        return found

    @property
    def converged(self) -> bool:
        """True if the iterate of the last ``settle`` is a solution and no step was taken since."""
        return self.core.converged

    def residual(self, b: PETSc.Vec) -> None:
        """Assemble the residual of bulk and contacts at ``u`` and the contacts' multipliers.

        Rows of Dirichlet conditions are displacements minus prescribed ones.

        Args:
            b: Vector of ``create_vector``, overwritten.

        Raises:
            RuntimeError: If no step has begun.
            ValueError: If the vector is of another layout.
        """
        self.enter("residual", b)
        self.core.read()
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
        self.enter("jacobian", A)
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
        as forms, and ``Forms`` assembles them.

        Returns:
            The four blocks by their names.

        Raises:
            RuntimeError: If no step has begun.
        """
        return self.system.blocks(self.jacobian())

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
        self.enter("set_up", condensed=int(condensed))
        self._check_condensed(condensed)
        if not condensed:
            ksp.setOperators(self.jacobian(self._A))
            return
        if self._condensed is None:
            prefix = ksp.getOptionsPrefix() or "contactx_"
            self._condensed = Condensed(self.bulk, self.system, self.core, prefix)
            self.solvers.append(self._condensed)
        self._condensed.hand_to(ksp)

    def _check_condensed(self, condensed: bool) -> None:
        if condensed and self.bulk.conductances:
            raise ValueError(
                "the condensed solver is for fields that do not flow across contacts: leave "
                "condensed out where there are conductances"
            )

    def limit(self, dx: PETSc.Vec) -> float:
        """Return the part of a step that may be taken.

        It keeps each cell from turning inside out. It is zero where the step is the affine one of
        an interior point, whose corrector is solved for next, by the same Jacobian, or where bodies
        are held from now on: ``update`` by this part leaves the iterate as it is, then call
        ``settle`` again. Bodies that pass through
        each other are found by the audit, once the step has converged.

        Args:
            dx: Increment of the unknowns, in the layout of ``create_vector``.

        Returns:
            Part of it, at most 1.

        Raises:
            RuntimeError: If no iterate has settled since the last step was taken.
            ValueError: If the vector is of another layout.
        """
        self.enter("limit", dx)
        return self.core.limit(dx.array_r)

    def update(self, dx: PETSc.Vec, part: float = 1.0) -> None:
        """Add a step to the unknowns: to ``u`` and the contacts' multipliers.

        Args:
            dx: The step.
            part: Part of it.

        Raises:
            RuntimeError: If no step has begun.
            ValueError: If the vector is of another layout, or the part no number.
        """
        self.enter("update", dx, part=part)
        self.core.update(dx.array_r, part)
        self.system.pack()

    def accept(self) -> None:
        """Take the solution as the start of the next step: history is committed.

        Raises:
            ConvergenceError: If an attached SNES has not converged, or a node has come too far
                before it touched; state and contacts are then as they were before the step.
            RuntimeError: If no iterate has settled and converged.
            ValueError: If a LevelSet with friction has moved while it is touched.
        """
        if self._attached is not None and self.core.has_begun:
            self._attached.end(self.report)
            if not self.converged:
                reason = self.report.reason
                self.restore()
                raise ConvergenceError(reason, self.report)
        self.enter("accept")
        self.summarise()
        for solver in (self._attached, self._condensed):
            if solver is not None:
                self.report.skipped.update(solver.skipped())
        try:
            self.commit()
        except ConvergenceError:
            self.restore()
            raise

    def commit(self) -> None:
        """Do the same as ``accept`` without checking the order of calls.

        Raises:
            ConvergenceError: If a node has come too far before it touched.
        """
        report = self.report
        if reason := self.core.accept():
            report.converged = False
            report.reason = reason
            raise ConvergenceError(reason, report)
        report.converged = True
        for contact in self.contacts:
            contact.fields.update()
        found = self.core.report
        report.take(found)
        report.force = [contact.force for contact in self.contacts]
        report.recovery = [contact.fields.recovery_change for contact in self.contacts]
        report.imbalance = np.sum([contact.fields.imbalance for contact in self.contacts], axis=0)
        for text in found.warnings:
            self.say(text)

    def summarise(self) -> None:
        """Write the figures of the step so far into the report; all ranks must take part."""
        report = self.report
        self.core.summarise()
        found = self.core.report
        report.take(found)
        report.skipped = Counter(
            {
                "bulk Jacobian assembly": self.bulk.skipped - self._skipped,
                "search": found.skipped_searches,
            }
        )
        if self._condensed is not None:
            self._condensed.end_step(report)

    def restore(self) -> None:
        """Return to where the last step began, bit for bit, with all contacts."""
        if self._before is not None:
            self._before.restore()
        self.core.restore()
        if self._condensed is not None:
            self._condensed.reset()

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

    def enter(
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
        wanted = self.system.x.getSizes()
        got = wanted if given is None else given.getSizes()
        if isinstance(given, PETSc.Mat):
            wanted = (wanted, wanted)
        with agreed(self._comm):
            if wrong:
                raise TypeError(f"{call}() was given {wrong}: give a number")
            if got != wanted:
                raise ValueError(
                    f"{call}() was given a {type(given).__name__} of the sizes {got} (local, "
                    f"global), but the unknowns are {wanted}: take create_vector(), or the matrix "
                    "that jacobian() returns"
                )
        self.core.enter(call, [(name, float(value)) for name, value in numbers.items()])
