# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes that belong to several contacts, and faces of a crack, which share the nodes of its tip."""

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag, block_tag
from scenes import NU, Blocks
from scenes.covering import METHODS, SLIDINGS, covering
from scenes.cracked import BOTTOM, TOP, Cracked
from scenes.problems import make_problem
from story import displacement, elasticity, fix, traction

pytestmark = pytest.mark.usefixtures("method")


CELLS = [CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]
LOAD = 0.01


class Corner:
    """A block without supports is pressed into the corner of a rigid floor and a rigid wall."""

    def __init__(self, cell, *, friction, twice=False):
        scene = Blocks(cell)
        u, tags = scene.u, scene.tags
        self.gdim = gdim = u.function_space.mesh.geometry.dim
        up, aside = np.eye(gdim)[-1], np.eye(gdim)[0]
        left = 0.23 * aside
        down, push = (fem.Constant(u.function_space.mesh, -LOAD * d) for d in (up, aside))
        F = scene.F + traction(u, tags, Tag.UPPER_TOP, down)
        F += traction(u, tags, Tag.UPPER_X1, push)
        foot, side = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.UPPER_X0)
        floor = cx.Contact(foot, cx.Plane(0 * up, up), friction=friction)
        wall = cx.Contact(side, cx.Plane(left, aside), friction=friction)
        again = [cx.Contact(foot, cx.Plane(0 * up, up), friction=friction)] if twice else []
        self.contacts = [floor, wall, *again]
        self.problem = make_problem(F, u, self.contacts, scene.bcs[:gdim])
        self.edge = 1 if gdim == 2 else 3

    def total(self):
        return np.sum([contact.force for contact in self.contacts], axis=0)


@covering(cell=CELLS, friction=(0.0, 0.3), twice=(False, True), method=METHODS)
def test_a_block_in_a_corner(cell, friction, twice):
    scene = Corner(cell, friction=friction, twice=twice)
    scene.problem.solve()
    report = scene.problem.report
    assert report.iterations <= 8
    assert report.corners == scene.edge
    assert f"{scene.edge} nodes close several contacts" in str(report)
    expected = np.zeros(scene.gdim)
    expected[0] = expected[-1] = LOAD
    assert np.abs(scene.total() - expected).max() <= 1e-9 * LOAD
    for contact in scene.contacts:
        assert np.nanmin(contact.discrete.nodes.gap) >= -1e-12
    if twice:
        # Of two contacts with the same floor only one carries
        first, _, second = scene.contacts
        assert not (first.multiplier.any() and second.multiplier.any())


def stack(cell):
    """Facet tags, displacement and supports of three blocks, pressed together."""
    gdim = 2 if cell == CellType.quadrilateral else 3
    data = meshes.stack(cell, [(2,) * gdim, (3,) * gdim, (4,) * gdim])
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        *(fix(u, tags, i, 0.0, block_tag(0, "bottom")) for i in range(gdim)),
        *(fix(u, tags, i, 0.0, block_tag(2, "top")) for i in range(gdim - 1)),
        fix(u, tags, gdim - 1, -0.05, block_tag(2, "top")),
    ]
    return tags, u, bcs


@covering(
    cell=(CellType.quadrilateral, CellType.hexahedron),
    friction=(0.0, 0.3),
    sliding=SLIDINGS,
    method=METHODS,
)
def test_a_node_that_is_slave_here_and_master_there_is_condensed(cell, friction, sliding):
    """The middle block's side is pushed on a wall; its edges press on the other blocks, too."""
    answers = []
    for solver in ("lu", "condensed"):
        tags, u, bcs = stack(cell)
        axis = np.eye(len(u))[0]
        bcs.append(fix(u, tags, 0, -0.02, block_tag(1, "x1")))
        top, bottom, side = (cx.Surface(tags, block_tag(1, s)) for s in ("top", "bottom", "x0"))
        pairs = [
            (cx.Surface(tags, block_tag(0, "top")), bottom),
            (cx.Surface(tags, block_tag(2, "bottom")), top),
            (side, cx.Plane(0 * axis, axis)),
        ]
        contacts = [cx.Contact(*pair, friction=friction, sliding=sliding) for pair in pairs]
        problem = make_problem(
            elasticity(u, 1.0, NU), u, contacts, bcs, petsc_options={"pc_type": solver}
        )
        problem.solve()
        assert contacts[2].force[0] > 1e-3
        assert problem.report.uncondensed == []
        answers.append((u.x.array, *(contact.multiplier for contact in contacts)))
    for found, exact in zip(*answers[::-1], strict=True):
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-8 * np.abs(exact).max())


