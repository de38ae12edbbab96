# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ridges and apexes of level sets, pressed straight into blocks."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.problems import make_problem
from story import displacement, elasticity

METHODS = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])


def pressed(shape, gdim, n, cells, method):
    """Force on a block from a body of which the top is lower than its apex by a shape.

    Args:
        shape: Of the position along the surface; zero at the apex, which is below a node.
        gdim: Dimension of space.
        n: Cells along the block.
        cells: Their type.
        method: Method of the contact.
    """
    corners = [[-0.5] * (gdim - 1) + [0], [0.5] * (gdim - 1) + [0.6]]
    make = mesh.create_box if gdim == 3 else mesh.create_rectangle
    domain = make(MPI.COMM_WORLD, corners, [n] * (gdim - 1) + [n // 2], cells)
    u = displacement(domain)
    bottom, top = (
        mesh.locate_entities_boundary(
            domain, gdim - 1, lambda x, at=at: np.isclose(x[gdim - 1], at)
        )
        for at in (0, 0.6)
    )
    tags = mesh.meshtags(domain, gdim - 1, bottom, np.ones(len(bottom), dtype=np.int32))
    V = u.function_space
    held = fem.locate_dofs_topological(V, gdim - 1, top)
    bc = fem.dirichletbc(np.zeros(gdim), held, V)
    tool = cx.LevelSet(lambda x: shape(x) + x[gdim - 1] - 0.02)
    contact = cx.Contact(cx.Surface(tags, 1), tool, method=method)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], [bc])
    problem.solve()
    return contact.force


def sideways(force):
    assert force[-1] > 0
    return np.abs(force[:-1]).max() / force[-1]


PYRAMIDS = [
    pytest.param(lambda x: 0.3 * ufl.max_value(abs(x[0]), abs(x[1])), id="beside its nodes"),
    pytest.param(lambda x: 0.2 * (abs(x[0]) + abs(x[1])), id="on its nodes"),
]


@METHODS
@pytest.mark.parametrize("shape", PYRAMIDS)
def test_a_pyramid_pushed_straight_down_feels_nothing_sideways(shape, method):
    """It felt 13 to 24 %: the apex had the normal of one of its faces."""
    force = pressed(shape, 3, 8, mesh.CellType.hexahedron, method)
    assert sideways(force) < 1e-10


@METHODS
@pytest.mark.parametrize("n", [8, 64])
def test_a_wedge_pushed_straight_down_feels_nothing_sideways(method, n):
    """Also where linear solves leave the node beside the ridge."""
    force = pressed(lambda x: 0.3 * abs(x[0]), 2, n, mesh.CellType.quadrilateral, method)
    assert sideways(force) < 1e-6


def test_cells_that_are_not_symmetric_make_little_of_it():
    """A node that leaves the ridge a little must not slide down one of its sides."""
    force = pressed(PYRAMIDS[0].values[0], 3, 8, mesh.CellType.tetrahedron, "node-to-surface")
    assert sideways(force) < 5e-3


def test_maximum_and_absolute_value_are_the_same():
    forces = [
        pressed(shape, 2, 16, mesh.CellType.quadrilateral, "node-to-surface")
        for shape in (lambda x: 0.3 * abs(x[0]), lambda x: 0.3 * ufl.max_value(x[0], -x[0]))
    ]
    assert forces[0] == pytest.approx(forces[1], rel=1e-12, abs=1e-14)
