# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes that are distributed with their contact; on several ranks: tests/verify/parallel."""

from mpi4py import MPI

import numpy as np
import pytest

import basix.ufl
import contactx as cx
import ufl
from dolfinx import mesh

from scenes.grids import grid


def near(x):
    return np.isclose(x[1], 0)


def test_mesh_is_made():
    points, cells = grid([0, 0], [1, 1], [4, 4])
    element = ufl.Mesh(basix.ufl.element("Lagrange", "quadrilateral", 1, shape=(2,)))
    partitioner = cx.partitioner(points, near)
    domain = mesh.create_mesh(MPI.COMM_WORLD, cells, element, points, partitioner=partitioner)
    assert domain.topology.index_map(2).size_global == 16


def test_vertices_are_among_the_nodes():
    points, cells = grid([0, 0], [1, 1], [4, 4])
    partitioner = cx.partitioner(points[:-1], near)
    with pytest.raises(ValueError, match="not among the 24 nodes of x"):
        partitioner(MPI.COMM_WORLD, 2, [mesh.CellType.quadrilateral], [cells.ravel()])


def test_cells_of_one_kind():
    partitioner = cx.partitioner(np.zeros((0, 3)), near)
    with pytest.raises(ValueError, match="cells of one kind, not of 2"):
        partitioner(MPI.COMM_WORLD, 1, [None, None], [])


@pytest.mark.parametrize(
    ("x", "near", "error", "match"),
    [
        (np.zeros(3), near, ValueError, r"x must be of shape \(n, 2\) or \(n, 3\), not \(3,\)"),
        (np.zeros((4, 1)), near, ValueError, "x must be of shape"),
        (np.zeros((4, 2)), 0.1, TypeError, "near must be a function of points, not float"),
        (np.zeros((4, 2)), lambda x: x[0], ValueError, "a boolean for each of the 4 points"),
        (np.zeros((4, 2)), lambda x: True, ValueError, "a boolean for each of the 4 points"),
    ],
)
def test_wrong_arguments(x, near, error, match):
    with pytest.raises(error, match=match):
        cx.partitioner(x, near)