@covering(slope=(0.005, 0.03, 0.045, 0.06, 0.2), friction=(0.0, 0.3), method=METHODS)
def test_a_valley_of_two_planes_however_shallow(friction, slope):
    """The node at its bottom may need both, although their normals are nearly the same."""
    data = meshes.blocks(CellType.quadrilateral, (3, 3), (1, 1))
    domain, tags = meshes.single(data, Tag.UPPER)
    u = displacement(domain)
    contacts = [
        cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Plane((1 / 3, 0), (np.sin(angle), np.cos(angle))),
            friction=friction,
        )
        for angle in (slope, -slope)
    ]
    down = fix(u, tags, 1, 0.0, Tag.UPPER_TOP)
    problem = make_problem(
        elasticity(u, 1.0, NU), u, contacts, [fix(u, tags, 0, 0.0, Tag.UPPER_TOP), down]
    )
    for depth in (0.03, 0.06, 0.09):
        down.g.value[...] = -depth
        problem.solve()
        for contact in contacts:
            assert np.nanmin(contact.discrete.nodes.gap) >= -1e-12
            assert (contact.discrete.nodes.pressure >= -1e-12).all()


def uncracked(gdim):
    """The same block without the crack, solved without contact."""
    body = Cracked(gdim, crack=False)
    u = body.u
    V = u.function_space
    F = elasticity(u, 1.0, 0.3)
    J = ufl.derivative(F, u)
    moved = np.zeros(gdim)
    moved[-1] = -0.01
    bcs = []
    for tag, value in ((BOTTOM, np.zeros(gdim)), (TOP, moved)):
        dofs = fem.locate_dofs_topological(V, gdim - 1, body.tags.find(tag))
        bcs.append(fem.dirichletbc(value, dofs, V))
    b = fem.assemble_vector(fem.form(-F))
    K = fem.assemble_matrix(fem.form(J), bcs).to_dense()
    fem.apply_lifting(b.array, [fem.form(J)], [bcs])
    for bc in bcs:
        bc.set(b.array)
    u.x.array[:] = np.linalg.solve(K, b.array)
    return {tuple(row[:gdim]): row[gdim:] for row in body.at_nodes()}


CRACK_OPTIONS = [
    {},
    {"friction": 0.3},
    {"tied": True},
    {"sliding": "small"},
]


@pytest.mark.parametrize("gdim", [2, 3])
def test_a_crack_under_compression_is_as_if_it_were_not(gdim):
    expected = uncracked(gdim)
    for options in CRACK_OPTIONS:
        body = Cracked(gdim)
        contact = body.contact(**options)
        problem = body.problem([contact])
        problem.solve()
        rows = body.at_nodes()
        off = [np.abs(row[gdim:] - expected[tuple(row[:gdim])]).max() for row in rows]
        assert max(off) <= 1e-12, options
        # The tip is never closed: it has no gap
        tip = np.isclose(np.abs(rows_of(contact)[:, :-1] - 0.5).max(axis=1), 0.25)
        status = contact.discrete.nodes.status
        assert (status[tip] == 0).all()
        assert (status[~tip] > 0).all()
        assert np.isnan(contact.discrete.nodes.gap[tip]).all()


def rows_of(contact):
    """Positions of the slave nodes, shape (n, gdim)."""
    return contact.discrete.halo.x[contact.slave_nodes]


def test_both_solvers():
    forces = []
    for pc in ("lu", "condensed"):
        body = Cracked(2)
        contact = body.contact()
        body.problem([contact], petsc_options={"pc_type": pc}).solve()
        forces.append(contact.force)
    assert forces[1] == pytest.approx(forces[0], rel=1e-9, abs=1e-12)
    assert forces[0][1] > 0
