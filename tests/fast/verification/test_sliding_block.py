# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block that sticks, slides and slides back, on a rigid plane and on an elastic base."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from scenes import CELLS, dimension
from scenes.coulomb import parts
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.driven import DrivenBlock

pytestmark = pytest.mark.usefixtures("method")

MU = 0.3
DOWN = -0.02
BASES = ("plane", "elastic")
BOXES = (CellType.quadrilateral, CellType.hexahedron)


def block(cell, base, sliding, **options):
    """A block above a plane or a base whose divisions do not match."""
    gdim = dimension(cell)
    up = (0.0,) * (gdim - 1) + (1.0,)
    plane = cx.Plane((0.0,) * gdim, up) if base == "plane" else None
    return DrivenBlock(cell, plane=plane, sliding=sliding, friction=MU, **options)


def along(scene, x, down=DOWN):
    """Move the top along the first axis."""
    scene.step(x, *(0.0,) * (scene.gdim - 2), down)


def on_moving_plane(cell, sliding):
    """A block on a plane whose point is a constant that may be changed."""
    gdim = dimension(cell)
    domain = mesh.create_unit_square(MPI.COMM_SELF, 1, 1)
    point = fem.Constant(domain, np.zeros(gdim))
    plane = cx.Plane(point, (0.0,) * (gdim - 1) + (1.0,))
    return DrivenBlock(cell, plane=plane, sliding=sliding, friction=MU), point


def resistance(scene):
    """Friction along the movement over what full sliding would give, with its sign."""
    return scene.tangential[0] / (MU * scene.normal)


@covering(cell=CELLS, base=BASES, **{"sliding,method": BOTH})
def test_stays_slides_and_slides_back(cell, base, sliding):
    scene = block(cell, base, sliding)
    along(scene, 0.0)
    path = []
    for x in (0.002, 0.004, 0.006, 0.05, 0.1, 0.098, 0.096, 0.05, 0.0, 0.002, 0.05, 0.1):
        along(scene, x)
        path.append(resistance(scene))
        if x in (0.05, 0.1, 0.0):
            p, t = parts(scene.contact)
            assert (scene.contact.status.x.array != 1).all()
            total = scene.contact.area @ np.linalg.norm(t, axis=1)
            assert total == pytest.approx(MU * (scene.contact.area @ p), rel=1e-8)
    print(scene.iterations, [f"{r:+.4f}" for r in path])
    path = np.array(path)
    # Sticking the force grows against the movement, and stays below friction times pressure
    assert np.all(np.diff(path[:3]) < 0)
    assert np.all(np.abs(path[:3]) < 0.9)
    # Slides in the normals of a dented base, or across a little in 3D
    loose = 0.02 if (scene.gdim == 3 or (base, sliding) == ("elastic", "finite")) else 1e-8
    assert path[3:5] == pytest.approx(-1, abs=loose)
    assert -1 < path[5] < path[6] < 0.9
    assert path[7:9] == pytest.approx(1, abs=loose)
    assert -0.9 < path[9] < 1
    assert path[10:] == pytest.approx(-1, abs=loose)
    # The loop closes: the same place after the same reversal has the same force
    assert path[11] == pytest.approx(path[4], abs=1e-3)
    assert max(scene.iterations) <= 10


