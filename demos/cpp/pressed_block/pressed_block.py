# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of a compressible neo-Hookean solid for FFCx."""

from basix.ufl import element
from ufl import (
    Coefficient,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    derivative,
    det,
    dx,
    grad,
    ln,
    tr,
)

e = element("Lagrange", "quadrilateral", 1, shape=(2,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, v = Coefficient(V), TestFunction(V)

f = Identity(2) + grad(u)
log = ln(det(f))
F = derivative((0.5 * (tr(f.T * f) - 2 - 2 * log) + log**2) * dx, u, v)
J = derivative(F, u)

forms = [F, J]
