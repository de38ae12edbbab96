# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slip over rigid obstacles: its derivative, its measure, moving obstacles."""

from types import SimpleNamespace

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from contactx import cpp as core
from contactx.master.obstacle import ObstacleMaster
from contactx.master.ties import ObstacleTie
from dolfinx import fem, mesh

N = 12
SLAVES = np.arange(N, dtype=np.int32)
# Slave nodes without a surface
ALL_FACE = SimpleNamespace(owned=SLAVES, facing=lambda x, normal: np.ones(N, dtype=bool))
OPEN = np.zeros(N, dtype=np.int8)
NO_OFFSET = np.zeros(N)
GDIMS = pytest.mark.parametrize("gdim", [2, 3])


def constant(value):
    domain = mesh.create_unit_interval(MPI.COMM_SELF, 1)
    return fem.Constant(domain, np.asarray(value, dtype=np.float64))


def make(kind, gdim):
    """An obstacle of its parameters' shape (gdim,)."""
    if kind == "plane":
        return cx.Plane(np.full(gdim, 0.1), np.arange(1.0, gdim + 1))
    if kind == "sphere":
        return cx.Sphere(np.full(gdim, 0.1), 0.8)
    if kind == "cylinder":
        return cx.Cylinder((0.1, 0, 0.2), (1, 2, -1), 0.8)
    if kind == "bowl":
        return cx.Sphere(np.full(gdim, 0.1), 3.0, hollow=True)
    return cx.LevelSet(lambda x: x[gdim - 1] - 0.3 * x[0] ** 2 + 0.2 * x[0] * x[1] - 0.1)


KINDS = [(kind, d) for kind in ("plane", "sphere", "bowl", "level set") for d in (2, 3)]
KINDS.append(("cylinder", 3))


def points(gdim, seed=0):
    rng = np.random.default_rng(seed)
    return 1.5 * rng.standard_normal((N, gdim)) + 0.5


def slip_table(master, x, *, frozen=False, offset=NO_OFFSET):
    """Slip, its derivative, gap and normal that the kernels are given at positions x."""
    (pairs,) = master.update(x, frozen, offset)
    n, gdim = x.shape
    assert np.array_equal(pairs.slaves[:, 0], SLAVES)

    def part(data, layout, name, *shape):
        first = layout[name]
        return data[:, first : first + np.prod(shape, dtype=int)].reshape(n, *shape)

    return (
        part(pairs.slip, core.rigid_slip_layout, "slip", gdim),
        part(pairs.slip, core.rigid_slip_layout, "derivative", gdim, gdim),
        part(pairs.data, core.rigid_layout, "gap", 1)[:, 0],
        part(pairs.data, core.rigid_layout, "normal", gdim),
    )


def started(kind, gdim, x):
    master = ObstacleMaster(ALL_FACE, make(kind, gdim), x, None, measures_slip=True)
    master.search(x, OPEN)
    return master


@pytest.mark.parametrize(("kind", "gdim"), KINDS)
@pytest.mark.parametrize("frozen", [False, True])
def test_derivative_is_that_of_the_slip(kind, gdim, frozen):
    x0 = points(gdim)
    master = started(kind, gdim, x0)
    x = x0 + 0.3 * np.random.default_rng(1).standard_normal(x0.shape)
    derivative = slip_table(master, x, frozen=frozen)[1]
    h = 1e-6
    for k in range(gdim):
        dx = np.zeros(gdim)
        dx[k] = h
        plus, minus = (slip_table(master, x + s * dx, frozen=frozen)[0] for s in (1, -1))
        assert np.abs((plus - minus) / (2 * h) - derivative[:, :, k]).max() <= 1e-8


@pytest.mark.parametrize(("kind", "gdim"), KINDS)
def test_slip_is_the_tangential_part_of_the_way(kind, gdim):
    x0 = points(gdim)
    master = started(kind, gdim, x0)
    way = 0.3 * np.random.default_rng(1).standard_normal(x0.shape)
    slip, _, _, normal = slip_table(master, x0 + way)
    height = np.einsum("ij,ij->i", way, normal)
    assert np.abs(slip - way + height[:, None] * normal).max() <= 1e-14
    assert np.abs(slip_table(master, x0)[0]).max() <= 1e-15


@pytest.mark.parametrize(("kind", "gdim"), KINDS)
def test_next_step_starts_where_the_last_one_ended(kind, gdim):
    x0 = points(gdim)
    master = started(kind, gdim, x0)
    x1 = x0 + 0.1
    master.accept(x1)
    # Not before the step begins
    assert np.abs(slip_table(master, x0)[0]).max() <= 1e-15
    master.begin_step()
    assert np.abs(slip_table(master, x1)[0]).max() <= 1e-15
    assert np.abs(slip_table(master, x0)[0]).max() > 0.01


def rotation(a, b):
    """Shortest rotation from a to b, from its axis and angle."""
    a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
    if len(a) == 2:
        angle = np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, -s], [s, c]])
    axis = np.cross(a, b)
    angle = np.arctan2(np.linalg.norm(axis), a @ b)
    axis /= np.linalg.norm(axis)
    K = np.cross(np.eye(3), axis)
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def moving(kind, gdim):
    """An obstacle, how to move it, and the motion that its material makes."""
    start, end = np.full(gdim, 0.1), np.linspace(-0.3, 0.7, gdim)
    a, b = np.arange(1.0, gdim + 1), np.array([2.0, -0.5, 1.5])[:gdim]
    point, direction = constant(start), constant(a)
    obstacle = {
        "plane": lambda: cx.Plane(point, direction),
        "sphere": lambda: cx.Sphere(point, 0.8),
        "cylinder": lambda: cx.Cylinder(point, direction, 0.8),
    }[kind]()
    turn = np.eye(gdim) if kind == "sphere" else rotation(a, b)

    def move():
        point.value[:] = end
        direction.value[:] = b

    return obstacle, move, lambda x: end + (x - start) @ turn.T


