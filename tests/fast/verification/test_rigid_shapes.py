# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Level sets as functions, their ridges and apexes pressed into blocks, and obstacles that spin."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from contactx._host.ufl_function import UFLFunction
from dolfinx import fem, mesh

import story
from scenes.grids import faces
from scenes.problems import make_problem
from story import displacement, elasticity

both_methods = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])


def pressed(shape, gdim, n, cells, method):
    """Force on a block from a body of which the top is lower than its apex by a shape.

    Args:
        shape: Of the position along the surface; zero at the apex, which is below a node.
    """
    corners = [[-0.5] * (gdim - 1) + [0], [0.5] * (gdim - 1) + [0.6]]
    make = mesh.create_box if gdim == 3 else mesh.create_rectangle
    domain = make(MPI.COMM_WORLD, corners, [n] * (gdim - 1) + [n // 2], cells)
    u = displacement(domain)
    tags = faces(domain, [(gdim - 1, 0), (gdim - 1, 0.6)])
    V = u.function_space
    held = fem.locate_dofs_topological(V, gdim - 1, tags.find(2))
    bc = fem.dirichletbc(np.zeros(gdim), held, V)
    tool = cx.LevelSet(lambda x: shape(x) + x[gdim - 1] - 0.02)
    contact = cx.Contact(cx.Surface(tags, 1), tool, method=method)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], [bc])
    problem.solve()
    return contact.force


def sideways(force):
    assert force[-1] > 0
    return np.abs(force[:-1]).max() / force[-1]


PYRAMIDS = [
    pytest.param(lambda x: 0.3 * ufl.max_value(abs(x[0]), abs(x[1])), id="beside its nodes"),
    pytest.param(lambda x: 0.2 * (abs(x[0]) + abs(x[1])), id="on its nodes"),
]


@both_methods
@pytest.mark.parametrize("shape", PYRAMIDS)
def test_a_pyramid_pushed_straight_down_feels_nothing_sideways(shape, method):
    """It felt 13 to 24 %: the apex had the normal of one of its faces."""
    force = pressed(shape, 3, 8, mesh.CellType.hexahedron, method)
    assert sideways(force) < 1e-10


@both_methods
@pytest.mark.parametrize("n", [8, 64])
def test_a_wedge_pushed_straight_down_feels_nothing_sideways(method, n):
    """Also where linear solves leave the node beside the ridge."""
    force = pressed(lambda x: 0.3 * abs(x[0]), 2, n, mesh.CellType.quadrilateral, method)
    assert sideways(force) < 1e-6


def test_cells_that_are_not_symmetric_make_little_of_it():
    """A node that leaves the ridge a little must not slide down one of its sides."""
    force = pressed(PYRAMIDS[0].values[0], 3, 8, mesh.CellType.tetrahedron, "node-to-surface")
    assert sideways(force) < 5e-3


RADIUS, DEEP, YOUNG = 5.0, 0.05, 10.0


class OnRoll:
    """A block above a large roll, held at its top and pressed down.

    Attributes:
        contact: The block's lower face on the roll.
    """

    def __init__(self, dim, method, **options):
        corners = [[-0.5] * (dim - 1) + [0], [0.5] * (dim - 1) + [1]]
        if dim == 2:
            domain = mesh.create_rectangle(MPI.COMM_WORLD, corners, [6, 6])
        else:
            domain = mesh.create_box(MPI.COMM_WORLD, corners, [4, 4, 4])
        self.u = story.displacement(domain)
        V = self.u.function_space
        tags = faces(domain, [(dim - 1, 0), (dim - 1, 1)])
        down = np.zeros(dim)
        down[-1] = -DEEP
        bcs = [fem.dirichletbc(down, fem.locate_dofs_topological(V, dim - 1, tags.find(2)), V)]
        if dim == 2:
            self.angle = fem.Constant(domain, 0.0)
            roll = cx.Sphere((0, -RADIUS), RADIUS, angle=self.angle)
        elif options.pop("ball", False):
            self.angle = fem.Constant(domain, np.zeros(3))
            roll = cx.Sphere((0, 0, -RADIUS), RADIUS, angle=self.angle)
        else:
            self.angle = fem.Constant(domain, 0.0)
            roll = cx.Cylinder((0, 0, -RADIUS), (0, 1, 0), RADIUS, angle=self.angle)
        self.contact = cx.Contact(cx.Surface(tags, 1), roll, method=method, **options)
        self.problem = make_problem(
            story.elasticity(self.u, YOUNG, 0.3), self.u, [self.contact], bcs
        )

    def spin(self, angle):
        self.angle.value = angle
        self.problem.solve()
        return self.contact.force


