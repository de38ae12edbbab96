# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Large rotations: ties turn with their facets, and friction does not see a turn."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from scenes import CELLS, dimension
from scenes.covering import METHODS, covering
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean
from scenes.tower import Tower, lift

pytestmark = pytest.mark.usefixtures("method")


every_gap = covering(cell=CELLS, gap=(0.0, 0.1, -0.05), method=METHODS)


def rotation(gdim, degrees):
    """About an axis that is none of the mesh's."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    if gdim == 2:
        return np.array([[c, -s], [s, c]])
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    K = np.cross(np.eye(3), axis)
    return np.eye(3) + s * K + (1 - c) * K @ K


def turned(gdim, degrees):
    Q = rotation(gdim, degrees)
    return lambda x: x @ Q.T + np.linspace(0.2, -0.1, gdim)


@every_gap
def test_rotation_of_both_ends_leaves_no_traction(cell, gap):
    tower = Tower(cell, 2, 3, tied=True, nu=0.3, gap=gap, neo=True)
    for degrees in (15, 30):
        motion = turned(tower.gdim, degrees)
        tower.move(motion)
    assert np.abs(tower.moved - motion(tower.X)).max() <= 1e-10
    assert np.abs(tower.contact.multiplier).max() <= 1e-10
    assert tower.contact.discrete.nodes.gap == pytest.approx(gap, abs=1e-10)
    assert np.all(tower.contact.discrete.nodes.status == 1)


@every_gap
def test_turned_tension_is_tension_that_has_turned(cell, gap):
    """First pulled, then turned: the same traction in the turned axes, and quadratic."""
    tower = Tower(cell, 2, 3, tied=True, nu=0.3, gap=gap, neo=True)
    gdim = tower.gdim
    pull = lift(gdim, 0.1, 0.05)

    def pulled(x):
        return x + np.where(x[:, -1:] > 0, pull, 0)

    tower.move(pulled)
    force, traction = tower.contact.force.copy(), tower.contact.multiplier.copy()
    assert force[-1] < -0.01
    for degrees in (15, 30):
        Q = rotation(gdim, degrees)
        tower.move(lambda x, Q=Q: pulled(x) @ Q.T)
    assert tower.contact.force == pytest.approx(Q @ force, abs=1e-10)
    assert np.abs(tower.contact.multiplier - traction @ Q.T).max() <= 1e-9
    assert tower.problem.report.iterations <= 7
    assert np.abs(tower.problem.report.imbalance).max() <= 1e-13


@every_gap
def test_a_plane_that_turns_takes_its_body_along(cell, gap):
    gdim = dimension(cell)
    domain = mesh.create_unit_interval(MPI.COMM_SELF, 1)
    start = np.full(gdim, 0.3)
    start[-1] = 0.0
    point, normal = fem.Constant(domain, start), fem.Constant(domain, lift(gdim, 1))
    tower = Tower(
        cell,
        2,
        2,
        master=cx.Plane(point, normal),
        tied=True,
        nu=0.3,
        gap=gap,
        neo=True,
        free_top=True,
    )
    shift = np.linspace(0.2, -0.1, gdim)
    for degrees in (15, 30):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        Q = np.eye(gdim)
        Q[np.ix_([0, -1], [0, -1])] = [[c, s], [-s, c]]
        point.value[:] = start + shift
        normal.value[:] = Q @ lift(gdim, 1)
        tower.problem.solve()
        expected = start + shift + (tower.X[tower.upper] - start) @ Q.T
        assert np.abs(tower.moved[tower.upper] - expected).max() <= 1e-9
        assert np.abs(tower.contact.multiplier).max() <= 1e-9
        assert tower.problem.report.iterations <= 9


CENTRE = np.array([1.1, 0.4, -0.7])
CASES = [
    (CellType.triangle, None, 0.3),
    (CellType.quadrilateral, None, 0.3),
    (CellType.quadrilateral, None, 1.5),
    (CellType.tetrahedron, (0, 0, 1), 0.3),
    (CellType.tetrahedron, (0, 1, 0), 0.3),
    (CellType.hexahedron, (0, 0, 1), 0.3),
    (CellType.hexahedron, (0, 1, 0), 0.3),
    (CellType.hexahedron, (1, 0, 0), 0.3),
    (CellType.hexahedron, (2, -1, 3), 1.5),
]


def turn_by(axis, degrees=60.0):
    """Rotation about an axis in 3D, in the plane where there is none."""
    angle = np.radians(degrees)
    if axis is None:
        return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    n = np.array(axis) / np.linalg.norm(axis)
    K = np.cross(np.eye(3), n)
    return np.eye(3) - np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


class Turned:
    """A neo-Hookean block that slides along a neo-Hookean base; the frame turns in each step."""

    def __init__(self, cell, friction):
        self.scene = DrivenBlock(
            cell,
            material=neo_hookean,
            friction=friction,
            n_upper=2,
            n_lower=3,
            width=2.0,
            shift=0.43,
        )
        self.gdim = self.scene.gdim
        V = self.scene.u.function_space
        self.X = V.tabulate_dof_coordinates()[:, : self.gdim]
        self.Q = np.eye(self.gdim)

    def step(self, way, Q):
        """Turn to Q, and move the top along the base; the start turns with it."""
        scene, centre = self.scene, CENTRE[: self.gdim]
        u = scene.u.x.array.reshape(-1, self.gdim)
        turned = Q @ self.Q.T
        u[:] = (self.X + u - centre) @ turned.T + centre - self.X
        self.Q = Q
        scene.top.move((scene.top.x + way - centre) @ Q.T + centre - scene.top.x)
        x = scene.bottom.x
        scene.bottom.move((x - centre) @ Q.T + centre - x)
        scene.solve()

    def answer(self):
        """Traction, slip and deformed shape in the frame of the base."""
        scene, centre = self.scene, CENTRE[: self.gdim]
        x = (self.X + scene.u.x.array.reshape(-1, self.gdim) - centre) @ self.Q
        slip = scene.contact.discrete.history.slip
        return scene.contact.multiplier @ self.Q, slip @ self.Q, x


@pytest.mark.parametrize(
    ("cell", "axis", "friction", "method"),
    [(*case, METHODS[i % 2]) for i, case in enumerate(CASES)],
    indirect=["method"],
)
def test_turning_base(cell, axis, friction):
    gdim = 2 if axis is None else 3
    ways = np.zeros((4, gdim))
    ways[:, -1] = -0.05
    ways[1:, 0] = (0.02, 0.2, 0.15)
    if gdim == 3:
        ways[2:, 1] = (0.05, 0.1)
    rest, turning = Turned(cell, friction), Turned(cell, friction)
    off = []
    for k, way in enumerate(ways):
        rest.step(way, np.eye(gdim))
        turning.step(way, np.linalg.matrix_power(turn_by(axis), k))
        (t, *shape), (t_rest, *shape_rest) = turning.answer(), rest.answer()
        off.append(np.abs(t - t_rest).max() / np.abs(t_rest).max())
        # Slip and positions are relative to the block's size
        off += [np.abs(a - b).max() for a, b in zip(shape, shape_rest, strict=True)]
        np.testing.assert_array_equal(
            turning.scene.contact.status.x.array, rest.scene.contact.status.x.array
        )
    print(rest.scene.iterations, turning.scene.iterations, f"off by {max(off):.1e}")
    assert max(off) <= 1e-8
