# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Deformable bodies on rigid obstacles."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import Blocks, hertz_sphere
from scenes.problems import make_problem
from story import displacement, elasticity, fix

pytestmark = pytest.mark.usefixtures("method")


def pressed_sphere(master, sliding="finite", h=0.04):
    """The common Hertz problem's sphere on a rigid obstacle; the block takes no part."""
    data = meshes.hertz_sphere(h)
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
        fix(u, tags, 2, -0.02, Tag.UPPER_TOP),
    ]
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), master, sliding=sliding)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], bcs)
    problem.solve()
    return problem, contact


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_plane_equals_a_very_stiff_master(sliding, method):
    problem, contact = pressed_sphere(cx.Plane((0, 0, 0), (0, 0, 1)), sliding)
    other, stiff = hertz_sphere(0.04, sliding, young={Tag.LOWER: 1e9})
    other.solve()
    p_off, off = 1e-4, 1e-4
    if method == "surface-to-surface":
        # On a surface normals are the slave's, in small sliding midway to the master's: off by
        # half the slope at the contact's edge
        p_off, off = (2e-3, 3e-3) if sliding == "finite" else (0.04, 0.03)
    largest = stiff.multiplier.max()
    assert contact.multiplier == pytest.approx(stiff.multiplier, abs=p_off * largest)
    assert contact.force == pytest.approx(stiff.force, rel=off, abs=off * stiff.force[2])
    assert problem.report.iterations <= 10
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-12


class Indented:
    """A block pressed on an obstacle of radius 2 about the y-axis or about a point."""

    def __init__(self, obstacle, sliding="finite", down=0.05):
        data = meshes.blocks(CellType.hexahedron, (6, 6, 4), (1, 1, 1), shift=(-0.5, -0.4))
        self.tags, self.u = data.facet_tags, displacement(data.mesh)
        bcs = [
            *(
                fix(self.u, self.tags, i, 0.0, Tag.LOWER_BOTTOM, Tag.UPPER_TOP, Tag.LOWER_CONTACT)
                for i in range(2)
            ),
            fix(self.u, self.tags, 2, 0.0, Tag.LOWER_BOTTOM),
            fix(self.u, self.tags, 2, -down, Tag.UPPER_TOP),
        ]
        self.contact = cx.Contact(
            cx.Surface(self.tags, Tag.UPPER_CONTACT), obstacle, sliding=sliding
        )
        self.problem = make_problem(elasticity(self.u, 1.0, 0.3), self.u, [self.contact], bcs)

    def solve(self):
        self.problem.solve()
        return self.u.x.array.copy()


def ball(x):
    return x[0] ** 2 + x[1] ** 2 + (x[2] + 2) ** 2 - 4


def ball_gradient(x):
    return 2 * np.stack([x[0], x[1], x[2] + 2])


def rod(x):
    return ufl.sqrt(x[0] ** 2 + (x[2] + 2) ** 2) - 2


@pytest.mark.parametrize(
    ("obstacle", "others"),
    [
        (
            cx.Sphere((0, 0, -2), 2.0),
            [cx.LevelSet(ball), cx.LevelSet(ball, ball_gradient)],
        ),
        (
            cx.Cylinder((0, 5, -2), (0, -3, 0), 2.0),
            [cx.LevelSet(rod), cx.LevelSet(lambda x: rod(x) * (1 + x[1] ** 2))],
        ),
    ],
    ids=["sphere", "cylinder"],
)
def test_shapes_agree_with_their_level_sets(obstacle, others, method):
    scene = Indented(obstacle)
    u = scene.solve()
    assert (scene.contact.multiplier > 0).sum() > 5
    assert scene.problem.report.iterations <= 10
    for other in others:
        twin = Indented(other)
        # Beside a node the function over its gradient is the distance to second order only
        exact = method == "node-to-surface"
        assert np.abs(twin.solve() - u).max() <= (1e-10 if exact else 1e-3) * np.abs(u).max()
        p = scene.contact.multiplier
        assert twin.contact.multiplier == pytest.approx(
            p, rel=1e-8, abs=0 if exact else 2e-3 * p.max()
        )


def test_a_node_that_is_constrained_inside_an_obstacle():
    scene = Blocks(CellType.tetrahedron, down=0.05)
    contact = cx.Contact(
        cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0, Tag.UPPER_TOP),
        cx.Plane((0, 0, 0.5), (0, 0, -1)),
    )
    problem = scene.problem(contact)
    mesh = scene.u.function_space.mesh.geometry
    first = mesh.input_global_indices[np.isclose(mesh.x[:, 2], 1)].min()
    (at,) = mesh.x[mesh.input_global_indices == first]
    place = ", ".join(f"{value:.6g}" for value in at)
    with pytest.raises(
        ValueError,
        match=r"over-constrained: Dirichlet conditions constrain 9 slave nodes .*"
        rf"first node {first} of the mesh as it was made, at \({place}\)",
    ):
        problem.solve()
    assert not scene.u.x.array.any()


def test_symmetry_planes_and_fixed_nodes_outside_an_obstacle_just_work():
    problem, contact = pressed_sphere(cx.Plane((0, 0, 0), (0, 0, 1)))
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    pole = np.argmin(np.linalg.norm(x, axis=1))
    assert contact.multiplier[pole] > 0
    scene = Blocks(CellType.tetrahedron, down=0.05)
    whole = cx.Contact(
        cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0, Tag.UPPER_TOP),
        cx.Plane((0, 0, 0), (0, 0, 1)),
    )
    scene.problem(whole).solve()
    assert whole.force[2] > 0
