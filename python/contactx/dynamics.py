# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia in contact: one time step after the other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from inspect import Parameter, signature
from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

import dolfinx.fem.petsc
import ufl
from contactx import cpp as core
from contactx._host.checks import check_displacement, described, is_number
from contactx.contact import Contact
from contactx.problem import ContactProblem
from dolfinx import fem, la

type Array = npt.NDArray[np.float64]

_MASSES = ("lumped", "consistent")
_LUMPED = {"quadrature_rule": "vertex", "quadrature_degree": 1}


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
    the cells; bodies rebound by their own elastic waves. See ``solve/impact.h``.

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
        travel = _check_travel(impact_travel)
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
        assembler = self.assembler
        inertia = Inertia(
            density * ufl.inner(w, v) * measure,
            kind,
            loads,
            None if strain_energy is None else strain_energy(u),
            {"form_compiler_options": form_compiler_options, "jit_options": jit_options},
        )
        results = [contact.fields.results for contact in self.contacts]
        self._step = core.TimeStep(assembler.system.core, results, inertia, travel)
        self._step.attach(assembler.core)

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

    def set_attempt(self, attempt: core.Attempt) -> None:
        """Take the time that the next step goes over, and what it may cost; LoadSteps calls this.

        Args:
            attempt: The attempt.
        """
        super().set_attempt(attempt)
        self.dt = attempt.end - attempt.start

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
        self._step.begin(self.dt, self._owned_velocity())
        self.velocity.x.scatter_forward()
        super().solve()
        self._owned_velocity()[:] = self._step.velocity
        self.velocity.x.scatter_forward()
        self.report.balance = self._step.balance()
        return self.u

    def kinetic_energy(self) -> float:
        """Kinetic energy of the current velocity; all ranks must take part.

        Returns:
            1/2 v . M v, an energy.
        """
        return self._step.kinetic_energy(self._owned_velocity())

    def strain_energy(self) -> float | None:
        """Strain energy of the current displacement; all ranks must take part.

        Returns:
            The energy, or None where no ``strain_energy`` was given.
        """
        return self._step.strain_energy()

    def momentum(self) -> npt.NDArray[np.float64]:
        """Momentum of the current velocity; all ranks must take part.

        Returns:
            Mass times velocity, shape (gdim,).
        """
        return self._step.momentum(self._owned_velocity())

    def angular_momentum(self) -> float | npt.NDArray[np.float64]:
        """Moment of momentum about the origin; all ranks must take part.

        Returns:
            A number in 2D, positive counter-clockwise; in 3D shape (3,).
        """
        momentum: float | Array = self._step.angular_momentum(self._owned_velocity())
        return momentum

    def _owned_velocity(self) -> npt.NDArray[np.float64]:
        velocity: npt.NDArray[np.float64] = self.velocity.x.array[: self.assembler.bulk.num_dofs]
        return velocity


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


def mass_measure(kind: str) -> ufl.Measure:
    """Measure that inertia is integrated with.

    Args:
        kind: "lumped": by the values at vertices, so that the matrix of linear elements is diagonal
            (Hughes, The Finite Element Method, 2000, section 7.3.2); or "consistent".
    """
    return ufl.Measure("dx", metadata=_LUMPED) if kind == "lumped" else ufl.dx


class Inertia:
    """The core's ``dynamics::Inertia``.

    Attributes:
        is_lumped: Whether the mass matrix is diagonal.
        diagonal: Its diagonal at owned dofs, shape (num_dofs,).
    """

    def __init__(
        self,
        mass: ufl.Form,
        kind: str,
        loads: ufl.Form | None,
        strain_energy: ufl.Form | None,
        options: dict[str, Any],
    ):
        """Assemble the mass matrix; all ranks must take part.

        Args:
            mass: Bilinear form of the inertia.
            kind: "lumped" or "consistent".
            loads: Virtual work of the loads.
            strain_energy: Strain energy of the current displacement.
            options: Options of the compilation.
        """
        self.is_lumped = kind == "lumped"
        form = fem.form(mass, **options)
        self._V = form.function_spaces[0]
        self._A = dolfinx.fem.petsc.assemble_matrix(form)
        self._A.assemble()
        self.diagonal: Array = self._A.getDiagonal().array.copy()
        self._loads = None if loads is None else fem.form(loads, **options)
        self._strain = None if strain_energy is None else fem.form(strain_energy, **options)
        self._markers: npt.NDArray[np.bool_] | None = None
        self._ksp: PETSc.KSP | None = None

    def product(self, values: Array) -> Array:
        """Multiply values at owned dofs by the masses."""
        x, y = self._A.createVecs()
        x.array[:] = values
        self._A.mult(x, y)
        product: Array = y.array.copy()
        return product

    def constrain(self, markers: npt.NDArray[np.int8]) -> None:
        """Factorise the mass matrix without the rows and columns of prescribed dofs.

        Args:
            markers: 1 at prescribed owned dofs, shape (num_dofs,).
        """
        self._markers = markers == 1
        first, _ = self._A.getOwnershipRange()
        A = self._A.copy()
        A.zeroRowsColumns((first + np.flatnonzero(self._markers)).astype(PETSc.IntType))
        self._ksp = PETSc.KSP().create(self._A.comm)
        self._ksp.setOperators(A)
        self._ksp.setType("preonly")
        self._ksp.getPC().setType("lu")
        self._ksp.getPC().setFactorSolverType("mumps")

    def solve(self, values: Array) -> None:
        """Make velocities of impulses, zero at prescribed dofs.

        Args:
            values: Values at owned dofs, shape (num_dofs,), overwritten.
        """
        assert self._ksp is not None and self._markers is not None
        b, x = self._A.createVecs()
        b.array[:] = np.where(self._markers, 0.0, values)
        self._ksp.solve(b, x)
        values[:] = x.array

    def strain_energy(self) -> float | None:
        """Strain energy of this rank's cells; None where no form was given."""
        return None if self._strain is None else float(fem.assemble_scalar(self._strain))

    def loads(self) -> Array | None:
        """Loads at owned dofs, shape (num_dofs,); None where no form was given."""
        if self._loads is None:
            return None
        b = la.vector(self._V.dofmap.index_map, self._V.dofmap.index_map_bs)
        fem.assemble_vector(b.array, self._loads)
        b.scatter_reverse(la.InsertMode.add)
        loads: Array = b.array[: len(self.diagonal)].copy()
        return loads
