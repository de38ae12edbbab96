# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Friction does not see a turn: a block slides on a base that turns by 60 degrees in the step."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from scenes.covering import METHODS
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean

pytestmark = pytest.mark.usefixtures("method")

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


def turn(axis, degrees=60.0):
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
        turning.step(way, np.linalg.matrix_power(turn(axis), k))
        (t, *shape), (t_rest, *shape_rest) = turning.answer(), rest.answer()
        off.append(np.abs(t - t_rest).max() / np.abs(t_rest).max())
        # Slip and positions are relative to the block's size
        off += [np.abs(a - b).max() for a, b in zip(shape, shape_rest, strict=True)]
        np.testing.assert_array_equal(
            turning.scene.contact.status.x.array, rest.scene.contact.status.x.array
        )
    print(rest.scene.iterations, turning.scene.iterations, f"off by {max(off):.1e}")
    assert max(off) <= 1e-8
