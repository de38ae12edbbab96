# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A material with a history."""

import basix.ufl
import ufl
from dolfinx import fem


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
