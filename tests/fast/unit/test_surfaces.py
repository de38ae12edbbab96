# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces: tags, and those beyond an edge or inside."""

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import CELLS, Blocks, dimension
from scenes.problems import make_problem
from story import displacement, elasticity

every_cell = pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)


@every_cell
def test_beyond_the_outer_edge_is_legal_and_slides_on(cell):
    scene = Blocks(cell, gap=0.1, down=0.0)
    domain = scene.u.function_space.mesh
    gdim = domain.geometry.dim
    x = domain.geometry.x
    x[x[:, gdim - 1] > 0.05, 0] += 1.6
    touching = scene.contact()
    problem = scene.problem(touching)
    with pytest.warns(
        UserWarning, match=r"contact 0 .* no slave node that faces its master, although"
    ):
        problem.solve()
    assert problem.report.pairs == 0
    scene.bcs[gdim].g.value[...] = -1.6
    problem.solve()
    assert problem.report.pairs > 0
    assert not touching.force.any()
    scene.bcs[-1].g.value[...] = -0.12
    problem.solve()
    assert touching.force[gdim - 1] > 0


def small_in_large(cell, gap):
    """A block of size 0.4 whose bottom is at the height gap, in a large block below zero."""
    dim = dimension(cell)
    return meshes.blocks(
        cell,
        (3,) * dim,
        (4,) * dim,
        size_upper=(0.4,) * dim,
        size_lower=(1.5,) * (dim - 1) + (1.0,),
        shift=(0.53,) * (dim - 1),
        gap=gap,
    )


def problem_of(data, slave=Tag.UPPER_CONTACT, master=Tag.LOWER_CONTACT, others=()):
    u = displacement(data.mesh)
    contact = cx.Contact(cx.Surface(data.facet_tags, slave), cx.Surface(data.facet_tags, master))
    F = elasticity(u, 1.0, 0.3)
    return make_problem(F, u, [*others, contact])


@every_cell
def test_slave_body_inside(cell):
    n = 4 ** dimension(cell)
    with pytest.raises(
        ValueError,
        match=rf"body of the slave surface Surface\(tags=\(11,\).* lies wholly inside the body of "
        rf"the master surface Surface\(tags=\(21,\).* all its {n} nodes",
    ):
        problem_of(small_in_large(cell, -0.7))


@every_cell
def test_master_body_inside(cell):
    with pytest.raises(ValueError, match=r"body of the master surface .*\(11,\).* wholly inside"):
        problem_of(small_in_large(cell, -0.7), Tag.LOWER_CONTACT, Tag.UPPER_CONTACT)


class Slave:
    """A block of size 1 on the height zero whose bottom is the slave surface."""

    def __init__(self):
        self.scene = Blocks(CellType.hexahedron)

    def on(self, obstacle):
        contact = cx.Contact(cx.Surface(self.scene.tags, Tag.UPPER_CONTACT), obstacle)
        self.scene.problem(contact)


CENTRE = (0.73, 0.73, 0.5)  # where the block has a node


# Other hints: tests/fast/input/test_obstacles.py
@pytest.mark.parametrize(
    ("obstacle", "hint"),
    [
        (cx.Sphere((0, 0, -4), 2.0, hollow=True), "Sphere. Perhaps hollow is the wrong way"),
        (cx.Cylinder(CENTRE, (0, 1, 0), 2.0), "Cylinder. Perhaps hollow is the wrong way"),
        (
            cx.Cylinder((0, 0, -4), (0, 1, 0), 2.0, hollow=True),
            "Cylinder. Perhaps hollow is the wrong way",
        ),
        (
            cx.LevelSet(lambda x: -x[2], lambda x: np.stack([0 * x[0], 0 * x[0], -1 + 0 * x[0]])),
            "LevelSet. Perhaps the sign of its function is wrong",
        ),
    ],
)
def test_inside_an_obstacle(obstacle, hint):
    with pytest.raises(ValueError, match=rf"all its 27 nodes are inside the {hint}"):
        Slave().on(obstacle)


def test_deep_in_an_obstacle_is_legal():
    obstacle = cx.LevelSet(lambda x: x[2] - 0.99)
    Slave().on(obstacle)
    # What a function's differences are scaled with
    assert obstacle.extent == pytest.approx(1)


@pytest.fixture(scope="module")
def scene():
    return Blocks(CellType.tetrahedron)


def test_several_tags_as_arguments_or_as_a_list(scene):
    one = cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0)
    other = cx.Surface(scene.tags, [Tag.UPPER_X0, Tag.UPPER_CONTACT])
    assert np.array_equal(one.facets, other.facets)
    assert len(one.facets) == 2 * len(scene.tags.find(Tag.UPPER_CONTACT))
    assert repr(one) == f"Surface(tags=(11, 13), {len(one.facets)} facets)"