@pytest.mark.parametrize(
    ("kind", "gdim"), [("plane", 2), ("plane", 3), ("sphere", 2), ("sphere", 3), ("cylinder", 3)]
)
def test_an_obstacle_that_carries_a_node_does_not_slip_under_it(kind, gdim):
    obstacle, move, carried = moving(kind, gdim)
    x0 = points(gdim)
    master = ObstacleMaster(ALL_FACE, obstacle, x0, None, measures_slip=True)
    master.search(x0, OPEN)
    gap0 = slip_table(master, x0)[2]
    move()
    x1 = carried(x0)
    slip, _, gap, _ = slip_table(master, x1)
    assert np.abs(slip).max() <= 1e-14
    assert np.abs(gap - gap0).max() <= 1e-14
    # A node that stays behind slips the other way
    stayed = slip_table(master, x0)
    way = x0 - x1
    across = way - np.einsum("ij,ij->i", way, stayed[3])[:, None] * stayed[3]
    assert np.abs(stayed[0] - across).max() <= 1e-14
    assert np.abs(across).max() > 0.1
    # The next step starts from there
    master.accept(x1)
    master.begin_step()
    assert np.abs(slip_table(master, x1)[0]).max() <= 1e-14


@GDIMS
def test_a_tie_moves_with_its_obstacle_over_steps(gdim):
    obstacle, move, carried = moving("plane", gdim)
    x0 = points(gdim)
    tie = ObstacleTie(ALL_FACE, obstacle, x0, None, measures_slip=True)
    tie.search(x0, OPEN)
    assert np.abs(slip_table(tie, x0)[0]).max() <= 1e-15
    move()
    x1 = carried(x0)
    d = np.linspace(0.1, 0.3, gdim)
    slip, derivative, *_ = slip_table(tie, x1 + d)
    assert np.abs(slip - d).max() <= 1e-14
    assert np.array_equal(derivative, np.tile(np.eye(gdim), (N, 1, 1)))
    tie.accept(x1 + d)
    tie.begin_step()
    # The tie's place is that of the reference for ever
    assert np.abs(slip_table(tie, x1 + d)[0] - d).max() <= 1e-14


@GDIMS
def test_offset_makes_a_tie_longer_along_the_normal_that_turns(gdim):
    obstacle, move, carried = moving("plane", gdim)
    x0 = points(gdim)
    tie = ObstacleTie(ALL_FACE, obstacle, x0, None, measures_slip=True)
    tie.search(x0, OPEN)
    offset = np.linspace(-0.2, 0.3, N)
    move()
    x1 = carried(x0)
    normal = slip_table(tie, x1)[3]
    longer = x1 + offset[:, None] * normal
    assert np.abs(slip_table(tie, longer, offset=offset)[0]).max() <= 1e-14


@GDIMS
def test_first_touch_is_where_the_way_meets_the_plane(gdim):
    """Seen from the plane, which comes up to the nodes and moves aside meanwhile."""
    up = np.eye(gdim)[-1]
    point = constant(np.zeros(gdim))
    x0 = points(gdim)
    x0[:, -1] = np.linspace(0.1, 0.6, N)
    master = ObstacleMaster(ALL_FACE, cx.Plane(point, up), x0, None, measures_slip=True)
    master.search(x0, OPEN)
    point.value[:] = 0.25 * up + 0.1 * np.eye(gdim)[0]
    x = x0.copy()
    x[:, 0] += 0.5
    x[:, -1] -= 0.5
    offset = np.full(N, 0.05)
    which = np.arange(N) % 2 == 0
    master.touch(which, x, offset)
    slip = slip_table(master, x)[0]
    # Gaps go from z - 0.05 to z - 0.8; relative to the plane the way aside is 0.4
    left = 1 - (x0[:, -1] - 0.05) / 0.75
    expected = np.where(which, 0.4 * left, 0.4)
    assert np.abs(slip[:, 0] - expected).max() <= 1e-14
    assert np.abs(slip[:, 1:]).max() <= 1e-14


@GDIMS
def test_a_half_turn_has_no_shortest_way(gdim):
    direction = constant(np.eye(gdim)[0])
    x0 = points(gdim)
    plane = cx.Plane(np.zeros(gdim), direction)
    master = ObstacleMaster(ALL_FACE, plane, x0, None, measures_slip=True)
    master.search(x0, OPEN)
    direction.value[:] = -np.eye(gdim)[0]
    with pytest.raises(ValueError, match="turns by 180 degrees within a step"):
        master.update(x0, False, NO_OFFSET)


def test_nothing_tangential_without_friction():
    x0 = points(3)
    master = ObstacleMaster(ALL_FACE, make("plane", 3), x0, None, measures_slip=False)
    master.search(x0, OPEN)
    (pairs,) = master.update(x0 + 0.1, False, NO_OFFSET)
    assert pairs.slip is None
