# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The judge of the stress map finds what is wrong in a state, and nothing in a solution."""

import numpy as np
import pytest

from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.tip_on_arm import TipOnArm
from stress import inside
from stress.blocks import Blocks
from stress.directions import Directions
from stress.families import all_scenes
from stress.judge import Judge
from stress.outcome import Outcome, steps_of
from stress.scene import METHODS
from stress.work import Work

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
    return np.flatnonzero(contact.discrete.nodes.closed)


def test_forces_that_do_not_balance(solved):
    blocks, judge = solved
    multiplier = blocks.contact.discrete.nodes.multiplier
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
    blocks.contact.discrete.nodes.multiplier[:] = 0
    blocks.u.x.array[:] *= part
    assert ("balance of nodes" not in violated(judge)) == right
    # In the next step they would be a load that nothing bears
    assert "balance of nodes" in violated(judge)


def test_tension_and_friction_beyond_the_cone(solved):
    blocks, judge = solved
    nodes = blocks.contact.discrete.nodes
    traction = nodes.multiplier.reshape(nodes.normal.shape)
    k = closed_nodes(blocks.contact)[0]
    before = traction[k].copy()
    traction[k] = -before
    assert "pressure is not negative" in violated(judge)
    traction[k] = before + 0.5 * nodes.pressure[k] * np.eye(len(before))[0]
    assert "friction is at most mu p" in violated(judge)


def test_slip_of_what_sticks_or_with_its_friction(solved):
    blocks, judge = solved
    nodes, history = blocks.contact.discrete.nodes, blocks.contact.discrete.history
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
    nodes = blocks.contact.discrete.nodes
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


def forces(contact, V):
    """What pushes each node."""
    x = V.tabulate_dof_coordinates()[:, : V.dofmap.index_map_bs]
    pushed = np.zeros_like(x)
    contact.discrete.add_residual(pushed.ravel())
    return -pushed


def tilted(forces, angle):
    """Forces that are turned in the plane of the first and the last axis."""
    turned = forces.copy()
    turned[:, 0] = np.cos(angle) * forces[:, 0] - np.sin(angle) * forces[:, -1]
    turned[:, -1] = np.sin(angle) * forces[:, 0] + np.cos(angle) * forces[:, -1]
    return turned


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("cell", CELLS, ids=lambda cell: cell.name)
def test_forces_that_are_not_along_the_normal(cell, method):
    blocks = Blocks(cell=cell, method=method, young=(1.0, 1e9))
    case = blocks.case()
    judge = Judge(case)
    case.update(1.0)
    case.problem.solve()
    assert judge() == []
    V = blocks.u.function_space
    look, x = Directions(blocks.contact, V.mesh, judge._node_of), judge._positions()
    pushed = forces(blocks.contact, V)
    small = np.full(len(x), 1e-7 * np.abs(pushed).max())
    assert look(x, pushed, small) < 1
    # Facets of the soft body are not quite plane, and by surface-to-surface forces are along these
    for angle in (-0.1, 0.1):
        assert look(x, tilted(pushed, angle), small) > 1.2


@pytest.mark.parametrize("method", METHODS)
def test_forces_of_an_edge_that_are_not_along_the_normal_of_what_it_touches(method):
    scene = TipOnArm(method=method)
    scene.pushed(0.1, 1)
    V = scene.u.function_space
    node_of = np.empty(len(V.mesh.geometry.x), dtype=int)
    node_of[V.mesh.geometry.dofmaps[0]] = V.dofmap.list
    look = Directions(scene.contact, V.mesh, node_of)
    x = V.tabulate_dof_coordinates()[:, :2] + scene.u.x.array.reshape(-1, 2)
    pushed = forces(scene.contact, V)
    small = np.full(len(x), 1e-7 * np.abs(pushed).max())
    assert look(x, pushed, small) < 1
    for angle in (-np.pi / 4, -0.01, 0.01, np.pi / 4):
        assert look(x, tilted(pushed, angle), small) > 100


def test_a_force_on_an_edge_of_the_master_is_within_its_cone():
    """The node of the block's edge, as that of a slave that lies on it."""
    scene = TipOnArm(swapped=True)
    V = scene.u.function_space
    node_of = np.empty(len(V.mesh.geometry.x), dtype=int)
    node_of[V.mesh.geometry.dofmaps[0]] = V.dofmap.list
    look = Directions(scene.contact, V.mesh, node_of)
    x = V.tabulate_dof_coordinates()[:, :2].copy()
    edge = min(look._master.ravel(), key=lambda node: x[node, 1])
    node = look._slave[0, 0]
    x[node] = x[edge]
    small = np.full(len(x), 1e-9)
    for angle, right in ((0.0, True), (0.78, True), (-0.78, True), (0.8, False), (-0.8, False)):
        pushed = np.zeros_like(x)
        pushed[node] = np.sin(angle), -np.cos(angle)
        assert (look(x, pushed, small) < 1) == right


@pytest.mark.parametrize("method", METHODS)
def test_work_that_is_not_stored(method):
    """What friction takes is lost, whether it is small or not."""
    lost = []
    for friction in (0.0, 0.1):
        blocks = Blocks(
            method=method, friction=friction, n_lower=(5, 2), down=0.02, side=0.4, steps=20
        )
        case = blocks.case()
        work = Work(case, fem.form(case.F))
        checks = [work() for _ in steps_of(case, Outcome("", "", ""))]
        lost.append(checks[-1].error / checks[-1].allowed)
    assert lost[0] < 0.5
    assert lost[1] > 1


def test_energy_of_an_arch_that_snaps_is_lost():
    """It leaves its symmetric shape within one of few steps; a tenth of its work is not stored."""
    (scene,) = (
        scene
        for scene in all_scenes()
        if scene.family.startswith("arch under a disc")
        and (scene.value, scene.variant) == ("0.5", "0.8, arch is the slave, svk, s2s, 4, True")
    )
    case = scene.make()
    work = Work(case, fem.form(case.F))
    checks, given = [], []
    for _ in steps_of(case, Outcome("", "", "")):
        checks.append(work())
        given.append(work._given)
    assert all(check.holds for check in checks)
    # The last step snaps and is left out, the others are not
    assert np.all(np.diff(given)[:-1] > 0) and given[-1] == given[-2]


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