@covering(base=BASES, sliding=SLIDINGS, method=METHODS)
def test_circular_path(base, sliding):
    """Friction opposes the velocity in every step once all slide."""
    scene = block(CellType.hexahedron, base, sliding, n_upper=2, n_lower=3)
    radius, steps = 0.3, 12
    scene.step(0, 0, DOWN)
    before = np.zeros(2)
    off = []
    for k in range(1, steps + 1):
        angle = 2 * np.pi * k / steps
        place = radius * np.array([np.cos(angle) - 1, np.sin(angle)])
        scene.step(*place, DOWN)
        p, t = parts(scene.contact)
        slip = scene.contact.discrete.history.slip
        assert (scene.contact.discrete.nodes.status == 2).all()
        against = np.einsum("ij,ij->i", t, slip) / np.linalg.norm(slip, axis=1)
        assert against == pytest.approx(-MU * p, rel=1e-8)
        # The block is elastic: its foot lags behind its top
        way = place - before
        before = place
        cosine = -scene.tangential @ way / np.linalg.norm(way) / np.linalg.norm(scene.tangential)
        off.append(np.degrees(np.arccos(cosine)))
    print(scene.iterations, f"{max(off):.2f} degrees off")
    assert max(off) < 5


@covering(cell=BOXES, sliding=SLIDINGS, method=METHODS)
def test_a_plane_that_moves_drags_a_fixed_block(cell, sliding):
    gdim = dimension(cell)
    scene, point = on_moving_plane(cell, sliding)
    along(scene, 0.0)
    point.value[0] += 0.2
    along(scene, 0.0)
    assert resistance(scene) == pytest.approx(1, abs=0 if gdim == 2 else 0.01, rel=1e-8)
    slip = scene.contact.discrete.history.slip
    print(scene.iterations, slip[:, 0])
    assert np.all(slip[:, 0] < -0.15)
    # A new step in which nothing moves slips no more, and keeps its force
    force = scene.contact.force.copy()
    along(scene, 0.0)
    assert scene.contact.force == pytest.approx(force, rel=1e-9, abs=1e-12)
    assert np.abs(scene.contact.discrete.history.slip).max() < 1e-12


@covering(guess=(True, False), cell=BOXES, sliding=SLIDINGS, method=METHODS)
def test_a_plane_that_moves_with_the_block_feels_nothing(guess, cell, sliding):
    """Neither a block that has only been pressed nor one that has slid."""
    gdim = dimension(cell)
    for first in (0.0, 0.1):
        scene, point = on_moving_plane(cell, sliding)
        along(scene, first)
        force, t = scene.contact.force.copy(), parts(scene.contact)[1]
        u = scene.u.x.array.copy()
        if guess:
            scene.u.x.array.reshape(-1, gdim)[:, 0] += 0.37
        point.value[0] += 0.37
        along(scene, first + 0.37)
        assert scene.contact.force == pytest.approx(force, rel=1e-9, abs=1e-12)
        assert parts(scene.contact)[1] == pytest.approx(t, abs=1e-9 * np.abs(t).max())
        assert np.abs(scene.contact.discrete.history.slip).max() < 1e-9
        moved = (scene.u.x.array - u).reshape(-1, gdim) - np.eye(gdim)[0] * 0.37
        assert np.abs(moved).max() < 1e-9
        print(scene.iterations)


def test_a_foot_that_opens_only_where_its_slip_turns_back():
    """With strong friction sticking presses the foot down, and so does slip on the way there."""
    plane = cx.Plane((0.0, 0.0), (0.0, 1.0))
    scene = DrivenBlock(CellType.triangle, plane=plane, friction=2.0, sliding="small", n_upper=2)
    for top in [(0, -0.03), (-0.0138, -0.01986), (0.05158, -0.005)]:
        scene.step(*top)
    scene.step(0.10671, 0.02)
    assert scene.iterations[-1] <= 12
    assert scene.count == {"open": 3, "stick": 0, "slip": 0}


@pytest.mark.parametrize("gap", [0.0, 0.01])
def test_a_foot_that_slip_pulls_off_and_stick_holds(gap):
    ball = cx.Sphere((0.5, -3.0), 3.0)
    scene = DrivenBlock(
        CellType.triangle, plane=ball, friction=2.0, sliding="small", n_upper=2, gap=gap
    )
    for top in [(0, -0.03), (0.14877, -0.02271)]:
        scene.step(*top)
    scene.step(0.01504, -0.02146)
    assert scene.iterations[-1] <= 35
