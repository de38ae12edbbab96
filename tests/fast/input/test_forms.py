# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Residual and Jacobian of a problem."""

import ufl
from dolfinx import fem

from inputs.rows import problem, refused, scene, table, with_
from story import elasticity

VECTORS = ("Lagrange", 1, (2,))


def space(blocks, *element):
    return fem.functionspace(blocks.u.function_space.mesh, element)


def stiffness(V, W=None):
    """Some form of two arguments."""
    return ufl.inner(ufl.grad(ufl.TrialFunction(V)), ufl.grad(ufl.TestFunction(W or V))) * ufl.dx


def load(blocks, V):
    """Some form of one argument that depends on the displacement."""
    return ufl.inner(ufl.grad(blocks.u), ufl.grad(ufl.TestFunction(V))) * ufl.dx


RESIDUAL = "give the residual, linear in a TestFunction"
SPACE = "an argument in .* not of the function space of u: make test and trial functions with"
ROWS = {
    TypeError: [
        (lambda: problem(F="F"), f"F must be a ufl.Form, not str: {RESIDUAL}"),
        (lambda: problem(F=0), "F must be a ufl.Form, not int"),
        (with_("F", lambda b: fem.form(b.F)), "F must be a ufl.Form, not Form"),
        (lambda: problem(J="J"), "J must be a ufl.Form, not str: give the derivative of F"),
    ],
    ValueError: [
        (lambda: problem(F=ufl.Form([])), "F is a form without integrals"),
        (
            with_("F", lambda b: ufl.inner(b.u, b.u) * ufl.dx),
            f"F has 0 arguments, but must have 1: {RESIDUAL}",
        ),
        (with_("F", lambda b: ufl.derivative(b.F, b.u)), "F has 2 arguments, but must have 1"),
        (with_("F", lambda b: stiffness(b.u.function_space)), "F has 2 arguments, but must have 1"),
        (with_("F", lambda b: scene().F), f"F has {SPACE}"),
        (
            with_("F", lambda b: elasticity(fem.Function(b.u.function_space), 1.0, 0.3)),
            "F does not depend on u.* write F with the very Function",
        ),
        (with_("F", lambda b: load(b, space(b, "Lagrange", 2, (2,)))), f"F has {SPACE}"),
        (with_("F", lambda b: load(b, space(b, *VECTORS))), f"F has {SPACE}"),
        (
            with_(
                "F",
                lambda b: (
                    b.F
                    + ufl.inner(scene().u, ufl.TestFunction(b.u.function_space))
                    * ufl.dx(b.u.function_space.mesh)
                ),
            ),
            "F has integrals or functions on another mesh than u: contact needs one mesh",
        ),
        (with_("J", lambda b: b.F), "J has 1 arguments, but must have 2: give the derivative"),
        (with_("J", lambda b: stiffness(space(b, "Lagrange", 2, (2,)))), f"J has {SPACE}"),
        (with_("J", lambda b: stiffness(scene().u.function_space)), f"J has {SPACE}"),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)
