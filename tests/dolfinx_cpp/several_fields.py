# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of a displacement that is solved for together with other fields, for FFCx.

A nearly incompressible solid with its pressure, as one mixed space and as two blocks, and a solid
that warmth makes larger. A load is on the facets 12.
"""

from basix.ufl import element, mixed_element
from ufl import (
    Coefficient,
    Constant,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    TestFunctions,
    derivative,
    div,
    ds,
    dx,
    grad,
    inner,
    split,
    sym,
    tr,
)

mu, bulk = 0.4, 50.0
linear = element("Lagrange", "quadrilateral", 1)
linear_vector = element("Lagrange", "quadrilateral", 1, shape=(2,))
quadratic_vector = element("Lagrange", "quadrilateral", 2, shape=(2,))
mesh = Mesh(linear_vector)
load = Constant(mesh, shape=(2,))


def momentum(u, p, v):
    """Forces of a solid with its pressure."""
    return inner(2 * mu * sym(grad(u)) - p * Identity(2), grad(v)) * dx


def volume(u, p, q):
    """How much more volume there is than the pressure allows, with the other sign."""
    return -(div(u) + p / bulk) * q * dx


def expanded(u, T, v):
    """Forces of a solid that warmth makes larger."""
    strain = sym(grad(u)) - 0.02 * T * Identity(2)
    stress = 2 / 2.6 * strain + 0.3 / (1.3 * 0.4) * tr(strain) * Identity(2)
    return inner(stress, grad(v)) * dx


W = FunctionSpace(mesh, mixed_element([quadratic_vector, linear]))
w = Coefficient(W)
v, q = TestFunctions(W)
F = momentum(*split(w), v) + volume(*split(w), q) - inner(load, v) * ds(12)
J = derivative(F, w)

V, Q = FunctionSpace(mesh, quadratic_vector), FunctionSpace(mesh, linear)
u, p = Coefficient(V), Coefficient(Q)
F_u = momentum(u, p, TestFunction(V)) - inner(load, TestFunction(V)) * ds(12)
F_p = volume(u, p, TestFunction(Q))
J_uu, J_up = derivative(F_u, u), derivative(F_u, p)
J_pu, J_pp = derivative(F_p, u), derivative(F_p, p)

V1 = FunctionSpace(mesh, linear_vector)
moved, warm = Coefficient(V1), Coefficient(Q)
F_moved = expanded(moved, warm, TestFunction(V1)) - inner(load, TestFunction(V1)) * ds(12)
F_warm = inner(grad(warm), grad(TestFunction(Q))) * dx
J_moved, J_moved_warm = derivative(F_moved, moved), derivative(F_moved, warm)
J_warm = derivative(F_warm, warm)

forms = [F, J, F_u, F_p, J_uu, J_up, J_pu, J_pp, F_moved, F_warm, J_moved, J_moved_warm, J_warm]
