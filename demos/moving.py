# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the demos of moving bodies share: a material that keeps its energy, a slope."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

GRAVITY = 10.0


class SaintVenant:
    """Saint Venant and Kirchhoff's material, by the energy and momentum method.

    Stresses are the mean of those at the start and at the end of a step, acting on the deformation
    in its middle: in each step their work is the growth of strain energy, and no rigid motion makes
    any (Simo & Tarnow 1992).
    """

    def __init__(self, u: fem.Function, young: float, nu: float):
        """Take the displacement and the elastic constants, in plane strain."""
        self._v = ufl.TestFunction(u.function_space)
        self._mu, self._lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
        self._I = ufl.Identity(len(u))

    def _strain(self, w: Any) -> Any:
        F = self._I + ufl.grad(w)
        return 0.5 * (F.T * F - self._I)

    def _stress(self, w: Any) -> Any:
        E = self._strain(w)
        return 2 * self._mu * E + self._lmbda * ufl.tr(E) * self._I

    def forces(self, start: Any, end: Any) -> ufl.Form:
        """Virtual work of the stresses in a step."""
        F = self._I + ufl.grad((start + end) / 2)
        stress = (self._stress(start) + self._stress(end)) / 2
        return ufl.inner(F * stress, ufl.grad(self._v)) * ufl.dx

    def energy(self, w: Any) -> ufl.Form:
        """Strain energy."""
        return 0.5 * ufl.inner(self._stress(w), self._strain(w)) * ufl.dx


def on_a_slope(
    u: fem.Function, contacts: list[cx.Contact], young: float, nu: float, angle: float, prefix: str
) -> cx.ContactDynamics:
    """A body of density 1 on a slope that falls towards positive x, which is along it.

    Args:
        u: Displacement.
        contacts: Contacts.
        young: Young's modulus.
        nu: Poisson's ratio.
        angle: Inclination, in radians.
        prefix: Prefix of the PETSc options.
    """
    material, mesh = SaintVenant(u, young, nu), u.function_space.mesh
    weight = fem.Constant(mesh, GRAVITY * np.array([np.sin(angle), -np.cos(angle)]))
    return cx.ContactDynamics(
        material.forces,
        u,
        density=1.0,
        contacts=contacts,
        petsc_options_prefix=prefix,
        loads=ufl.inner(weight, ufl.TestFunction(u.function_space)) * ufl.dx,
        strain_energy=material.energy,
    )


class Run:
    """Momentum and energy over the time steps of a body.

    Attributes:
        dynamics: The problem.
        mass: Mass of the body.
        times: Ends of the steps, and their start.
        momenta: Momenta then, shape (steps + 1, gdim).
        totals: Energy then, less the work of loads: contact can but lower it.
        impulse: Sum of the impulses of the first contact, shape (gdim,).
        loss: Sum of what contact has taken of the energy.
    """

    def __init__(self, dynamics: cx.ContactDynamics, mass: float):
        """Start where the body is."""
        self.dynamics, self.mass = dynamics, mass
        start = dynamics.kinetic_energy() + (dynamics.strain_energy() or 0.0)
        self.times, self.momenta, self.totals = [0.0], [dynamics.momentum()], [start]
        self.impulse, self.loss = np.zeros(dynamics.assembler.halo.gdim), 0.0
        self._work = 0.0

    def take(self, steps: int, end: float) -> None:
        """Take equal time steps.

        Args:
            steps: Their number.
            end: Time at the end.
        """
        for step in cx.LoadSteps(self.dynamics, steps, lambda t: None, t_end=end, progress=False):
            balance = step.report.balance
            assert balance is not None
            self._work += balance.work_of_loads
            self.times.append(step.t)
            self.momenta.append(balance.momentum)
            self.totals.append(balance.energy - self._work)
            self.impulse = self.impulse + balance.impulse[0]
            self.loss += balance.contact_loss

    def velocities(self, axis: int) -> np.ndarray:
        """Mean velocities of the body along an axis, shape (steps + 1,)."""
        return np.array(self.momenta)[:, axis] / self.mass

    @property
    def growth(self) -> float:
        """Largest growth of the energy, less the work of loads, in a step."""
        return float(np.diff(self.totals).max())
