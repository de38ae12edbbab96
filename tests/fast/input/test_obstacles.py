# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacles."""

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from inputs.rows import constant, refused, scene, solved, table

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
ROWS = {
    TypeError: [
        (
            lambda: cx.LevelSet(up, velocity=1.0, time=0.0),
            "velocity of a LevelSet must be a function, not float",
        ),
        (lambda: cx.LevelSet(up, velocity=up, time="now"), "time of a LevelSet is 'now'"),
        (plane("ab"), BAD_VECTOR.format("point of a Plane")),
        (plane((0, 1j)), BAD_VECTOR.format("point of a Plane")),
        (plane([[1], [1, 2]]), BAD_VECTOR.format("point of a Plane")),
        (master(lambda b: cx.Plane(b.u, UP)), BAD_VECTOR.format("point of a Plane")),
        (sphere("1"), BAD_RADIUS),
        (sphere(None), BAD_RADIUS),
        (sphere([1.0, 2.0]), BAD_RADIUS),
        (sphere(constant((1.0, 2.0))), BAD_RADIUS),
        (sphere(1j), BAD_RADIUS),
        (sphere(1.0, hollow="no"), "hollow is str 'no': give True or False"),
        (level(3.0), "f of a LevelSet must be a function, not float"),
        (level(lambda x: x[1], 3.0), "gradient of a LevelSet must be a function, not float"),
        (
            level(lambda x: 1j * x[1], up),
            "LevelSet or its gradient gave values of type complex128: they must be real",
        ),
        (
            level(lambda x: np.full(x.shape[1], "a"), up),
            "gave values of type <U1: they must be real",
        ),
    ],
    ValueError: [
        (lambda: cx.LevelSet(up, velocity=up), "has a velocity but no time"),
        (lambda: cx.LevelSet(up, time=0.0), "has a time but no velocity"),
        (plane((0, 0, 0)), BAD_VECTOR.format("point of a Plane")),
        (plane(constant((0.0, np.nan))), BAD_VECTOR.format("point of a Plane")),
        (plane((0.0, -np.inf)), BAD_VECTOR.format("point of a Plane")),
        (plane((0, 0), None), BAD_VECTOR.format("normal of a Plane")),
        (plane((0, 0), (0, np.inf)), BAD_VECTOR.format("normal of a Plane")),
        (plane((0, 0), (0, 0)), "normal of a Plane is a zero vector: give a direction"),
        (plane((0, 0), (0, -1)), "inside the Plane. Its normal probably points the wrong way"),
        (sphere(0.0), BAD_RADIUS),
        (sphere(constant(np.nan)), BAD_RADIUS),
        (sphere(3.0), "inside the Sphere. Perhaps hollow is the wrong way round"),
        (
            master(lambda _: cx.Cylinder((0, 0), UP, 1.0)),
            "a Cylinder needs 3D: in 2D take a Sphere",
        ),
        (level(lambda x: "x"), r"is not one of UFL: one of Python needs its gradient, too"),
        (level(lambda x: x[2]), r"is not one of UFL: one of Python needs its gradient, too"),
        (level(lambda x: x), r"expression of shape \(2,\): it must be a scalar"),
        (level(lambda x: 3.0), BAD_LEVEL),
        (master(own_function), "holds a function or the coordinates of a mesh: it may"),
        (
            master(
                lambda b: cx.LevelSet(lambda x: ufl.SpatialCoordinate(b.u.function_space.mesh)[1])
            ),
            "holds a function or the coordinates of a mesh: it may",
        ),
        (level(lambda x: -x[1]), "inside the LevelSet. Perhaps the sign of its function is wrong"),
        (level(lambda x: np.nan * x[1], up), BAD_LEVEL),
        (level(lambda x: x[1], lambda x: np.nan * x), BAD_LEVEL),
        (level(lambda x: x[1], lambda x: 0 * x), BAD_LEVEL),
        (
            level(lambda x: x, up),
            r"gave shape \(2, 3\) and its gradient \(2, 3\); they must be \(3,\).* faces, \(m, 3\)",
        ),
        (
            level(lambda x: x[1], lambda x: x[1]),
            r"gradient \(3,\); they must be \(3,\) and \(2, 3\)",
        ),
    ],
    ZeroDivisionError: [
        (level(raises, up), "in the user's function"),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)
