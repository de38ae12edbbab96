# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of elasticity, E = 1, nu = 0.3, with a load on the facets 12 and what cancels, for FFCx.

A uniform stress is balanced by tractions on the whole boundary, and a strain has no stress.
"""

from basix.ufl import element
from ufl import (
    Coefficient,
    Constant,
    FacetNormal,
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

mu, lmbda = 1 / 2.6, 0.3 / (1.3 * 0.4)

e = element("Lagrange", "quadrilateral", 1, shape=(2,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, v = Coefficient(V), TestFunction(V)
load, growth = Constant(mesh, shape=(2,)), Constant(mesh)
prestress = Constant(mesh, shape=(2, 2))

strain = sym(grad(u)) - growth * Identity(2)
stress = 2 * mu * strain + lmbda * tr(strain) * Identity(2) + prestress
internal = inner(stress, grad(v)) * dx
F = internal - inner(prestress * FacetNormal(mesh), v) * ds - inner(load, v) * ds(12)
J = derivative(internal, u)

forms = [F, J]
