# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Level sets as functions: derivatives by central differences; constants move obstacles."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from contactx._host.ufl_function import UFLFunction
from dolfinx import fem, mesh


def length(v):
    return ufl.sqrt(ufl.dot(v, v))


def cases(gdim):
    """Level sets of UFL and of Python."""
    point = np.array([0.1, 0.2, -0.3])[:gdim]
    p = ufl.as_vector(point)
    yield "ufl", cx.LevelSet(lambda x: ufl.dot(x - p, x - p) + 0.3 * ufl.sin(x[0]) - 0.5)
    yield (
        "python",
        cx.LevelSet(
            lambda x: ((x.T - point) ** 2).sum(axis=1) - 0.5 + x[0] * x[1],
            lambda x: 2 * (x - point[:, None]) + _product_gradient(x),
        ),
    )


def _product_gradient(x):
    g = np.zeros_like(x)
    g[0], g[1] = x[1], x[0]
    return g


CASES = [(gdim, name) for gdim in (2, 3) for name, _ in cases(gdim)]


@pytest.mark.parametrize(("gdim", "name"), CASES)
def test_derivatives(gdim, name):
    obstacle = dict(cases(gdim))[name]
    x = np.random.default_rng(1).uniform(0.5, 1.5, (100, gdim))
    at = obstacle.evaluate(x)
    assert np.linalg.norm(at.normal, axis=1) == pytest.approx(1, rel=1e-14)
    h = 1e-5
    for k in range(gdim):
        dx = h * np.eye(gdim)[k]
        plus, minus = obstacle.evaluate(x + dx), obstacle.evaluate(x - dx)
        gradient = (plus.gap - minus.gap) / (2 * h)
        assert np.abs(at.gradient[:, k] - gradient).max() <= 1e-7 * np.abs(at.gradient).max()
        curvature = (plus.normal - minus.normal) / (2 * h)
        assert np.abs(at.curvature[:, :, k] - curvature).max() <= 1e-7 * max(
            1, np.abs(at.curvature).max()
        )


@pytest.mark.parametrize(("gdim", "name"), CASES)
def test_no_points(gdim, name):
    """As on a rank without slave nodes."""
    obstacle = dict(cases(gdim))[name]
    at = obstacle.evaluate(np.zeros((0, gdim)))
    shapes = [part.shape for part in (at.gap, at.gradient, at.normal, at.curvature)]
    assert shapes == [(0,), (0, gdim), (0, gdim), (0, gdim, gdim)]
    assert obstacle.level(np.zeros((0, gdim))).shape == (0,)


def test_functions_are_not_asked_about_no_points():
    """They may not be made for that."""
    level_set = cx.LevelSet(lambda x: x[0] - x[0].min(), lambda x: np.eye(2)[:, [0]] + 0 * x)
    assert len(level_set.evaluate(np.zeros((0, 2))).gap) == 0
    assert len(level_set.level(np.zeros((0, 2)))) == 0
    ufl_set = cx.LevelSet(lambda x: x[0])
    assert len(ufl_set.level(np.zeros((0, 2)))) == 0


def test_a_level_set_that_is_no_distance_measures_to_first_order():
    x = np.array([[1.001, 0.0], [0.0, 0.999]])
    square = cx.LevelSet(lambda p: 5 * (ufl.dot(p, p) - 1)).evaluate(x)
    assert square.gap == pytest.approx([1e-3, -1e-3], rel=1e-3)


def test_constants_move_an_obstacle():
    domain = mesh.create_unit_cube(MPI.COMM_SELF, 1, 1, 1)
    height = fem.Constant(domain, np.array([0.0, 0.0, 1.0]))
    radius = fem.Constant(domain, 1.0)
    x = np.array([[0.0, 0.0, 3.0]])
    plane, sphere = cx.Plane(height, (0, 0, 1)), cx.Sphere(height, radius)
    level_set = cx.LevelSet(lambda p: length(p - height) - radius)
    assert plane.evaluate(x).gap == pytest.approx(2)
    assert sphere.evaluate(x).gap == pytest.approx(1)
    assert level_set.evaluate(x).gap == pytest.approx(1)
    height.value[2], radius.value = 2.0, 0.5
    assert plane.evaluate(x).gap == pytest.approx(1)
    assert sphere.evaluate(x).gap == pytest.approx(0.5)
    assert level_set.evaluate(x).gap == pytest.approx(0.5)


