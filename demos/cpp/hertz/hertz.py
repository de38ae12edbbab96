# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of linear elasticity for FFCx: E = 1, nu = 0.3."""

from basix.ufl import element
from ufl import (
    Coefficient,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    derivative,
    dx,
    grad,
    inner,
    sym,
    tr,
)

E, nu = 1.0, 0.3
mu, lmbda = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))

e = element("Lagrange", "tetrahedron", 1, shape=(3,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, v = Coefficient(V), TestFunction(V)

strain = sym(grad(u))
stress = 2 * mu * strain + lmbda * tr(strain) * Identity(3)
F = inner(stress, grad(v)) * dx
J = derivative(F, u)

forms = [F, J]
