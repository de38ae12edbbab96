# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of elasticity, E = 1, nu = 0.3, of degree 2 with a load on the facets 12, for FFCx.

On quadrilaterals, straight and curved, and on tetrahedra.
"""

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

mu, lmbda = 1 / 2.6, 0.3 / (1.3 * 0.4)


def residual(mesh, u, load):
    """Internal forces and the load."""
    v = TestFunction(u.ufl_function_space())
    strain = sym(grad(u))
    stress = 2 * mu * strain + lmbda * tr(strain) * Identity(len(u))
    return inner(stress, grad(v)) * dx - inner(load, v) * ds(12)


mesh = Mesh(element("Lagrange", "quadrilateral", 1, shape=(2,)))
u = Coefficient(FunctionSpace(mesh, element("Lagrange", "quadrilateral", 2, shape=(2,))))
load = Constant(mesh, shape=(2,))
F = residual(mesh, u, load)
J = derivative(F, u)

wave = Mesh(element("Lagrange", "quadrilateral", 2, shape=(2,)))
c = Coefficient(FunctionSpace(wave, element("Lagrange", "quadrilateral", 2, shape=(2,))))
push = Constant(wave, shape=(2,))
F_curved = residual(wave, c, push)
J_curved = derivative(F_curved, c)

solid = Mesh(element("Lagrange", "tetrahedron", 1, shape=(3,)))
w = Coefficient(FunctionSpace(solid, element("Lagrange", "tetrahedron", 2, shape=(3,))))
pressure = Constant(solid, shape=(3,))
F_solid = residual(solid, w, pressure)
J_solid = derivative(F_solid, w)

forms = [F, J, F_curved, J_curved, F_solid, J_solid]
