# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The judge of the stress map finds what is wrong in a state, and nothing in a solution."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from stress import inside
from stress.blocks import Blocks
from stress.judge import Judge

CELLS = [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]


@pytest.fixture(params=CELLS, ids=lambda cell: cell.name)
def solved(request):
    blocks = Blocks(cell=request.param, friction=0.3, side=0.1)
    case = blocks.case()
    judge = Judge(case)
    case.update(1.0)
    case.problem.solve()
    assert judge() == []
    return blocks, judge


def violated(judge):
    return {check.name for check in judge()}


def closed_nodes(contact):
    return np.flatnonzero(contact.interface.nodes.closed)


def test_forces_that_do_not_balance(solved):
    blocks, judge = solved
    multiplier = blocks.contact.interface.nodes.multiplier
    multiplier *= 1 + 1e-6
    assert "balance of nodes" in violated(judge)


def test_a_displacement_that_is_a_little_off(solved):
    blocks, judge = solved
    nodes = blocks.contact.slave_nodes
    dim = blocks.x0.shape[1]
    blocks.u.x.array.reshape(-1, dim)[nodes, -1] += 1e-7
    assert "balance of nodes" in violated(judge)


@pytest.mark.parametrize("part, right", [(1e-10, True), (1e-6, False)])
def test_forces_that_are_left_of_those_before(solved, part, right):
    """Without any load none are left, and nothing else is there to compare them with."""
    blocks, judge = solved
    blocks.contact.interface.nodes.multiplier[:] = 0
    blocks.u.x.array[:] *= part
    assert ("balance of nodes" not in violated(judge)) == right
    # In the next step they would be a load that nothing bears
    assert "balance of nodes" in violated(judge)


def test_tension_and_friction_beyond_the_cone(solved):
    blocks, judge = solved
    nodes = blocks.contact.interface.nodes
    traction = nodes.multiplier.reshape(nodes.normal.shape)
    k = closed_nodes(blocks.contact)[0]
    before = traction[k].copy()
    traction[k] = -before
    assert "pressure is not negative" in violated(judge)
    traction[k] = before + 0.5 * nodes.pressure[k] * np.eye(len(before))[0]
    assert "friction is at most mu p" in violated(judge)


def test_slip_of_what_sticks_or_with_its_friction(solved):
    blocks, judge = solved
    nodes, history = blocks.contact.interface.nodes, blocks.contact.interface.history
    slip, slipping = history.slip, np.flatnonzero(nodes.status == 2)
    others = history.total, history.dissipation
    slip[slipping] *= -1
    history.restore(slip, *others)
    assert "slip is against friction" in violated(judge)
    slip[slipping] *= -1
    history.restore(slip, *others)
    nodes.status[slipping[np.linalg.norm(slip[slipping], axis=1).argmax()]] = 1
    assert "sticking nodes do not slip" in violated(judge)


def test_gaps_of_closed_nodes_and_forces_of_open_ones(solved):
    blocks, judge = solved
    nodes = blocks.contact.interface.nodes
    k = closed_nodes(blocks.contact)[0]
    nodes.gap[k] = 1e-8
    assert "closed nodes have no gap" in violated(judge)
    nodes.status[k], nodes.gap[k] = 0, -1e-8
    assert violated(judge) >= {"open nodes carry nothing", "open nodes do not penetrate"}


def test_a_body_inside_the_other_one(solved):
    blocks, judge = solved
    dim = blocks.x0.shape[1]
    V = blocks.u.function_space
    upper = V.tabulate_dof_coordinates()[:, dim - 1] >= 0
    upper &= ~np.isin(np.arange(len(upper)), judge._master_nodes(blocks.contact))
    blocks.u.x.array.reshape(-1, dim)[upper, dim - 1] -= 0.1
    assert "no node is inside the other body" in violated(judge)


@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_depth(cell):
    dim = 2 if cell in CELLS[:2] else 3
    data = meshes.blocks(cell, (2,) * dim, (3,) * dim, size_lower=(2.0,) * dim, gap=0.1)
    parts = inside.boundary(data.mesh, data.facet_tags, Tag.LOWER_CONTACT)
    x = data.mesh.geometry.x[:, :dim]
    rng = np.random.default_rng(0)
    points = rng.uniform(-2.5, 2.5, (400, dim))
    # The lower block: from 0 to 2 along the surface, from -2 to 0 in height
    low, high = np.zeros(dim), np.full(dim, 2.0)
    low[-1], high[-1] = -2.0, 0.0
    exact = np.minimum(points - low, high - points).min(axis=1).clip(min=0)
    assert (exact > 0).sum() > 10
    np.testing.assert_allclose(inside.depth(points, x, parts), exact, atol=1e-12)
