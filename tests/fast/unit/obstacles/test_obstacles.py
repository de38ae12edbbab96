# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Obstacles as functions: derivatives by central differences, invariance, bad input."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem, mesh

AXIS = np.array([0.3, -0.5, 0.8])


def length(v):
    return ufl.sqrt(ufl.dot(v, v))


def cases(gdim):
    """Obstacles and points outside of their singular places."""
    point, normal = np.array([0.1, 0.2, -0.3])[:gdim], np.array([0.4, -1.0, 2.0])[:gdim]
    yield "plane", cx.Plane(point, normal)
    yield "sphere", cx.Sphere(point, 0.7)
    yield "bowl", cx.Sphere(point, 3.0, hollow=True)
    if gdim == 3:
        yield "cylinder", cx.Cylinder(point, AXIS, 0.7)
        yield "pipe", cx.Cylinder(point, AXIS, 3.0, hollow=True)
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


def test_a_curvature_does_not_depend_on_other_points():
    """Which of them a rank has must not matter; one at the origin has no length of its own."""
    obstacle = cx.LevelSet(
        lambda x: x[1] + np.sin(x[0]), lambda x: np.stack([np.cos(x[0]), 1 + 0 * x[1]])
    )
    obstacle.extent = 2.0
    x = np.array([[0.0, 0.0], [0.3, 0.1], [-0.7, 1.0]])
    every = obstacle.evaluate(x).curvature
    each = np.concatenate([obstacle.evaluate(point[None]).curvature for point in x])
    assert np.array_equal(each, every)


def test_gaps_and_normals_of_known_points():
    x = np.array([[0.0, 0.0, 2.0], [3.0, 4.0, 0.0]])
    plane = cx.Plane((0, 0, 1), (0, 0, 5)).evaluate(x)
    assert plane.gap == pytest.approx([1, -1])
    assert np.array_equal(plane.normal, [[0, 0, 1], [0, 0, 1]])
    sphere = cx.Sphere((0, 0, 0), 4.0).evaluate(x)
    assert sphere.gap == pytest.approx([-2, 1])
    assert sphere.normal == pytest.approx(np.array([[0, 0, 1], [0.6, 0.8, 0]]))
    bowl = cx.Sphere((0, 0, 0), 4.0, hollow=True).evaluate(x)
    assert bowl.gap == pytest.approx([2, -1])
    assert bowl.normal == pytest.approx(-sphere.normal)
    cylinder = cx.Cylinder((0, 0, 7), (0, 2, 0), 1.0).evaluate(x)
    assert cylinder.gap == pytest.approx([np.hypot(0, 5) - 1, np.hypot(3, 7) - 1])


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


@pytest.mark.parametrize(
    ("obstacle", "message"),
    [
        (cx.Cylinder((0, 0, 0), (0, 0, 0), 1.0), "axis of a Cylinder is a zero vector"),
    ],
)
def test_an_axis_without_direction(obstacle, message):
    with pytest.raises(ValueError, match=message):
        obstacle.evaluate(np.array([[1.0, 2.0, 3.0]]))


@pytest.mark.parametrize(
    "obstacle", [cx.Sphere((1, 2, 3), 1.5), cx.Cylinder((1, 2, 0), (0, 0, 1), 1.5)]
)
def test_in_the_centre_there_is_no_normal(obstacle):
    geometry = obstacle.evaluate(np.array([[1.0, 2.0, 3.0]]))
    assert geometry.gap == -1.5
    assert not geometry.normal.any()
    assert not geometry.curvature.any()
