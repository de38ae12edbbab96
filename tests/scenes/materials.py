# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Materials beside the linear one of ``story``, and a property that differs between bodies."""

from __future__ import annotations

from typing import Any

import basix.ufl
import ufl
from dolfinx import fem

from meshes import Tag
from story import constants


def neo_hookean(u: fem.Function, young: Any, nu: Any, degree: int | None = None) -> ufl.Form:
    """Residual of compressible neo-Hookean bodies, in plane strain where the mesh is plane."""
    young, nu = constants(u, young, nu)
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    gdim = len(u)
    F = ufl.Identity(gdim) + ufl.grad(u)
    log_j = ufl.ln(ufl.det(F))
    density = mu / 2 * (ufl.tr(F.T * F) - gdim - 2 * log_j) + lmbda / 2 * log_j**2
    return ufl.derivative(density * _measure(degree), u)


def of_bodies(data: Any, upper: float, lower: float) -> fem.Function:
    """A value for the upper body's cells and one for the lower body's."""
    result = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
    for body, value in ((Tag.UPPER, upper), (Tag.LOWER, lower)):
        result.x.array[data.cell_tags.find(body)] = value
    return result


def st_venant_kirchhoff(
    u: fem.Function, young: Any, nu: Any, degree: int | None = None
) -> ufl.Form:
    """Residual of bodies that hardly resist being squeezed to nothing, or turned inside out."""
    young, nu = constants(u, young, nu)
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    F = ufl.Identity(len(u)) + ufl.grad(u)
    E = (F.T * F - ufl.Identity(len(u))) / 2
    density = mu * ufl.inner(E, E) + lmbda / 2 * ufl.tr(E) ** 2
    return ufl.derivative(density * _measure(degree), u)


def axisymmetric_strain(w: Any) -> Any:
    """Strain of a displacement (u_r, u_z) about the axis r = 0, a tensor in space."""
    e, r = ufl.sym(ufl.grad(w)), ufl.SpatialCoordinate(w.ufl_function_space().mesh)[0]
    return ufl.as_tensor([[e[0, 0], e[0, 1], 0], [e[1, 0], e[1, 1], 0], [0, 0, w[0] / r]])


def _measure(degree: int | None) -> ufl.Measure:
    return ufl.dx if degree is None else ufl.dx(metadata={"quadrature_degree": degree})


class Plastic:
    """A block of von Mises plasticity with linear hardening, its history in a quadrature space."""

    E, NU, YIELD, HARDENING = 100.0, 0.3, 1.0, 10.0

    def __init__(self, u):
        mesh = u.function_space.mesh
        self.u = u
        tensor = basix.ufl.quadrature_element(mesh.basix_cell(), value_shape=(3, 3), degree=1)
        scalar = basix.ufl.quadrature_element(mesh.basix_cell(), value_shape=(), degree=1)
        self.plastic = fem.Function(fem.functionspace(mesh, tensor))
        self.equivalent = fem.Function(fem.functionspace(mesh, scalar))
        mu, lmbda = (
            self.E / (2 * (1 + self.NU)),
            self.E * self.NU / ((1 + self.NU) * (1 - 2 * self.NU)),
        )
        strain = ufl.sym(ufl.grad(u)) - self.plastic
        trial = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(3)
        s = ufl.dev(trial)
        mises = ufl.sqrt(1.5 * ufl.inner(s, s) + 1e-16)
        excess = mises - self.YIELD - self.HARDENING * self.equivalent
        rate = ufl.max_value(excess, 0) / (3 * mu + self.HARDENING)
        flow = 1.5 * rate * s / mises
        self.stress = trial - 2 * mu * flow
        v = ufl.TestFunction(u.function_space)
        self.F = ufl.inner(self.stress, ufl.sym(ufl.grad(v))) * ufl.dx(
            metadata={"quadrature_degree": 1, "quadrature_scheme": "default"}
        )
        points = self.plastic.function_space.element.interpolation_points
        self._new_plastic = fem.Expression(self.plastic + flow, points)
        self._new_equivalent = fem.Expression(self.equivalent + rate, points)

    def commit(self):
        """Take over the history of an accepted step."""
        plastic = fem.Function(self.plastic.function_space)
        equivalent = fem.Function(self.equivalent.function_space)
        plastic.interpolate(self._new_plastic)
        equivalent.interpolate(self._new_equivalent)
        self.plastic.x.array[:] = plastic.x.array
        self.equivalent.x.array[:] = equivalent.x.array
