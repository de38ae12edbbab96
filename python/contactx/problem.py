# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies in contact: the user's problem."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from petsc4py import PETSc

import numpy as np

import ufl
from contactx import compat
from contactx.bodies import Bodies
from contactx.bulk import Bulk
from contactx.bulk_input import (
    check_compiler_options,
    check_conditions,
    check_displacement,
    check_finite,
    check_forms,
    check_prescribed,
    check_same_conditions,
)
from contactx.contact import Contact, check_contacts
from contactx.errors import ConvergenceError, NotFiniteError
from contactx.geometry.cells import check_cells
from contactx.geometry.curved import check_straight
from contactx.interface import Interface, check_drag, check_over_constrained
from contactx.interrupts import Interrupts
from contactx.newton import NewtonLoop
from contactx.nodal import reference_positions
from contactx.options import check_petsc_options
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, least, total
from contactx.report import Report
from contactx.state import Snapshot
from contactx.system import SaddlePointSystem
from dolfinx import fem, la


class ContactProblem:
    """Find the displacement u and the contact tractions with F(u; v) + contact(v) = 0 for all v.

    Contact adds the virtual work - sum_s A_s lambda_s . (v_s - sum_l N_l v_l) of its slave nodes s
    to the bulk's residual, with the traction lambda_s = p_s n + t_s that the master exerts on s,
    under g_s >= 0, p_s >= 0, p_s g_s = 0 and Coulomb's law: |t_s| <= mu p_s, without slip where it
    is less, else against the slip. Without friction t_s = 0, and the multiplier is p_s alone. A tie
    has lambda_s of any direction. All this is solved by a semismooth Newton method on the saddle
    point, the primal-dual active set strategy (Alart & Curnier 1991; Hueeber & Wohlmuth 2005).

    Attributes:
        u: Displacement.
        contacts: Contacts.
        report: Report of the last solve.
    """

    def __init__(
        self,
        F: ufl.Form,
        u: fem.Function,
        *,
        contacts: Sequence[Contact],
        petsc_options_prefix: str,
        bcs: Sequence[fem.DirichletBC] | None = None,
        J: ufl.Form | None = None,
        petsc_options: Mapping[str, Any] | None = None,
        audit: str = "refuse",
        form_compiler_options: dict[str, Any] | None = None,
        jit_options: dict[str, Any] | None = None,
    ):
        """Create a problem.

        Args:
            F: Residual of the bulk: any UFL form of the bodies, linear in its test function.
            u: Displacement, in the linear Lagrange space of vectors on a mesh of all bodies.
                Its values are the start of the first solve.
            contacts: Contacts of surfaces of the mesh with each other or with rigid obstacles. A
                node may be slave in several.
            petsc_options_prefix: Prefix of the PETSc options, unique in the program.
            bcs: Dirichlet conditions; none are needed where contact supports the bodies.
            J: Jacobian of F; derived if None.
            petsc_options: Options of SNES, its KSP and PC, without the prefix. ``snes_rtol``
                (default 1e-11) is relative to the forces of the problem.
            audit: What becomes of a converged iterate that geometry shows to be wrong: nodes that
                went through the other side, a master that reaches through slave facets between
                their nodes, cells turned inside out. "refuse" raises a ConvergenceError, "warn"
                accepts it with a warning; ``report.audit`` has the figures.
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
        compat.require_real_double()
        check_displacement(u)
        check_forms(F, J, u)
        check_conditions(bcs, u)
        check_compiler_options(form_compiler_options, jit_options)
        check_petsc_options(petsc_options, petsc_options_prefix)
        check_contacts(contacts)
        if audit not in ("refuse", "warn"):
            raise ValueError(f'audit must be "refuse" or "warn", not {audit!r}')
        check_straight(contacts, u.function_space.mesh)

        V = u.function_space
        X = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
        gdim = V.mesh.geometry.dim
        X.array[:] = reference_positions(V).ravel()
        comm = V.mesh.comm
        check_finite(comm, coordinates_of_the_mesh_are=X)

        self.u = u
        self.contacts = list(contacts)
        self.report = Report()
        self._bcs: Sequence[fem.DirichletBC] = [] if bcs is None else bcs
        self._bulk = Bulk(F, u, bcs or [], J, form_compiler_options, jit_options)
        self._halo = Halo(u, X.array.reshape(-1, gdim))
        bodies = Bodies(V, self._halo)
        self._interfaces = []
        self._read_options = False
        try:
            for contact in self.contacts:
                self._interfaces.append(contact.attach(self._halo, self._bulk.markers, bodies))
            check_cells(V.mesh)
            self._system = SaddlePointSystem(self._bulk, self._interfaces, self._halo)
            self._newton = NewtonLoop(
                self._bulk,
                self._interfaces,
                bodies,
                self._system,
                petsc_options_prefix,
                petsc_options or {},
                names=[f"contact {k} ({contact})" for k, contact in enumerate(self.contacts)],
                refuses=audit == "refuse",
            )
        except BaseException:
            for contact in self.contacts[: len(self._interfaces)]:
                contact.detach()
            raise

    @property
    def solver(self) -> PETSc.SNES:
        """The SNES solver."""
        return self._newton.snes

    def find_rigid_modes(self) -> None:
        """Find the rigid modes of free bodies; LoadSteps calls this before it loads a checkpoint.

        They must be those of bodies without stress, as the first solve finds them.
        """
        self._newton.find_rigid_modes()

    def update_ghosts(self) -> None:
        """Give ghosts the owners' displacements, after these were set; all ranks must take part."""
        self._halo.update_ghosts()

    def solve(self) -> fem.Function:
        """Solve for the current loads and Dirichlet values, starting from ``u``.

        Returns:
            The displacement ``u``.

        Raises:
            ConvergenceError: If the Newton loop fails. The displacement and the contacts are then
                as they were before the call.
            ValueError: If the list ``bcs`` has changed since the problem was made, ``u`` or a
                Dirichlet value is not finite, friction, offset or an obstacle has become what it
                must not be, a LevelSet with friction moves while it is touched, Dirichlet
                conditions constrain a slave node inside a rigid obstacle, or PETSc refuses an
                option.
        """
        check_same_conditions(self._bcs, self._bulk.bcs, self._halo.comm)
        check_finite(self._halo.comm, the_displacement_u_is=self.u.x)
        prescribed = self._bulk.prescribed()
        check_prescribed(prescribed, self._bulk.markers, self._halo.comm)
        check_over_constrained(self._interfaces, self.contacts, prescribed, self._halo)
        check_drag(self._interfaces, self.contacts)
        before = Snapshot(self.u, self.contacts, self._halo.update_ghosts)
        self._halo.update_ghosts()
        self.report = report = Report()
        with Interrupts() as interrupts:
            try:
                with report.timing("total"):
                    self._newton.run(report)
                interrupts.wait()
                if not report.converged and self._newton.damping_may_help:
                    before.restore()
                    self._newton.reset()
                    self.report = report = Report(discarded=report.iterations, damped=True)
                    with report.timing("total"):
                        self._newton.run(report)
                    interrupts.wait()
                if not report.converged:
                    raise ConvergenceError(report.reason, report)
                check_drag(self._interfaces, self.contacts)
                for contact in self.contacts:
                    contact.accept()
                with report.timing("audit"):
                    self._newton.accept()
                self._complete(report)
                interrupts.come()
            except BaseException as error:
                interrupts.wait()
                before.restore()
                self._newton.reset()
                # An error inside PETSc comes back as the cause of one of PETSc, or without it
                cause = self._newton.take_error() or error.__cause__
                if isinstance(error, PETSc.Error) and cause is not None:
                    error = cause
                if isinstance(error, NotFiniteError):
                    report.reason = str(error)
                    error = ConvergenceError(report.reason, report)
                raise error from error.__cause__
        return self.u

    def _complete(self, report: Report) -> None:
        comm, interfaces = self._halo.comm, self._interfaces
        report.slaves, report.pairs, report.immobile, report.frozen_pairs = total(
            comm,
            np.array(
                [
                    sum(len(i.slaves) for i in interfaces),
                    sum(i.master.paired.sum() for i in interfaces),
                    sum(i.nodes.immobile.sum() for i in interfaces),
                    sum(len(i.master.frozen_pairs) for i in interfaces),
                ]
            ),
        ).tolist()
        histories = [i.history for i in interfaces if i.history is not None]
        report.slip, report.dissipation = total(
            comm,
            np.array(
                [
                    sum(np.linalg.norm(h.slip, axis=1).sum() for h in histories),
                    sum(h.dissipation.sum() for h in histories),
                ],
                dtype=np.float64,
            ),
        ).tolist()
        report.force = [contact.force for contact in self.contacts]
        report.recovery = [contact.fields.recovery_change for contact in self.contacts]
        report.imbalance = np.sum([contact.fields.imbalance for contact in self.contacts], axis=0)
        for k, interface in enumerate(self._interfaces):
            self._warn(k, interface, self._newton.hidden_gaps[k])
        for text in report.audit.warnings:
            self._say(text)
        if report.iterations > 0 and not self._read_options:
            # Some are read but once
            self._read_options = True
            self._say(self._unread(report))

    def _warn(self, k: int, interface: Interface, hidden: float) -> None:
        """Warn of what a converged solution may hide in contact number k, such as a gap."""
        name = f"contact {k} ({self.contacts[k]})"
        comm, master = self._halo.comm, interface.master
        text = ""
        if interface.active and not anywhere(comm, master.paired.any()):
            # Where its nodes were paired, or should have been
            small = interface.sliding == "small"
            x = self._halo.x if small else interface.positions()
            distance = least(comm, master.distance(x))
            text = f"{name} transmits no force: it has no slave node "
            if distance > master.reach:
                text += (
                    f"within reach of its master; the nearest is {distance:.3g} away"
                    f"{' in the reference configuration' if small else ''}, and the "
                    f"search reaches {master.reach:.3g}"
                )
            else:
                text += f"that faces its master, although the nearest is {distance:.3g} away"
            if small and not master.is_rigid:
                text += (
                    '. sliding="small" pairs nodes in the reference configuration, once: give a '
                    'larger search_distance, or take sliding="finite"'
                )
        elif hidden < 0:
            frozen = total(comm, len(master.frozen_pairs))
            text = (
                f"{name}: {frozen} pairs went back and forth between facets and "
                f"were frozen; they hide a penetration of {-hidden:.3g}. Refine the coarser "
                "surface there or take smaller steps"
            )
        self._say(text)

    def _unread(self, report: Report) -> str:
        names = ", ".join(map(repr, report.unread))
        return (
            f"petsc_options has {names}, which nothing has read: check the spelling, leave out the "
            "prefix"
            if names
            else ""
        )

    def _say(self, text: str) -> None:
        """Warn, on rank 0."""
        if text and self._halo.comm.rank == 0:
            # Of the user's line, whether that calls solve or a loop of steps does
            warnings.warn(text, skip_file_prefixes=(str(Path(__file__).parent),))
