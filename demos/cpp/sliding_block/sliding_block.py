# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of linear elasticity for FFCx, E = 1, nu = 0.3, with a load on the facets 12."""

from basix.ufl import element
from ufl import (
    Coefficient,
    Constant,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    derivative,
    ds,
    dx,
    grad,
    inner,
    sym,
    tr,
)

E, nu = 1.0, 0.3
mu, lmbda = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))

e = element("Lagrange", "quadrilateral", 1, shape=(2,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, v = Coefficient(V), TestFunction(V)
load = Constant(mesh, shape=(2,))

strain = sym(grad(u))
stress = 2 * mu * strain + lmbda * tr(strain) * Identity(2)
internal = inner(stress, grad(v)) * dx
F = internal - inner(load, v) * ds(12)
J = derivative(internal, u)

forms = [F, J]
