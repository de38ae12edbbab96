# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes and surfaces that are no good, and some that only look so."""

from mpi4py import MPI

import numpy as np
import pytest

import basix.ufl
import contactx as cx
from dolfinx import fem, mesh

from inputs.rows import refused, scene, solved, table
from scenes.problems import make_problem
from story import displacement, elasticity

# A base, of which the contact takes the top
BASE = [[-1.0, -1.0], [3, -1], [3, -0.01], [-1, -0.01]]
BASE_CELLS = [[0, 1, 2], [0, 2, 3]]


def pressed(x, cells, kind="triangle", method="node-to-surface"):
    """Press bodies, their feet at height 0 and their tops at 1, on the base."""
    element = basix.ufl.element("Lagrange", kind, 1, shape=(2,))
    domain = mesh.create_mesh(MPI.COMM_WORLD, np.array(cells), element, np.array(x, dtype=float))
    for dims in ((1, 2), (0, 2)):
        domain.topology.create_connectivity(*dims)
    V = (u := displacement(domain)).function_space

    def at(height, dim):
        return mesh.locate_entities_boundary(domain, dim, lambda x: np.isclose(x[1], height))

    feet, top = at(0, 1), at(-0.01, 1)
    facets, order = np.unique(np.concatenate([feet, top]), return_index=True)
    values = np.repeat([1, 2], [len(feet), len(top)]).astype(np.int32)[order]
    tags = mesh.meshtags(domain, 1, facets, values)
    bcs = [
        fem.dirichletbc(np.array(value), fem.locate_dofs_topological(V, 0, at(height, 0)), V)
        for value, height in (((0.0, -0.1), 1), ((0.0, 0.0), -1))
    ]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2), method=method)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], bcs)
    problem.solve()
    return contact


def square(left, right=None):
    """A body of two triangles; its nodes come one after the other."""
    right = left + 1 if right is None else right
    return [[left, 0.0], [right, 0], [right, 1], [left, 1]]


def cells_of(first):
    return [[first + k for k in cell] for cell in BASE_CELLS]


def collapsed(corner):
    """Move a corner of the slave onto the node beside it."""

    def do():
        blocks = scene()
        contact = blocks.contact()
        x = blocks.u.function_space.mesh.geometry.x
        foot = np.flatnonzero((x[:, 1] == 0) & (x[:, 0] >= 0.22) & (x[:, 0] <= 1.24))
        foot = [k for k in foot if np.isclose((x[k, 0] - 0.23) % 0.5, 0)]
        first, second = sorted(foot, key=lambda k: x[k, 0])[:2]
        x[first] += corner * (x[second] - x[first])
        solved(blocks, contact)

    return do


PINCHED = [*BASE, [0, 0], [1, 0], [0, 1], [2, 0], [2, -0.005]]
DEGENERATE = (
    "cells of the mesh are degenerate: they have no volume, or are folded .* and is cell {} of"
)
ROWS = {
    ValueError: [
        (
            lambda: pressed(PINCHED, [*BASE_CELLS, [4, 5, 6], [5, 7, 8]]),
            r"slave surface .* is folded at 1 nodes, .* first at \(1, 0\), node 5 of .*: take",
        ),
        (
            lambda: pressed(
                [*BASE, [0, 0], [1, 0], [0, 1], [0.5, 0.5]], [*BASE_CELLS, [4, 5, 6], [5, 7, 6]]
            ),
            DEGENERATE.format(3),
        ),
        (
            lambda: pressed([*BASE, *square(0.0)], [[0, 1, 3, 2], [4, 5, 6, 7]], "quadrilateral"),
            DEGENERATE.format(1) + ".* row by row, not round about",
        ),
        (
            collapsed(1.0),
            r"1 facets of the slave surface Surface\(tags=\(11,\).* degenerate: .* repair the mesh",
        ),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_slave_nodes_twice_at_the_same_place(method):
    """A crack in the slave: nearly the answer without."""
    crack = pressed(
        [*BASE, *square(0.0), *square(1.0)],
        [*BASE_CELLS, *cells_of(4), *cells_of(8)],
        method=method,
    )
    assert len(crack.slave_nodes) == 4
    assert crack.area == pytest.approx(np.full(4, 0.5))
    assert np.all(crack.multiplier > 0)
    sound = pressed(
        [*BASE, *square(0.0), [2, 0], [2, 1]],
        [*BASE_CELLS, *cells_of(4), [5, 8, 9], [5, 9, 6]],
        method=method,
    )
    assert len(sound.slave_nodes) == 3
    # It is a little stiffer
    assert 0.95 * sound.force[1] < crack.force[1] < sound.force[1]


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_bodies_at_the_same_place_share_the_load(method):
    """All vertices twice, and each surface folded over itself: two bodies that do not touch."""
    two = pressed(
        [*BASE, *square(0.0), *square(0.0)],
        [*BASE_CELLS, *cells_of(4), *cells_of(8)],
        method=method,
    )
    pressure = two.multiplier.reshape(2, -1)
    assert np.sort(pressure[0]) == pytest.approx(np.sort(pressure[1]), rel=1e-9)
    assert np.all(pressure > 0)


@pytest.mark.parametrize("kind", ["triangle", "quadrilateral"])
def test_cells_that_are_numbered_either_way(kind):
    """Negative Jacobians beside positive ones are no fault, and change nothing."""
    x = [*BASE, *square(0.0)]
    if kind == "triangle":
        one, other = [*BASE_CELLS, [4, 5, 6], [4, 6, 7]], [*BASE_CELLS, [5, 4, 6], [4, 6, 7]]
    else:
        one, other = [[0, 1, 3, 2], [4, 5, 7, 6]], [[0, 1, 3, 2], [5, 4, 6, 7]]
    corners = (np.array(x)[np.array(cells)[:, :3]] for cells in (one, other))
    signs = [np.linalg.det(c[:, 1:] - c[:, :1]) for c in corners]
    assert np.all(signs[0] > 0) and np.ptp(np.sign(signs[1])) == 2
    answers = [pressed(x, cells, kind) for cells in (one, other)]
    assert answers[1].force == pytest.approx(answers[0].force, rel=1e-12, abs=1e-15)
