# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes of a displacement of degree 1 or 2, and the linear mesh that has them as its vertices.

DOLFINx's arrays for ``mesh/nodes.h`` of the core.
"""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from dolfinx import cpp, fem, mesh

type Int32 = npt.NDArray[np.int32]
type Array = npt.NDArray[np.float64]


def degree_of(V: fem.FunctionSpace) -> int:
    """Degree of a Lagrange space."""
    return int(V.ufl_element().degree)


def cells_of(V: fem.FunctionSpace) -> tuple[str, int, Int32]:
    """Cells of a Lagrange space: their kind, the degree, and nodes, shape (num_cells, n)."""
    return V.mesh.topology.cell_type.name, degree_of(V), V.dofmap.list


def geometry_of(domain: mesh.Mesh) -> core.MeshGeometry:
    """The mesh of the cells, of any order."""
    geometry = domain.geometry
    return core.MeshGeometry(
        geometry.dim, geometry.cmaps[0].degree, geometry.dofmaps[0], geometry.x
    )


def check_cells(domain: mesh.Mesh, halo: core.Halo) -> None:
    """Check that cells have a volume and are not folded; all ranks must take part.

    Args:
        domain: The mesh.
        halo: Nodes of this rank.

    Raises:
        ValueError: If a cell of any rank is degenerate, on all ranks.
    """
    topology = domain.topology
    try:
        original = topology.original_cell_index
    except RuntimeError:
        # A mesh that was made of another one
        original = np.zeros(0, dtype=np.int64)
    core.check_cells(
        halo,
        topology.cell_type.name,
        geometry_of(domain),
        topology.index_map(topology.dim).size_local,
        original,
    )


def linear_cells(V: fem.FunctionSpace) -> Int32:
    """Cells of the linear mesh of all nodes, those of a cell in turn.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Nodes of the cells that this rank has, ghosts included, shape (num_cells * num_parts,
        num_vertices).
    """
    return core.linear_cells(*cells_of(V))


def parts_of_cells(V: fem.FunctionSpace) -> int:
    """Number of linear cells that a cell is split into."""
    return 1 if degree_of(V) == 1 else 1 << V.mesh.topology.dim


def node_levels(V: fem.FunctionSpace) -> npt.NDArray[np.int8]:
    """Dimension of the entity that nodes of degree 2 are on: 0 vertices, 1 edges, 2 elsewhere.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Levels of owned nodes, then of ghosts, shape (num_nodes,); of degree 1 none.
    """
    return core.node_levels(*cells_of(V), _num_nodes(V))


def reference_positions(V: fem.FunctionSpace) -> Array:
    """Positions of the nodes of a space of degree 1 or 2, ghosts included, shape (num_nodes, gdim).

    They are the mesh's own to the last bit. What DOLFINx evaluates differs by round-off from cell
    to cell, and with it which of two facets is the nearer one would depend on the ranks.
    """
    return core.reference_positions(*cells_of(V), _num_nodes(V), geometry_of(V.mesh))


def original_nodes(V: fem.FunctionSpace) -> npt.NDArray[np.int64]:
    """Number of each node in the mesh as it was made; all ranks must take part.

    Args:
        V: Lagrange space of degree 1 or 2.

    Returns:
        Numbers of owned nodes, then of ghosts, the same on any number of ranks, shape (num_nodes,).
    """
    numbers = V.mesh.geometry.input_global_indices
    count = V.mesh.comm.allreduce(int(numbers.max(initial=-1)), op=MPI.MAX) + 1
    return core.original_nodes(*cells_of(V), _num_nodes(V), geometry_of(V.mesh), numbers, count)


def _num_nodes(V: fem.FunctionSpace) -> int:
    index_map = V.dofmap.index_map
    return int(index_map.size_local + index_map.num_ghosts)


def in_cells(
    domain: mesh.Mesh, facets: npt.NDArray[np.int32]
) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Where facets are in cells.

    Args:
        domain: The mesh.
        facets: Facets of this rank, shape (n,).

    Returns:
        The first cell of each, and its number in that, shape (n,).
    """
    topology, tdim = domain.topology, domain.topology.dim
    topology.create_connectivity(tdim - 1, tdim)
    topology.create_connectivity(tdim, tdim - 1)
    cells_of_facet = topology.connectivity(tdim - 1, tdim)
    cells = cells_of_facet.array[cells_of_facet.offsets[facets]]
    per_cell = cpp.mesh.cell_num_entities(topology.cell_type, tdim - 1)
    facets_of_cell = topology.connectivity(tdim, tdim - 1).array.reshape(-1, per_cell)
    local = np.argmax(facets_of_cell[cells] == facets[:, None], axis=1)
    return cells, local.astype(np.int32)
