# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacles."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem

from inputs.rows import Row, constant, refused, scene, solved, table

UP = (0.0, 1.0)


def master(make):
    """Solve with an obstacle."""

    def do():
        blocks = scene()
        solved(blocks, blocks.contact(master=make(blocks)))

    return do


def plane(point, normal=UP):
    return master(lambda _: cx.Plane(point, normal))


def sphere(radius, **options):
    return master(lambda _: cx.Sphere((0.7, -1.0), radius, **options))


def level(f, *gradient):
    return master(lambda _: cx.LevelSet(f, *gradient))


def up(x):
    return np.stack([0 * x[0], 1 + 0 * x[1]])


def own_function(blocks):
    Q = fem.functionspace(blocks.u.function_space.mesh, ("Lagrange", 1))
    return cx.LevelSet(lambda x: x[1] - fem.Function(Q))


def raises(x):
    raise ZeroDivisionError("in the user's function")


BAD_VECTOR = "{} is .*: give 2 finite numbers"
BAD_RADIUS = "radius of a Sphere is .*: give a positive number"
BAD_LEVEL = "function of a LevelSet or its gradient is not finite, or the gradient zero, at 3 slave"
ROWS = [
    Row("point: a text", plane("ab"), TypeError, BAD_VECTOR.format("point of a Plane")),
    Row("point: complex", plane((0, 1j)), TypeError, BAD_VECTOR.format("point of a Plane")),
    Row("point: ragged", plane([[1], [1, 2]]), TypeError, BAD_VECTOR.format("point of a Plane")),
    Row(
        "point: a displacement",
        master(lambda b: cx.Plane(b.u, UP)),
        TypeError,
        BAD_VECTOR.format("point of a Plane"),
    ),
    Row(
        "point: three numbers", plane((0, 0, 0)), ValueError, BAD_VECTOR.format("point of a Plane")
    ),
    Row(
        "point: NaN",
        plane(constant((0.0, np.nan))),
        ValueError,
        BAD_VECTOR.format("point of a Plane"),
    ),
    Row(
        "point: infinite", plane((0.0, -np.inf)), ValueError, BAD_VECTOR.format("point of a Plane")
    ),
    Row("normal: None", plane((0, 0), None), ValueError, BAD_VECTOR.format("normal of a Plane")),
    Row(
        "normal: infinite",
        plane((0, 0), (0, np.inf)),
        ValueError,
        BAD_VECTOR.format("normal of a Plane"),
    ),
    Row(
        "normal: zero",
        plane((0, 0), (0, 0)),
        ValueError,
        "normal of a Plane is a zero vector: give a direction",
    ),
    Row(
        "normal: downwards",
        plane((0, 0), (0, -1)),
        ValueError,
        "inside the Plane. Its normal probably points the wrong way",
    ),
    Row("radius: a text", sphere("1"), TypeError, BAD_RADIUS),
    Row("radius: None", sphere(None), TypeError, BAD_RADIUS),
    Row("radius: a list", sphere([1.0, 2.0]), TypeError, BAD_RADIUS),
    Row("radius: a vector constant", sphere(constant((1.0, 2.0))), TypeError, BAD_RADIUS),
    Row("radius: complex", sphere(1j), TypeError, BAD_RADIUS),
    Row("radius: zero", sphere(0.0), ValueError, BAD_RADIUS),
    Row("radius: NaN", sphere(constant(np.nan)), ValueError, BAD_RADIUS),
    Row(
        "hollow: a text",
        sphere(1.0, hollow="no"),
        TypeError,
        "hollow is str 'no': give True or False",
    ),
    Row(
        "hollow: the wrong way round",
        sphere(3.0),
        ValueError,
        "inside the Sphere. Perhaps hollow is the wrong way round",
    ),
    Row(
        "cylinder: in the plane",
        master(lambda _: cx.Cylinder((0, 0), UP, 1.0)),
        ValueError,
        "a Cylinder needs 3D: in 2D take a Sphere",
    ),
    Row(
        "level set: no function",
        level(3.0),
        TypeError,
        "f of a LevelSet must be a function, not float",
    ),
    Row(
        "level set: no gradient function",
        level(lambda x: x[1], 3.0),
        TypeError,
        "gradient of a LevelSet must be a function, not float",
    ),
    Row(
        "level set: a text",
        level(lambda x: "x"),
        ValueError,
        r"is not one of UFL: one of Python needs its gradient, too",
    ),
    Row(
        "level set: a third component",
        level(lambda x: x[2]),
        ValueError,
        r"is not one of UFL: one of Python needs its gradient, too",
    ),
    Row(
        "level set: a vector",
        level(lambda x: x),
        ValueError,
        r"expression of shape \(2,\): it must be a scalar",
    ),
    Row("level set: a constant", level(lambda x: 3.0), ValueError, BAD_LEVEL),
    Row(
        "level set: a function on the mesh",
        master(own_function),
        ValueError,
        "holds a function or the coordinates of a mesh: it may",
    ),
    Row(
        "level set: the mesh's coordinates",
        master(lambda b: cx.LevelSet(lambda x: ufl.SpatialCoordinate(b.u.function_space.mesh)[1])),
        ValueError,
        "holds a function or the coordinates of a mesh: it may",
    ),
    Row(
        "level set: the wrong sign",
        level(lambda x: -x[1]),
        ValueError,
        "inside the LevelSet. Perhaps the sign of its function is wrong",
    ),
    Row("level set: NaN", level(lambda x: np.nan * x[1], up), ValueError, BAD_LEVEL),
    Row(
        "level set: a NaN gradient",
        level(lambda x: x[1], lambda x: np.nan * x),
        ValueError,
        BAD_LEVEL,
    ),
    Row(
        "level set: a zero gradient", level(lambda x: x[1], lambda x: 0 * x), ValueError, BAD_LEVEL
    ),
    Row(
        "level set: complex values",
        level(lambda x: 1j * x[1], up),
        TypeError,
        "LevelSet or its gradient gave values of type complex128: they must be real",
    ),
    Row(
        "level set: texts",
        level(lambda x: np.full(x.shape[1], "a"), up),
        TypeError,
        "gave values of type <U1: they must be real",
    ),
    Row(
        "level set: a wrong shape",
        level(lambda x: x, up),
        ValueError,
        r"gave shape \(2, 3\) and its gradient \(2, 3\); they must be \(3,\).* faces, \(m, 3\) and",
    ),
    Row(
        "level set: a gradient of wrong shape",
        level(lambda x: x[1], lambda x: x[1]),
        ValueError,
        r"gradient \(3,\); they must be \(3,\) and \(2, 3\)",
    ),
    Row(
        "level set: an error of its own",
        level(raises, up),
        ZeroDivisionError,
        "in the user's function",
    ),
]


@table(ROWS)
def test_refused(row):
    refused(row)


@pytest.mark.parametrize("size", [1e-320, 1e-200, 1e200, 1e308])
def test_a_normal_of_any_length_is_a_direction(size):
    x = np.array([[0.0, 2.0]])
    assert cx.Plane((0, 1), (0, size)).evaluate(x).gap == pytest.approx(1, rel=1e-14)
