# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave surfaces that face away from their master."""

import pytest

import contactx as cx
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import CELLS, Blocks

every_cell = pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)


def contact(scene, slave, master, **options):
    surfaces = cx.Surface(scene.tags, slave), cx.Surface(scene.tags, master)
    return cx.Contact(*surfaces, **options)


@pytest.mark.parametrize(
    ("cell", "sliding"),
    [*zip(CELLS, ["finite", "small", "small", "finite"], strict=True)],
    ids=str,
)
def test_facing_away_is_refused(cell, sliding):
    scene = Blocks(cell)
    good = scene.contact()
    side = contact(scene, Tag.UPPER_X1, Tag.LOWER_X1, sliding=sliding)
    with pytest.raises(
        ValueError,
        match=r"slave surface Surface\(tags=\(15,\).* faces away from its master .*\(25,\).* "
        r"although the nearest is 0\.27 away",
    ):
        scene.problem(good, side)
    # Both are free for another problem
    with pytest.raises(RuntimeError, match="has no results yet"):
        _ = good.pressure
    scene.problem(good)


@every_cell
def test_the_far_side_of_a_body_is_refused(cell):
    """The top of the upper block looks away from the lower one."""
    scene = Blocks(cell)
    with pytest.raises(ValueError, match="faces away"):
        scene.problem(contact(scene, Tag.UPPER_TOP, Tag.LOWER_CONTACT))


def test_facing_away_out_of_reach_is_legal_and_warns():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(contact(scene, Tag.UPPER_X1, Tag.LOWER_X1, search_distance=0.2))
    with pytest.warns(UserWarning, match=r"within reach of its master; the nearest is 0\.27 away"):
        problem.solve()


def test_only_facets_within_reach_count():
    """What opposes a slave node is farther off than the search distance; what is near does not."""
    scene = Blocks(CellType.hexahedron)
    master = cx.Surface(scene.tags, Tag.LOWER_X0, Tag.LOWER_X1)
    # The slave's normal is that of x = 1.5, opposite to x = 0; it is at x = 1.23
    side = cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), master, search_distance=1.2)
    with pytest.raises(ValueError, match="faces away"):
        scene.problem(side)
    scene.problem(cx.Contact(side.slave, master, search_distance=1.24))


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
