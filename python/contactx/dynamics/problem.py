# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia in contact: one time step after the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from inspect import Parameter, signature
from typing import Any

import numpy as np
import numpy.typing as npt

import ufl
from contactx import cpp as core
from contactx.arguments import described, is_number
from contactx.bulk_input import check_displacement
from contactx.contact import Contact
from contactx.dynamics.balance import Balance
from contactx.dynamics.mass import Mass, mass_measure
from contactx.errors import ConvergenceError
from contactx.parallel import reduce
from contactx.problem import ContactProblem
from dolfinx import fem, la

_MASSES = ("lumped", "consistent")


class ContactDynamics(ContactProblem):
    """Bodies with inertia and contact, by a time step without spurious oscillations of the contact.

    A step of length dt from u_0, v_0 ends at u_1 with the multipliers lambda of::

        density (2 (u_1 - u_0) / dt^2 - 2 v_0 / dt) . v + forces((u_0 + u_1) / 2; v) - loads(v)
            - sum_s A_s lambda_s . (v_s - sum_l N_l v_l) = 0  for all v

    that is Newmark's method (1/4, 1/2) for linear bodies, where the contact force is constant over
    the step and the contact laws hold at its end (Kane, Repetto, Ortiz and Marsden 1999). Then the
    velocities v_1 = 2 (u_1 - u_0) / dt - v_0 are corrected by the law of inelastic impact (Moreau
    1988): a closed node under pressure has no relative velocity along the normal any more, a
    sticking or tied one none at all. Without this a node that arrives with -v would leave with up
    to v, and the contact force would oscillate. With linear bodies and obstacles that are flat and
    at rest neither the multipliers nor the correction can raise the energy, whatever dt is; where
    nodes slide over curved or faceted surfaces they may, since the normals turn within a step. An
    impact dissipates the kinetic energy of the surface's nodes, which vanishes with the size of
    the cells; bodies rebound by their own elastic waves. See ``dynamics/impact.h``.

    Steps are those of ``LoadSteps``, in which t is the time::

        dynamics = cx.ContactDynamics(forces, u, density=rho, contacts=[contact],
                                      petsc_options_prefix="bar_")
        dynamics.velocity.interpolate(...)
        for step in cx.LoadSteps(dynamics, 400, update=update, t_end=2e-3):
            print(step.t, step.report.balance.energy)

    or of ``solve()``, each of the length ``dt``. A step that fails leaves displacement, velocity
    and contacts as they were.

    Attributes:
        velocity: Velocity at the end of the last step, a function of the displacement's space; set
            it before the first one.
    """

    def __init__(
        self,
        forces: Callable[..., ufl.Form],
        u: fem.Function,
        *,
        density: float | ufl.core.expr.Expr,
        contacts: Sequence[Contact],
        petsc_options_prefix: str,
        loads: ufl.Form | None = None,
        strain_energy: Callable[[Any], ufl.Form] | None = None,
        mass: str | None = None,
        impact_travel: float | None = None,
        bcs: Sequence[fem.DirichletBC] | None = None,
        petsc_options: Mapping[str, Any] | None = None,
        audit: str = "refuse",
        form_compiler_options: dict[str, Any] | None = None,
        jit_options: dict[str, Any] | None = None,
    ):
        """Create the problem of a time step.

        Args:
            forces: Function of a displacement, an expression, that gives the static residual: the
                virtual work of the stresses, a form linear in its test function. It is taken at the
                middle of the step. A function of two displacements is given those of the step's
                start and end, for methods that balance the energy of nonlinear bodies exactly.
            u: Displacement, in a Lagrange space of vectors of degree 1 or 2. Its values are the
                start of the first step.
            density: Mass per reference volume: a number above 0, a ``fem.Constant``, a
                ``fem.Function`` or an expression; read when the problem is created.
            contacts: Contacts, as of ``ContactProblem``.
            petsc_options_prefix: Prefix of the PETSc options, unique in the program.
            loads: Virtual work of loads that do not depend on the displacement, such as weights,
                with the sign of a right-hand side. Their coefficients may change from step to step;
                they act as they are throughout a step.
            strain_energy: Function of a displacement that gives the strain energy, a form without
                arguments; for ``report.balance`` alone.
            mass: "lumped", a diagonal matrix, the default for degree 1, where it is exact for
                rigid translations; or "consistent", the default and only one for degree 2.
            impact_travel: How far a node may travel before it touches within a step, over the size
                of the cells there. Contact acts throughout that step, so that this distance is
                the error of the time of the impact. A step in which a node travels farther fails,
                and ``LoadSteps`` halves it: steps are short at impacts, and grow back. No limit if
                None.
            bcs: Dirichlet conditions. Prescribed displacements move with their mean velocity of
                a step.
            petsc_options: As of ``ContactProblem``.
            audit: As of ``ContactProblem``.
            form_compiler_options: Options of FFCx.
            jit_options: Options of the compilation.

        Raises:
            TypeError: If an argument is of another kind.
            ValueError: If an argument is out of its range; and as ``ContactProblem`` does.
        """
        check_displacement(u)
        V = u.function_space
        kind = _kind_of(mass, V.ufl_element().degree)
        _check(forces, density, loads, strain_energy)
        self._impact_travel = _check_travel(impact_travel)
        self.velocity = fem.Function(V, name="velocity")
        self._start = fem.Function(V, name="start")
        self._dt = fem.Constant(V.mesh, 1.0)
        self._has_dt = False
        v, w = ufl.TestFunction(V), ufl.TrialFunction(V)
        measure = mass_measure(kind)
        acceleration = 2 * (u - self._start) / self._dt**2 - 2 * self.velocity / self._dt
        F = density * ufl.inner(acceleration, v) * measure + _middle(forces, self._start, u)
        if loads is not None:
            F -= loads
        super().__init__(
            F,
            u,
            contacts=contacts,
            petsc_options_prefix=petsc_options_prefix,
            bcs=bcs,
            petsc_options=petsc_options,
            audit=audit,
            form_compiler_options=form_compiler_options,
            jit_options=jit_options,
        )
        self.assembler.core.allow_flight()
        options = {"form_compiler_options": form_compiler_options, "jit_options": jit_options}
        self._mass = Mass(density * ufl.inner(w, v) * measure, kind, options)
        self._loads = None if loads is None else fem.form(loads, **options)
        self._strain = None if strain_energy is None else fem.form(strain_energy(u), **options)
        self._impact = core.Impact(self.assembler.halo.nodes, self.assembler.interfaces)
        # Velocity and balance of a step that has converged, until it is accepted
        self._next: tuple[npt.NDArray[np.float64], Balance] | None = None

    @property
    def dt(self) -> float:
        """Length of the next step, a time; ``LoadSteps`` sets it."""
        return float(self._dt.value)

    @dt.setter
    def dt(self, dt: float) -> None:
        if not is_number(dt):
            raise TypeError(f"dt is {described(dt)}: give a number")
        if not (np.isfinite(dt) and dt > 0):
            raise ValueError(f"dt is {dt}: give a finite time above 0")
        self._dt.value = float(dt)
        self._has_dt = True

    def set_interval(self, start: float, end: float) -> None:
        """Take the time that the next step goes over; LoadSteps calls this.

        Args:
            start: Time at its start.
            end: Time at its end.
        """
        self.dt = end - start

    @property
    def beside(self) -> list[fem.Function]:
        """State beside the displacement: LoadSteps rolls it back and writes it to checkpoints."""
        return [*super().beside, self.velocity]

    def solve(self) -> fem.Function | Sequence[fem.Function]:
        """Take a step of length ``dt`` from ``u`` and ``velocity``, with the current loads.

        Returns:
            ``u``.

        Raises:
            ConvergenceError: If the step fails; displacement, velocity and contacts are then as
                they were before the call.
            RuntimeError: If no ``dt`` was set.
            ValueError: If the velocity is not finite; and as ``ContactProblem.solve`` does.
        """
        if not self._has_dt:
            raise RuntimeError("no dt was set: set dynamics.dt, or take steps by cx.LoadSteps")
        self._start.x.array[:] = self.displacement.x.array
        bad = not np.isfinite(self.velocity.x.array).all()
        if reduce.anywhere(self.velocity.function_space.mesh.comm, bad):
            raise ValueError("velocity is not finite: set it to finite values")
        self.velocity.x.scatter_forward()
        self._next = None
        self._impact.begin_step()
        super().solve()
        assert self._next is not None
        velocity, balance = self._next
        self._next = None
        self.velocity.x.array[: len(velocity)] = velocity
        self.velocity.x.scatter_forward()
        forces = [self.dt * contact.force for contact in self.contacts]
        impulse = [f + more for f, more in zip(forces, balance.impulse, strict=True)]
        self.report.balance = replace(balance, impulse=impulse)
        return self.u

    def _converged(self) -> None:
        """Find velocities and balance of a step before it is accepted."""
        assembler, n = self.assembler, self.assembler.bulk.num_dofs
        held = assembler.bulk.markers[:n] == 1
        way = self.displacement.x.array[:n] - self._start.x.array[:n]
        self._check_arrival(way)
        self._mass.hold(assembler.bulk.markers[:n])
        before = self.velocity.x.array[:n]
        velocity = 2 * way / self.dt - before
        free = self._kinetic(velocity)
        # Twice the mean of an interval goes to and fro where motion is prescribed
        velocity[held] = way[held] / self.dt
        moved = self._kinetic(velocity)
        self._impact.correct(self.dt, velocity, self._mass.solve)
        kinetic = self._kinetic(velocity)
        contact, supports = self._work(way, held)
        loads = 0.0 if self._loads is None else self._total(self._vector(self._loads) @ way)
        gdim = assembler.halo.gdim
        # Those of the forces follow when they are known
        impulse = [
            self._total(each.reshape(-1, gdim).sum(axis=0)) for each in self._impact.corrections()
        ]
        self._next = (
            velocity,
            Balance(
                dt=self.dt,
                kinetic=kinetic,
                strain=self.strain_energy(),
                momentum=self._momentum(velocity),
                angular_momentum=self._angular_momentum(velocity),
                work_of_loads=loads,
                work_of_supports=supports + moved - free,
                contact_loss=moved - kinetic - contact,
                impulse=impulse,
            ),
        )

    def _check_arrival(self, way: npt.NDArray[np.float64]) -> None:
        """Refuse a step in which a node has come too far before it touches.

        Args:
            way: Displacements of the step.

        Raises:
            ConvergenceError: If one has; on all ranks.
        """
        if self._impact_travel is None:
            return
        travel = self._impact.arrival(way, self.assembler.bulk.cell_sizes())
        if travel > self._impact_travel:
            report = self.report
            report.converged = False
            report.reason = (
                f"a node moved by {travel:.2g} of a cell to what it hits, further than "
                f"impact_travel = {self._impact_travel:g}: take shorter steps "
                "(manual: errors/impact-travel)"
            )
            raise ConvergenceError(report.reason, report)

    def kinetic_energy(self) -> float:
        """Kinetic energy of the current velocity; all ranks must take part.

        Returns:
            1/2 v . M v, an energy.
        """
        return self._kinetic(self._owned_velocity())

    def strain_energy(self) -> float | None:
        """Strain energy of the current displacement; all ranks must take part.

        Returns:
            The energy, or None where no ``strain_energy`` was given.
        """
        if self._strain is None:
            return None
        return float(self._total(fem.assemble_scalar(self._strain)))

    def momentum(self) -> npt.NDArray[np.float64]:
        """Momentum of the current velocity; all ranks must take part.

        Returns:
            Mass times velocity, shape (gdim,).
        """
        return self._momentum(self._owned_velocity())

    def angular_momentum(self) -> float | npt.NDArray[np.float64]:
        """Moment of momentum about the origin; all ranks must take part.

        Returns:
            A number in 2D, positive counter-clockwise; in 3D shape (3,).
        """
        return self._angular_momentum(self._owned_velocity())

    def _owned_velocity(self) -> npt.NDArray[np.float64]:
        velocity: npt.NDArray[np.float64] = self.velocity.x.array[: self.assembler.bulk.num_dofs]
        return velocity

    def _kinetic(self, velocity: npt.NDArray[np.float64]) -> float:
        return float(self._total(0.5 * (velocity @ self._mass.product(velocity))))

    def _momentum(self, velocity: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        p = self._mass.product(velocity).reshape(-1, self.assembler.halo.gdim)
        momentum: npt.NDArray[np.float64] = self._total(p.sum(axis=0))
        return momentum

    def _angular_momentum(
        self, velocity: npt.NDArray[np.float64]
    ) -> float | npt.NDArray[np.float64]:
        halo = self.assembler.halo
        p = self._mass.product(velocity).reshape(-1, halo.gdim)
        x = halo.x[: halo.num_owned] + self.displacement.x.array[: p.size].reshape(p.shape)
        if halo.gdim == 2:
            return float(self._total((x[:, 0] * p[:, 1] - x[:, 1] * p[:, 0]).sum()))
        moment: npt.NDArray[np.float64] = self._total(np.cross(x, p).sum(axis=0))
        return moment

    def _work(
        self, way: npt.NDArray[np.float64], held: npt.NDArray[np.bool_]
    ) -> tuple[float, float]:
        """Work of contact and of supports in a step."""
        system, halo = self.assembler.system, self.assembler.halo
        residual = np.zeros((halo.num_nodes, halo.gdim))
        for interface in self.assembler.interfaces:
            interface.add_residual(residual)
        contact = halo.scatter_reverse(residual).ravel()[: len(way)]
        forces = system.bulk_residual()[: len(way)] + contact
        return -self._total(contact @ way), self._total(forces[held] @ way[held])

    def _vector(self, form: fem.Form) -> npt.NDArray[np.float64]:
        V = self.displacement.function_space
        b = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
        fem.assemble_vector(b.array, form)
        b.scatter_reverse(la.InsertMode.add)
        values: npt.NDArray[np.float64] = b.array[: self.assembler.bulk.num_dofs].copy()
        return values

    def _total(self, value: npt.ArrayLike) -> Any:
        return reduce.total(self.displacement.function_space.mesh.comm, value)


def _middle(forces: Callable[..., ufl.Form], start: fem.Function, end: fem.Function) -> ufl.Form:
    """Forces of a step."""
    form = forces(start, end) if _num_arguments(forces) == 2 else forces((start + end) / 2)
    if not isinstance(form, ufl.Form):
        raise TypeError(f"forces gives a {type(form).__name__}: let it return a UFL form")
    return form


def _num_arguments(forces: Callable[..., ufl.Form]) -> int:
    """Number of displacements that forces are a function of: 1 or 2."""
    kinds = (Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD)
    parameters = signature(forces).parameters.values()
    number = sum(p.kind in kinds and p.default is Parameter.empty for p in parameters)
    if number not in (1, 2):
        raise TypeError(
            f"forces takes {number} arguments: give a function of the displacement in the middle "
            "of the step, or of those at its start and its end"
        )
    return number


def _kind_of(mass: Any, degree: int) -> str:
    """Kind of the masses.

    Args:
        mass: Kind that the user has given, or None.
        degree: Degree of the displacement.
    """
    if mass is None:
        return "lumped" if degree == 1 else "consistent"
    if mass not in _MASSES:
        raise ValueError(f'mass is {described(mass)}: give "lumped" or "consistent"')
    if mass == "lumped" and degree != 1:
        raise ValueError(
            f'mass is "lumped", which is for linear elements, and u is of degree {degree}: leave '
            "mass out"
        )
    return str(mass)


def _check_travel(impact_travel: Any) -> float | None:
    """Check the limit of what nodes move to what they hit."""
    if impact_travel is None:
        return None
    if not is_number(impact_travel):
        raise TypeError(f"impact_travel is {described(impact_travel)}: give a number or None")
    if not impact_travel > 0:
        raise ValueError(f"impact_travel is {impact_travel}: give a number above 0, or None")
    return float(impact_travel)


def _check(forces: Any, density: Any, loads: Any, strain_energy: Any) -> None:
    """Check the kinds of arguments.

    Raises:
        TypeError: If one is of another kind.
        ValueError: If the density is not above 0.
    """
    if not callable(forces):
        raise TypeError(
            f"forces is {described(forces)}: give a function of a displacement that returns the "
            "form of the stresses' virtual work, as lambda w: ufl.inner(sigma(w), eps(v)) * ufl.dx"
        )
    if is_number(density):
        if not (np.isfinite(density) and density > 0):
            raise ValueError(f"density is {density}: give a finite number above 0")
    elif not isinstance(density, ufl.core.expr.Expr):
        raise TypeError(f"density is {described(density)}: give a number or a UFL expression")
    if loads is not None:
        if not isinstance(loads, ufl.Form):
            raise TypeError(f"loads is {described(loads)}: give a UFL form")
        if len(loads.arguments()) != 1:
            raise ValueError(
                f"loads has {len(loads.arguments())} arguments: give a form linear in a "
                "TestFunction"
            )
    if strain_energy is not None and not callable(strain_energy):
        raise TypeError(
            f"strain_energy is {described(strain_energy)}: give a function of a displacement"
        )
