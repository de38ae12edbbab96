# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Obstacles that spin drag what touches them."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh

import story
from scenes.problems import make_problem

RADIUS, DEEP, YOUNG = 5.0, 0.05, 10.0


class OnRoll:
    """A block above a large roll, held at its top and pressed down.

    Attributes:
        u: Displacement.
        contact: The block's lower face on the roll.
        problem: The problem.
        angle: How far the roll has spun.
    """

    def __init__(self, dim, method, **options):
        corners = [[-0.5] * (dim - 1) + [0], [0.5] * (dim - 1) + [1]]
        if dim == 2:
            domain = mesh.create_rectangle(MPI.COMM_WORLD, corners, [6, 6])
        else:
            domain = mesh.create_box(MPI.COMM_WORLD, corners, [4, 4, 4])
        self.u = story.displacement(domain)
        V = self.u.function_space
        bottom, top = (
            mesh.locate_entities_boundary(domain, dim - 1, lambda x, z=z: np.isclose(x[dim - 1], z))
            for z in (0, 1)
        )
        tags = mesh.meshtags(domain, dim - 1, bottom, np.ones(len(bottom), dtype=np.int32))
        down = np.zeros(dim)
        down[-1] = -DEEP
        bcs = [fem.dirichletbc(down, fem.locate_dofs_topological(V, dim - 1, top), V)]
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


def test_a_tied_block_turns_with_the_roll():
    scene = OnRoll(2, story.METHODS[0], tied=True)
    scene.spin(0.0)
    x = scene.contact.discrete.positions()[scene.contact.slave_nodes].copy()
    scene.spin(0.01)
    now = scene.contact.discrete.positions()[scene.contact.slave_nodes]
    c, s = np.cos(0.01), np.sin(0.01)
    centre = np.array([0, -RADIUS])
    np.testing.assert_allclose(now, centre + (x - centre) @ np.array([[c, s], [-s, c]]), atol=1e-9)


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
