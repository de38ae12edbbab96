# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies in contact: the user's problem."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from petsc4py import PETSc

import ufl
from contactx import cpp as core
from contactx._host import pictures
from contactx._host.callbacks import Interrupts
from contactx._host.checkpoint.snapshot import Snapshot
from contactx._host.options import check_petsc_options, is_condensed, newton_options
from contactx._host.reaction import Reaction, reaction_of
from contactx.assembler import ContactAssembler
from contactx.conductance import Conductance
from contactx.contact import Contact
from contactx.errors import ConvergenceError, NotFiniteError
from contactx.report import Report
from contactx.surface import Surface
from dolfinx import fem


class ContactProblem:
    """Find the displacement u and the contact tractions with F(u; v) + contact(v) = 0 for all v.

    Contact adds the virtual work - sum_s A_s lambda_s . (v_s - sum_l N_l v_l) of its slave nodes s
    to the bulk's residual, with the traction lambda_s = p_s n + t_s that the master exerts on s,
    under g_s >= 0, p_s >= 0, p_s g_s = 0 and Coulomb's law: |t_s| <= mu p_s, without slip where it
    is less, else against the slip. Without friction t_s = 0, and the multiplier is p_s alone. A tie
    has lambda_s of any direction. All this is solved by a semismooth Newton method on the saddle
    point, the primal-dual active set strategy (Alart & Curnier 1991; Hueeber & Wohlmuth 2005); see
    theory/newton of the manual.

    The displacement may be a part of a mixed space, as in Taylor and Hood's elements, or one of
    several functions that are solved for together, such as displacement and temperature.

    Attributes:
        u: Unknown, as given: a function, or a list of functions.
        displacement: Displacement of the nodes: u itself, or a copy where u has more than that.
        contacts: Contacts.
        report: Report of the last solve.
        assembler: The coupled system that is solved.
    """

    def __init__(
        self,
        F: ufl.Form | Sequence[ufl.Form],
        u: fem.Function | Sequence[fem.Function],
        *,
        contacts: Sequence[Contact],
        petsc_options_prefix: str,
        displacement: int | None = None,
        bcs: Sequence[fem.DirichletBC] | None = None,
        J: ufl.Form | Sequence[Sequence[ufl.Form | None]] | None = None,
        conductances: Sequence[Conductance] | None = None,
        petsc_options: Mapping[str, Any] | None = None,
        audit: str = "refuse",
        form_compiler_options: dict[str, Any] | None = None,
        jit_options: dict[str, Any] | None = None,
    ):
        """Create a problem.

        Args:
            F: Residual of the bulk: any UFL form of the bodies, linear in its test function.
                Where u is a list, a residual for each of its functions.
            u: Displacement, in a Lagrange space of vectors of degree 1 or 2 on a mesh of all
                bodies. Its values are the start of the first solve. With ``displacement``, a
                function of a mixed space, or a list of functions, as DOLFINx's NonlinearProblem
                takes them.
            contacts: Contacts of surfaces of the mesh with each other or with rigid obstacles. A
                node may be slave in several.
            petsc_options_prefix: Prefix of the PETSc options, unique in the program.
            displacement: Number of the part of the mixed space, or of the function in the list,
                that is the displacement. It may have bubbles inside of cells. Problems with further
                fields are solved by the direct solver.
            bcs: Dirichlet conditions; none are needed where contact supports the bodies. The list
                may change between solves.
            J: Jacobian of F; derived if None. Of a list of residuals, a list of rows, in which None
                stands for zero.
            conductances: Conductances across contacts, where u is a list that holds their field:
                heat that depends on pressure and gap, for example.
            petsc_options: Options of SNES, its KSP and PC, without the prefix. ``snes_rtol``
                (default 1e-11) is relative to the forces of the problem.
            audit: "refuse" or "warn". A converged iterate whose geometry is wrong (nodes that went
                through the other side, a master that reaches through slave facets between their
                nodes, cells turned inside out) raises a ConvergenceError, or is accepted with a
                warning; ``report.audit`` has the figures.
            form_compiler_options: Options of FFCx.
            jit_options: Options of the compilation.

        Raises:
            TypeError: If PETSc or u are not real double precision, or an argument is of another
                kind.
            ValueError: If a form, space, surface or option does not fit, cells or facets are
                degenerate, a contact surface is curved or faces away from its master, a slave
                surface is folded onto itself, or a body lies wholly inside the other one or the
                obstacle; the message says what to do.
        """
        check_petsc_options(petsc_options, petsc_options_prefix)
        self.assembler = ContactAssembler(
            F,
            u,
            contacts=contacts,
            displacement=displacement,
            bcs=bcs,
            J=J,
            conductances=conductances,
            audit=audit,
            form_compiler_options=form_compiler_options,
            jit_options=jit_options,
        )
        self.u = u
        self.contacts = self.assembler.contacts
        self.report = Report()
        system, options = self.assembler.system, petsc_options or {}
        self.displacement = self.assembler.u
        dofs = self.displacement.x.index_map.size_global * system.block
        condensed = is_condensed(
            options,
            dofs,
            system.block,
            has_friction=system.has_friction,
            has_fields=bool(self.assembler.bulk.fields),
        )
        if self.assembler.bulk.conductances:
            if condensed and "pc_type" in options:
                raise ValueError(
                    "petsc_options['pc_type'] is 'condensed', which is for fields that do not flow "
                    "across contacts: leave it out where there are conductances"
                )
            condensed = False
        self._options = newton_options(petsc_options_prefix, options, condensed=condensed)
        snes = PETSc.SNES().create(system.x.comm)
        snes.setOptionsPrefix(petsc_options_prefix)
        self._newton = self.assembler.newton_loop(snes, condensed=condensed)
        self._read_options = False
        self._made = frozenset(vars(self))

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse to replace what has been read already; it would change nothing."""
        is_free = name.startswith("_") or name == "report" or hasattr(type(self), name)
        made = vars(self).get("_made")
        if made is not None and not is_free and vars(self).get(name) is not value:
            # A class of the user's own may keep what it was given
            is_derived = not type(self).__module__.startswith("contactx.")
            given = inspect.signature(type(self).__init__).parameters
            if name in made or (name in given and not is_derived):
                raise AttributeError(
                    f"{name} cannot be replaced once the {type(self).__name__} is made: change the "
                    "values of the functions, constants and conditions that it has, or make another"
                )
        super().__setattr__(name, value)

    @property
    def solver(self) -> PETSc.SNES:
        """The SNES solver."""
        return self._newton.snes

    def reaction(self, where: fem.DirichletBC | Surface | None = None) -> Reaction:
        """Force of supports on the bodies, with its moment; all ranks must take part.

        It is the sum of what bulk and contacts leave unbalanced at their nodes, as of the last
        solve, with the loads of that solve. Over all supports it is in balance with the loads and
        with the contacts' forces on the bodies from rigid obstacles. In ContactDynamics inertia is
        among the loads, and forces are those of the middle of the step. In an axisymmetric model
        the force along the axis is that of all the circumference, and the radial one the sum of
        radial forces, which have no resultant.

        Args:
            where: A condition: the force that it exerts, in the components that it prescribes. Or a
                surface: the force on all its nodes, which is zero, but for the tolerance, where
                these are free. All conditions of the problem, each dof once, if None.

        Returns:
            The force, ``problem.reaction(bc).force``, and its moment about a point.

        Raises:
            TypeError: If where is something else.
            ValueError: If the condition prescribes no displacement of the problem, or the surface
                is of another mesh.
        """
        return reaction_of(self.assembler, where)

    def plot(
        self,
        path: str | Path | None = None,
        *,
        scale: float = 1.0,
        camera: Sequence[float] | None = None,
    ) -> None:
        """Draw the deformed bodies and the pressures of all contacts; see ``Contact.plot``.

        Args:
            path: The picture, ``.png`` or ``.jpg``; a window if None.
            scale: Factor of the displacement.
            camera: Direction from the bodies to the viewer in 3D, shape (3,).

        Raises:
            ImportError: If PyVista is not installed.
            OSError: If the folder of the picture cannot be made.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, or a number is out of its range.
        """
        pictures.plot(self.contacts, path, scale, camera)

    def find_rigid_modes(self) -> None:
        """Find the rigid modes of free bodies; LoadSteps calls this before it loads a checkpoint.

        They must be those of bodies without stress, as the first solve finds them.
        """
        self.assembler.core.find_rigid_modes()

    def update_ghosts(self) -> None:
        """Give ghosts the owners' displacements, after these were set; all ranks must take part."""
        self.assembler.halo.update_ghosts()

    def snapshot(self, history: Sequence[fem.Function] = ()) -> Snapshot:
        """Copy the state; LoadSteps returns to it where a step fails.

        Args:
            history: Further functions that belong to the state.

        Returns:
            The copy; its ``restore()`` brings the state back.
        """
        return self.assembler.snapshot(history)

    @property
    def beside(self) -> list[fem.Function]:
        """Functions that are solved for besides the displacement, or that hold it."""
        return [w for w in self.assembler.functions if w is not self.displacement]

    def solve(self) -> fem.Function | Sequence[fem.Function]:
        """Solve for the current loads and Dirichlet values, starting from ``u``.

        Returns:
            ``u``.

        Raises:
            ConvergenceError: If the Newton loop fails. The displacement and the contacts are then
                as they were before the call.
            ValueError: If a condition in ``bcs`` is of another space, ``u`` or a Dirichlet value is
                not finite, friction, offset or an obstacle has a value out of its range, a
                LevelSet with friction moves while it is touched, Dirichlet conditions constrain a
                slave node inside a rigid obstacle, or PETSc refuses an option.
        """
        assembler = self.assembler
        assembler.prepare()
        with Interrupts() as interrupts:
            try:
                if not assembler.core.attempt(lambda damped: self._attempt(damped, interrupts)):
                    raise ConvergenceError(self.report.reason, self.report)
                assembler.commit()
                self._warn_of_options()
                interrupts.come()
            except BaseException as error:
                interrupts.wait()
                has_begun = assembler.core.has_begun
                assembler.restore()
                self._newton.reset()
                # An error inside PETSc comes back as the cause of one of PETSc, or without it
                cause = self._newton.take_error() or error.__cause__
                if isinstance(error, PETSc.Error) and cause is not None:
                    error = cause
                # Where the step starts an undefined function is no fault of an iterate
                is_undefined = isinstance(error, core.UndefinedError) and has_begun
                if isinstance(error, NotFiniteError) or is_undefined:
                    self.report.reason = str(error)
                    error = ConvergenceError(self.report.reason, self.report)
                raise error from error.__cause__
        return self.u

    def blocks(self) -> dict[str, PETSc.Mat]:
        """Jacobian of the state that the last solve has found, in blocks [[K, B], [C, D]].

        For eigenvalues, stability and sensitivities about that state, which stays as it is. Rows
        and columns of "K" are the displacements, or all that is solved for, as DOLFINx has them,
        with ones on the diagonal of Dirichlet rows; those of the multipliers follow, see
        ``ContactAssembler.blocks``. All ranks must take part.

        Returns:
            The four blocks by their names.

        Raises:
            RuntimeError: If the state is no solution for the loads and Dirichlet values of now.
        """
        assembler, report = self.assembler, self.assembler.report
        rtol, atol, _, max_it = self.solver.getTolerances()
        try:
            assembler.begin_step()
            if not assembler.settle(rtol, atol, max_it).converged:
                raise RuntimeError(
                    "blocks() was called for loads that were not solved for: call solve() first"
                )
            return assembler.blocks()
        finally:
            assembler.restore()
            self._newton.reset()
            assembler.report = report

    def set_attempt(self, attempt: core.Attempt) -> None:
        """Take what the next solve is an attempt at; LoadSteps calls this.

        Args:
            attempt: The t that it goes over, and what it may cost.
        """
        self.assembler.core.set_attempt(attempt)

    def _attempt(self, damped: bool, interrupts: Interrupts) -> core.Outcome:
        """Attempt the step, with damped steps once full ones have failed."""
        discarded = 0
        if damped:
            discarded = self.report.iterations
            self.assembler.restore()
            self._newton.reset()
        self._run(Report(discarded=discarded, damped=damped))
        interrupts.wait()
        if self.report.converged:
            return core.Outcome.converged
        may_help = self._newton.damping_may_help
        return core.Outcome.failed if may_help else core.Outcome.is_final

    def _run(self, report: Report) -> None:
        """Run the Newton loop once.

        Args:
            report: Report to fill in.
        """
        self.report = report
        newton, snes = self._newton, self.solver
        with report.timing("total"), self._options.in_database():
            self._options.hand_to(snes)
            self._time_linear_solves(report)
            self.assembler.start(report)
            newton.begin(report)
            snes.solve(None, self.assembler.x)
            report.unread = self._options.unread()
            newton.end(report)
            self.assembler.summarise()
            report.skipped.update(newton.skipped())

    def _time_linear_solves(self, report: Report) -> None:
        timer = ExitStack()
        ksp = self.solver.getKSP()
        ksp.setPreSolve(lambda *_: timer.enter_context(report.timing("linear solve")))
        ksp.setPostSolve(lambda *_: timer.close())

    def _warn_of_options(self) -> None:
        """Warn of options that nothing has read, once: some are read but once."""
        report = self.report
        if report.iterations == 0 or self._read_options:
            return
        self._read_options = True
        names = ", ".join(map(repr, report.unread))
        if names:
            self.assembler.say(
                f"petsc_options has {names}, which nothing has read: check the spelling, leave out "
                "the prefix (manual: errors/unread-options)"
            )
