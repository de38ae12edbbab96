# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms of a compressible neo-Hookean solid for FFCx, with a load on the facets 12."""

from basix.ufl import element
from ufl import (
    Coefficient,
    Constant,
    FunctionSpace,
    Identity,
    Mesh,
    TestFunction,
    derivative,
    det,
    ds,
    dx,
    grad,
    inner,
    ln,
    tr,
)

e = element("Lagrange", "quadrilateral", 1, shape=(2,))
mesh = Mesh(e)
V = FunctionSpace(mesh, e)
u, v = Coefficient(V), TestFunction(V)
load = Constant(mesh, shape=(2,))

f = Identity(2) + grad(u)
log = ln(det(f))
internal = derivative((0.5 * (tr(f.T * f) - 2 - 2 * log) + log**2) * dx, u, v)
F = internal - inner(load, v) * ds(12)
J = derivative(internal, u)

forms = [F, J]