def test_constants_are_told_without_points():
    """As on a rank without slave nodes: all ranks save as many of them."""
    domain = mesh.create_unit_cube(MPI.COMM_SELF, 1, 1, 1)
    height = fem.Constant(domain, np.array([0.0, 1.0]))
    level_set = cx.LevelSet(lambda p: p[1] - height[1])
    assert level_set.parameters(2).tolist() == [0, 1]
    level_set.evaluate(np.ones((4, 2)))
    height.value[1] = 3
    assert level_set.parameters(2).tolist() == [0, 3]


def pyramid(x):
    return ufl.max_value(abs(x[0]), 2.0 * abs(x[1])) / 2 + x[2]


@pytest.mark.parametrize(
    ("f", "normals"),
    [
        (pyramid, [(0.5, 0, 1), (-0.5, 0, 1), (0, 1, 1), (0, -1, 1)]),
        (lambda x: abs(x[0]) + abs(x[1]) + x[2], [(1, 1, 1), (1, -1, 1), (-1, 1, 1), (-1, -1, 1)]),
        (lambda x: 3 * ufl.max_value(x[2], x[0]), [(0, 0, 1), (1, 0, 0)]),
        (lambda x: ufl.max_value(x[2], -x[2]), [(0, 0, 1), (0, 0, -1)]),
        # In a valley, and behind what tells nothing, one face is as good as none
        (lambda x: ufl.min_value(x[2], x[0]), None),
        (lambda x: -abs(x[0]) + x[2], None),
        (lambda x: x[2], None),
    ],
)
def test_kinks_of_ufl_are_faces(f, normals):
    level_set = UFLFunction(f, "LevelSet", in_faces=True)
    x = np.random.default_rng(2).uniform(-1, 1, (7, 3))
    value, gradient, second = level_set.values(x, 2)
    count = len(normals or [0])
    assert value.shape == (count, 7)
    assert gradient.shape == (count, 7, 3)
    assert second.shape == (count, 7, 3, 3)
    assert np.abs(second).max() == 0
    assert cx.LevelSet(f).level(x) == pytest.approx(value.max(axis=0), abs=1e-15)
    if normals is not None:
        found = gradient / np.linalg.norm(gradient, axis=2)[:, :, None]
        expected = np.array(normals) / np.linalg.norm(normals, axis=1)[:, None]
        assert {tuple(n) for n in found[:, 0].round(12) + 0.0} == {
            tuple(n) for n in expected.round(12) + 0.0
        }


def test_faces_of_python_are_those_of_ufl():
    def value(x):
        return np.stack([s * x[k] * (1 + k) / 2 + x[2] for k in (0, 1) for s in (1, -1)])

    def slope(x):
        g = np.zeros((4, *x.shape))
        for face, (k, s) in enumerate([(0, 1), (0, -1), (1, 1), (1, -1)]):
            g[face, k], g[face, 2] = s * (1 + k) / 2, 1
        return g

    x = np.random.default_rng(3).uniform(-0.3, 0.3, (50, 3))
    ours, theirs = cx.LevelSet(pyramid).evaluate(x), cx.LevelSet(value, slope).evaluate(x)
    for part in ("gap", "normal", "gradient", "curvature"):
        assert getattr(ours, part) == pytest.approx(getattr(theirs, part), abs=1e-7)
    on_apex = cx.LevelSet(pyramid).evaluate(np.zeros((2, 3)))
    assert on_apex.normal[0] == pytest.approx([0, 0, 1], abs=1e-15)
