# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells that a displacement turns inside out."""

from collections import namedtuple

from mpi4py import MPI

import numpy as np
import pytest

import basix
import ufl
from contactx import cpp as core
from contactx._host.nodes import linear_cells, parts_of_cells, reference_positions
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from scenes import CELLS, dimension

Found = namedtuple("Found", "smallest cell inverted")
CUBE = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], dtype=np.float64)


def scene(cell, n=3):
    """A displacement on n cells an axis that are out of shape."""
    gdim = dimension(cell)
    create = mesh.create_unit_square if gdim == 2 else mesh.create_unit_cube
    domain = create(MPI.COMM_SELF, *(n,) * gdim, cell)
    x = domain.geometry.x[:, :gdim]
    x += np.random.default_rng(1).uniform(-0.15 / n, 0.15 / n, x.shape)
    return fem.Function(fem.functionspace(domain, ("Lagrange", 1, (gdim,))))


def look(u):
    """Smallest det F of the cells of a displacement, which one has it, and the inverted ones."""
    V = u.function_space
    X = reference_positions(V)
    owned = V.mesh.topology.index_map(V.mesh.topology.dim).size_local
    cells = linear_cells(V)[: owned * parts_of_cells(V)]
    return Found(*core.deformed_cells(cells, X, u.x.array, X.shape[1]))


def by_ufl(u):
    """Values of det(I + grad u) at the points of the audit, shape (num_cells, num_points)."""
    domain = u.function_space.mesh
    cell = basix.CellType[domain.basix_cell().name]
    simplex = cell in (basix.CellType.triangle, basix.CellType.tetrahedron)
    points = basix.create_lattice(cell, 1 if simplex else 2, basix.LatticeType.equispaced, True)
    J = ufl.det(ufl.Identity(domain.geometry.dim) + ufl.grad(u))
    owned = domain.topology.index_map(domain.topology.dim).size_local
    return fem.Expression(J, points).eval(domain, np.arange(owned, dtype=np.int32))


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
@pytest.mark.parametrize("size", [0.02, 0.1, 0.3, 1.0])
def test_smallest_determinant_is_that_of_ufl(cell, size):
    u = scene(cell)
    u.x.array[:] = np.random.default_rng(2).uniform(-size, size, len(u.x.array))
    J = by_ufl(u)
    found = look(u)
    if found.smallest == pytest.approx(J.min(), rel=1e-10, abs=1e-12):
        assert J[found.cell].min() == pytest.approx(J.min(), rel=1e-10, abs=1e-12)
    else:
        # Between the points
        assert cell == CellType.hexahedron and found.smallest < J.min()
    assert found.inverted >= np.count_nonzero(J.min(axis=1) <= 0)
    assert (found.inverted > 0) == (found.smallest <= 0)
    if size == 0.02:
        assert found.inverted == 0
    if size >= 0.3:
        assert found.inverted > 0


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
def test_one_cell_turned_inside_out(cell):
    """A node in the middle that is moved beyond its neighbours."""
    u = scene(cell, 4)
    V = u.function_space
    gdim = dimension(cell)
    at_rest = look(u)
    assert (at_rest.smallest, at_rest.inverted) == (1, 0)
    X = V.tabulate_dof_coordinates()[:, :gdim]
    node = int(np.linalg.norm(X - 0.5, axis=1).argmin())
    u.x.array.reshape(-1, gdim)[node, 0] = 0.5
    found = look(u)
    around = (V.dofmap.list == node).any(axis=1)
    assert 0 < found.inverted <= np.count_nonzero(around)
    assert found.smallest < 0
    assert around[found.cell]


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
def test_half_a_turn_and_a_mirror(cell):
    u = scene(cell)
    V = u.function_space
    gdim = dimension(cell)
    X = V.tabulate_dof_coordinates()[:, :gdim]
    values = u.x.array.reshape(-1, gdim)
    values[:, :2] = 7 - 2 * X[:, :2]
    turned = look(u)
    assert turned.smallest == pytest.approx(1, abs=1e-13)
    assert turned.inverted == 0
    values[:, 0] = 0
    mirrored = look(u)
    assert mirrored.smallest == pytest.approx(-1, abs=1e-13)
    assert mirrored.inverted == V.mesh.topology.index_map(gdim).size_local


def test_curved_cells_are_taken_by_their_vertices():
    """Their geometry has nodes that the displacement has not."""
    curved = mesh.create_mesh(
        MPI.COMM_SELF,
        np.array([[0, 1, 2, 3, 4, 5]]),
        basix.ufl.element("Lagrange", "triangle", 2, shape=(2,)),
        np.array([[0.0, 0], [1, 0], [0, 1], [0.6, 0.6], [0, 0.5], [0.5, 0]]),
    )
    assert curved.geometry.dofmaps[0].shape[1] == 6
    u = fem.Function(fem.functionspace(curved, ("Lagrange", 1, (2,))))
    u.interpolate(lambda x: np.stack([x[0], -0.5 * x[1]]))
    found = look(u)
    assert (found.smallest, found.inverted) == (pytest.approx(1), 0)
    assert found.cell == 0


def test_core_by_itself():
    cells = np.arange(8, dtype=np.int32)[None]
    assert core.deformed_cells(cells, CUBE, CUBE, 3) == (8, 0, 0)
    assert core.deformed_cells(cells[:0], CUBE, CUBE, 3) == (np.inf, -1, 0)
    with pytest.raises(TypeError):
        core.deformed_cells(cells.astype(np.int64), CUBE, CUBE, 3)


@pytest.mark.parametrize(
    ("cells", "X", "u", "gdim", "message"),
    [
        (np.arange(8), CUBE, CUBE, 3, "cells must have a row for each cell"),
        (np.arange(6)[None], CUBE, CUBE, 3, "cells must have 3 or 4 nodes in 2D, and 4 or 8 in 3D"),
        (np.arange(8)[None], CUBE, CUBE, 2, "cells must have 3 or 4 nodes in 2D, and 4 or 8 in 3D"),
        (np.arange(8)[None], CUBE, CUBE, 1, "gdim must be 2 or 3, not 1"),
        (np.arange(8)[None] + 1, CUBE, CUBE, 3, "of which there are 8: there is 8"),
        (np.arange(8)[None] - 1, CUBE, CUBE, 3, "of which there are 8: there is -1"),
        (np.arange(8)[None], CUBE, CUBE[1:], 3, "u must have 3 components for each of 8 nodes"),
        (np.arange(8)[None], CUBE.ravel()[1:], CUBE, 3, "X must have 3 coordinates"),
    ],
)
def test_what_the_core_refuses(cells, X, u, gdim, message):
    with pytest.raises(ValueError, match=message):
        core.deformed_cells(cells.astype(np.int32), X, u, gdim)
