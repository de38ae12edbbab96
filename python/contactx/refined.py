# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes of a displacement of degree 1 or 2, and the linear mesh that has them as its vertices.

Contact sees a quadratic displacement at its nodes: cells and facets are split at the middles of
their edges into linear ones. Nothing is split where the degree is 1.
"""

from __future__ import annotations

from functools import cache
from itertools import product

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix
from dolfinx import fem

type Int32 = npt.NDArray[np.int32]
type Array = npt.NDArray[np.float64]
_TENSOR = (basix.CellType.interval, basix.CellType.quadrilateral, basix.CellType.hexahedron)


def degree_of(V: fem.FunctionSpace) -> int:
    """Degree of a Lagrange space."""
    return int(V.ufl_element().degree)


@cache
def _entities(cell: basix.CellType, degree: int) -> list[tuple[int, ...]]:
    """Vertices of the entity of a cell whose middle each local dof is at."""
    element = basix.create_element(
        basix.ElementFamily.P, cell, degree, basix.LagrangeVariant.gll_warped
    )
    found: list[tuple[int, ...]] = [()] * element.dim
    for of_dimension, dofs in zip(basix.topology(cell), element.entity_dofs, strict=True):
        for vertices, mine in zip(of_dimension, dofs, strict=True):
            for dof in mine:
                found[dof] = tuple(vertices)
    return found


@cache
def _parts(cell: basix.CellType, corners: tuple[int, ...]) -> list[tuple[tuple[int, ...], ...]]:
    """Linear parts of a simplex or box, by the vertices whose middle each of their vertices is.

    Args:
        cell: Its type.
        corners: Its vertices.
    """
    if cell in _TENSOR:
        dim = len(basix.geometry(cell)[0])
        parts = []
        for first in product(range(2), repeat=dim):
            # The first axis counts fastest
            place = first[::-1]
            part = []
            for step in product(range(2), repeat=dim):
                at = [p + s for p, s in zip(place, step[::-1], strict=True)]
                # 0 and 2 are the ends of an axis, 1 its middle
                ends = [(0,) if a == 0 else (1,) if a == 2 else (0, 1) for a in at]
                number = [
                    sum(e << k for k, e in enumerate(reversed(choice)))
                    for choice in product(*reversed(ends))
                ]
                part.append(tuple(corners[n] for n in sorted(number)))
            parts.append(tuple(part))
        return parts

    def middle(i: int, j: int) -> tuple[int, ...]:
        return tuple(sorted((corners[i], corners[j])))

    ends = [(c,) for c in corners]
    if len(corners) == 3:
        m01, m02, m12 = middle(0, 1), middle(0, 2), middle(1, 2)
        return [(ends[0], m01, m02), (m01, ends[1], m12), (m02, m12, ends[2]), (m01, m12, m02)]
    parts = []
    for i in range(4):
        others = [j for j in range(4) if j != i]
        parts.append((ends[i], *(middle(i, j) for j in others)))
    # Between the corners an octahedron, about one of its diagonals
    ring = [middle(0, 2), middle(0, 3), middle(1, 3), middle(1, 2)]
    for a, b in zip(ring, [*ring[1:], ring[0]], strict=True):
        parts.append((middle(0, 1), middle(2, 3), a, b))
    return parts


@cache
def _dofs_of_parts(
    of: basix.CellType, corners: tuple[int, ...], cell: basix.CellType, degree: int
) -> npt.NDArray[np.int64]:
    """Local dofs of the linear parts of an entity of a cell, shape (num_parts, num_vertices).

    Args:
        of: Type of the entity.
        corners: Its vertices in the cell.
        cell: Type of the cell.
        degree: Degree, 1 or 2.
    """
    if degree == 1:
        return np.array([corners])
    number = {tuple(sorted(v)): dof for dof, v in enumerate(_entities(cell, degree))}
    parts: npt.NDArray[np.int64] = np.array(
        [[number[tuple(sorted(v))] for v in part] for part in _parts(of, corners)]
    )
    return parts


def linear_cells(V: fem.FunctionSpace) -> Int32:
    """Cells of the linear mesh of all nodes, those of a cell in turn.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Nodes of the cells that this rank has, ghosts included, shape (num_cells * num_parts,
        num_vertices).
    """
    degree = degree_of(V)
    if degree == 1:
        return np.asarray(V.dofmap.list)
    cell = V.mesh.basix_cell()
    corners = tuple(range(len(basix.geometry(cell))))
    parts = _dofs_of_parts(cell, corners, cell, degree)
    return np.ascontiguousarray(V.dofmap.list[:, parts].reshape(-1, len(corners)))


def parts_of_cells(V: fem.FunctionSpace) -> int:
    """Number of linear cells that a cell is split into."""
    return 1 if degree_of(V) == 1 else 1 << V.mesh.topology.dim


def facet_parts(V: fem.FunctionSpace, facet: int, is_swapped: bool) -> npt.NDArray[np.int64]:
    """Local dofs of the linear parts of a facet of a cell, shape (num_parts, num_vertices).

    Args:
        V: Lagrange space of degree 1 or 2.
        facet: Number of the facet in the cell.
        is_swapped: Whether its normal is turned around.
    """
    cell = V.mesh.basix_cell()
    tdim = V.mesh.topology.dim
    corners = list(basix.topology(cell)[tdim - 1][facet])
    if is_swapped:
        first = 0 if tdim == 2 else 1
        corners[first], corners[first + 1] = corners[first + 1], corners[first]
    of = basix.cell.subentity_types(cell)[tdim - 1][facet]
    return _dofs_of_parts(of, tuple(corners), cell, degree_of(V))


def node_levels(V: fem.FunctionSpace) -> npt.NDArray[np.int8]:
    """Dimension of the entity that nodes of degree 2 are on: 0 vertices, 1 edges, 2 elsewhere.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Levels of owned nodes, then of ghosts, shape (num_nodes,); of degree 1 none.
    """
    if degree_of(V) == 1:
        return np.zeros(0, dtype=np.int8)
    levels = np.zeros(_num_nodes(V), dtype=np.int8)
    level = {1: 0, 2: 1}
    for dof, vertices in enumerate(_entities(V.mesh.basix_cell(), degree_of(V))):
        levels[V.dofmap.list[:, dof]] = level.get(len(vertices), 2)
    return levels


def reference_positions(V: fem.FunctionSpace) -> Array:
    """Positions of the nodes of a space of degree 1 or 2, ghosts included, shape (num_nodes, gdim).

    They are the mesh's own to the last bit. What DOLFINx evaluates differs by rounding from cell
    to cell, and with it which of two facets is the nearer one would depend on the ranks.
    """
    geometry, dofs = V.mesh.geometry, V.dofmap.list
    nodes, degree = geometry.dofmaps[0], degree_of(V)
    X = geometry.x[:, : geometry.dim]
    x = np.zeros((_num_nodes(V), geometry.dim))
    if degree == geometry.cmaps[0].degree:
        x[dofs] = X[nodes]
        return x
    for dof, vertices in enumerate(_entities(V.mesh.basix_cell(), degree)):
        # Vertices come first in the geometry of a cell. Opposite ones are added first, so that the
        # sum does not depend on where a cell begins to count
        ends = [X[nodes[:, v]] for v in vertices]
        if len(ends) > 1:
            ends = [ends[k] + ends[-1 - k] for k in range(len(ends) // 2)]
        x[dofs[:, dof]] = sum(ends[1:], start=ends[0]) / len(vertices)
    return x


def original_nodes(V: fem.FunctionSpace) -> npt.NDArray[np.int64]:
    """Number of each node in the mesh as it was made; all ranks must take part.

    Nodes at the middle of something get numbers from those of its vertices, unless they are nodes
    of the mesh.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Numbers of owned nodes, then of ghosts, the same on any number of ranks, shape (num_nodes,).
    """
    geometry, dofs = V.mesh.geometry, V.dofmap.list
    nodes, degree = geometry.dofmaps[0], degree_of(V)
    numbers = geometry.input_global_indices
    original = np.full(_num_nodes(V), -1, dtype=np.int64)
    if degree == geometry.cmaps[0].degree:
        original[dofs] = numbers[nodes]
        return original
    count = 0
    if degree > 1:
        most = int(numbers.max(initial=-1))
        count = V.mesh.comm.allreduce(most, op=MPI.MAX) + 1
    for dof, vertices in enumerate(_entities(V.mesh.basix_cell(), degree)):
        of_ends = numbers[nodes[:, list(vertices)]]
        if len(vertices) == 1:
            original[dofs[:, dof]] = of_ends[:, 0]
            continue
        # The first vertex and the one opposite to it, which no other middle has
        first = of_ends.argmin(axis=1)
        row = np.arange(len(of_ends))
        low, high = of_ends[row, first], of_ends[row, len(vertices) - 1 - first]
        original[dofs[:, dof]] = count * (1 + low) + high
    return original


def _num_nodes(V: fem.FunctionSpace) -> int:
    index_map = V.dofmap.index_map
    return int(index_map.size_local + index_map.num_ghosts)