@pytest.mark.parametrize("method", story.METHODS)
@pytest.mark.parametrize("dim", [2, 3])
def test_a_roll_that_spins_drags_by_friction(dim, method):
    scene = OnRoll(dim, method, friction=0.2)
    still = scene.spin(0.0)
    # Triangles are not symmetric
    assert abs(still[0]) < 0.02 * still[-1]
    # Counter-clockwise in the plane its top goes left; about +y, in space, right
    sign = -1 if dim == 2 else 1
    for angle in (0.02, 0.04):
        force = scene.spin(angle)
    forces = scene.contact.area[:, None] * scene.contact.multiplier
    normal = scene.contact.discrete.nodes.normal
    p = np.einsum("ij,ij->i", forces, normal)
    t = np.linalg.norm(forces - p[:, None] * normal, axis=1)
    np.testing.assert_allclose(t, 0.2 * p, rtol=1e-6, atol=1e-9)
    assert force[0] == pytest.approx(sign * 0.2 * force[-1], rel=0.08)
    # All nodes in contact have slid by what the roll's surface has moved
    closed = scene.contact.discrete.nodes.closed
    slip = scene.contact.slip.x.array.reshape(-1, dim)[scene.contact.slave_nodes]
    np.testing.assert_allclose(slip[closed, 0], -sign * 0.02 * RADIUS, rtol=0.05)
    # And back
    assert scene.spin(0.0)[0] == pytest.approx(-sign * 0.2 * force[-1], rel=0.08)


def test_a_ball_spins_by_a_rotation_vector():
    scene = OnRoll(3, story.METHODS[0], ball=True, friction=0.2)
    scene.spin(np.zeros(3))
    first, second = scene.spin(np.array([0, 0.03, 0])).copy(), scene.spin(np.zeros(3)).copy()
    other = OnRoll(3, story.METHODS[0], ball=True, friction=0.2)
    other.spin(np.zeros(3))
    aside = other.spin(np.array([-0.03, 0, 0]))
    assert first[0] > 0.9 * 0.2 * first[2]
    assert second[0] < -0.9 * 0.2 * second[2]
    assert aside[1] == pytest.approx(first[0], rel=1e-6)


def test_angles_that_are_none_are_refused():
    scene = OnRoll(2, story.METHODS[0], friction=0.2)
    scene.angle.value = np.nan
    with pytest.raises(ValueError, match=r"angle of a Sphere is .*nan.*: give a finite number"):
        scene.problem.solve()


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


def pyramid_of(x):
    return ufl.max_value(abs(x[0]), 2.0 * abs(x[1])) / 2 + x[2]


@pytest.mark.parametrize(
    ("f", "normals"),
    [
        (pyramid_of, [(0.5, 0, 1), (-0.5, 0, 1), (0, 1, 1), (0, -1, 1)]),
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
    ours, theirs = cx.LevelSet(pyramid_of).evaluate(x), cx.LevelSet(value, slope).evaluate(x)
    for part in ("gap", "normal", "gradient", "curvature"):
        assert getattr(ours, part) == pytest.approx(getattr(theirs, part), abs=1e-7)
    on_apex = cx.LevelSet(pyramid_of).evaluate(np.zeros((2, 3)))
    assert on_apex.normal[0] == pytest.approx([0, 0, 1], abs=1e-15)
