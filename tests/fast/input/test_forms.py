# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Residual and Jacobian of a problem."""

import ufl
from dolfinx import fem

from inputs.rows import Row, problem, refused, scene, table, with_
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
ROWS = [
    Row(
        "F: a text", lambda: problem(F="F"), TypeError, f"F must be a ufl.Form, not str: {RESIDUAL}"
    ),
    Row("F: zero", lambda: problem(F=0), TypeError, "F must be a ufl.Form, not int"),
    Row(
        "F: compiled",
        with_("F", lambda b: fem.form(b.F)),
        TypeError,
        "F must be a ufl.Form, not Form",
    ),
    Row(
        "F: no integrals",
        lambda: problem(F=ufl.Form([])),
        ValueError,
        "F is a form without integrals",
    ),
    Row(
        "F: an energy",
        with_("F", lambda b: ufl.inner(b.u, b.u) * ufl.dx),
        ValueError,
        f"F has 0 arguments, but must have 1: {RESIDUAL}",
    ),
    Row(
        "F: a derivative",
        with_("F", lambda b: ufl.derivative(b.F, b.u)),
        ValueError,
        "F has 2 arguments, but must have 1",
    ),
    Row(
        "F: with a trial function",
        with_("F", lambda b: stiffness(b.u.function_space)),
        ValueError,
        "F has 2 arguments, but must have 1",
    ),
    Row("F: of another mesh", with_("F", lambda b: scene().F), ValueError, f"F has {SPACE}"),
    Row(
        "F: of another function",
        with_("F", lambda b: elasticity(fem.Function(b.u.function_space), 1.0, 0.3)),
        ValueError,
        "F does not depend on u.* write F with the very Function",
    ),
    Row(
        "F: of quadratic test functions",
        with_("F", lambda b: load(b, space(b, "Lagrange", 2, (2,)))),
        ValueError,
        f"F has {SPACE}",
    ),
    Row(
        "F: of an equal space",
        with_("F", lambda b: load(b, space(b, *VECTORS))),
        ValueError,
        f"F has {SPACE}",
    ),
    Row(
        "F: a load on another mesh",
        with_(
            "F",
            lambda b: (
                b.F
                + ufl.inner(scene().u, ufl.TestFunction(b.u.function_space))
                * ufl.dx(b.u.function_space.mesh)
            ),
        ),
        ValueError,
        "F has integrals or functions on another mesh than u: contact needs one mesh",
    ),
    Row(
        "J: a text",
        lambda: problem(J="J"),
        TypeError,
        "J must be a ufl.Form, not str: give the derivative of F",
    ),
    Row(
        "J: linear",
        with_("J", lambda b: b.F),
        ValueError,
        "J has 1 arguments, but must have 2: give the derivative",
    ),
    Row(
        "J: of quadratic functions",
        with_("J", lambda b: stiffness(space(b, "Lagrange", 2, (2,)))),
        ValueError,
        f"J has {SPACE}",
    ),
    Row(
        "J: of another mesh",
        with_("J", lambda b: stiffness(scene().u.function_space)),
        ValueError,
        f"J has {SPACE}",
    ),
]


@table(ROWS)
def test_refused(row):
    refused(row)
