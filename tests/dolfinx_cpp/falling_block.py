# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of a time step of linear elastic bodies, E = 100, nu = 0.3, density 1, for FFCx.

With lumped masses and with consistent ones.
"""

from basix.ufl import element
from ufl import (
    Coefficient,
    Constant,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    TrialFunction,
    derivative,
    dx,
    grad,
    inner,
    sym,
    tr,
)

mu, lmbda = 100 / 2.6, 30 / (1.3 * 0.4)

e = element("Lagrange", "quadrilateral", 1, shape=(2,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, start, velocity = Coefficient(V), Coefficient(V), Coefficient(V)
v, w = TestFunction(V), TrialFunction(V)
dt, weight = Constant(mesh), Constant(mesh, shape=(2,))


def stress(displacement):
    """Stress of a displacement."""
    strain = sym(grad(displacement))
    return 2 * mu * strain + lmbda * tr(strain) * Identity(2)


loads = inner(weight, v) * dx
strain_energy = inner(stress(u), sym(grad(u))) / 2 * dx
acceleration = 2 * (u - start) / dt**2 - 2 * velocity / dt
inner_forces = inner(stress((start + u) / 2), grad(v)) * dx - loads

at_vertices = dx(metadata={"quadrature_rule": "vertex", "quadrature_degree": 1})
mass = inner(w, v) * at_vertices
F = inner(acceleration, v) * at_vertices + inner_forces
J = derivative(F, u)

consistent_mass = inner(w, v) * dx
F_consistent = inner(acceleration, v) * dx + inner_forces
J_consistent = derivative(F_consistent, u)

forms = [F, J, mass, F_consistent, J_consistent, consistent_mass, loads, strain_energy]
