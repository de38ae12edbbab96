# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes and function spaces whose cells are contact pairs.

The cells of a carrier mesh stand for pairs of a slave node and a master facet. Function spaces on
it borrow dofs that exist already: those of the bulk displacement, and those of the slave nodes.
Nothing geometric is read from the carrier, so that every cell may be the same dummy tetrahedron.
"""

from __future__ import annotations

import functools
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
from dolfinx import cpp, fem, graph, mesh

_CARRIER = mesh.CellType.tetrahedron
_NUM_VERTICES = 4


@functools.cache
def _element(width: int, block_size: int) -> fem.FiniteElement:
    """Element whose dimension sets the stride of packed coefficients; it is never tabulated."""
    points = np.full((width, 3), 0.25)
    shape = (block_size,) if block_size > 1 else ()
    element = basix.ufl.quadrature_element(
        _CARRIER.name, shape, points=points, weights=np.ones(width)
    )
    return fem.finiteelement(_CARRIER, element, np.float64)


def carrier(comm: MPI.Comm, num_pairs: int) -> Any:
    """Mesh with one cell a pair.

    Args:
        comm: Communicator.
        num_pairs: Number of pairs of this rank.

    Returns:
        A ``dolfinx.cpp.mesh.Mesh_float64``; it has no UFL counterpart.
    """
    cells = np.tile(np.arange(_NUM_VERTICES, dtype=np.int32), (num_pairs, 1))
    vertices = cpp.common.IndexMap(comm, _NUM_VERTICES)
    topology = cpp.mesh.Topology(
        _CARRIER,
        vertices,
        cpp.common.IndexMap(comm, num_pairs),
        graph.adjacencylist(cells)._cpp_object,
        None,
    )
    geometry = cpp.mesh.Geometry_float64(
        vertices,
        cells,
        fem.coordinate_element(_CARRIER, 1)._cpp_object,
        np.eye(_NUM_VERTICES, 3),
        _NUM_VERTICES * comm.rank + np.arange(_NUM_VERTICES, dtype=np.int64),
    )
    return cpp.mesh.Mesh_float64(comm, topology, geometry)


def borrow(mesh: Any, index_map: Any, dofs: npt.NDArray[np.int32], block_size: int) -> Any:
    """Function space on a carrier mesh whose dofs are those of an index map.

    The width of a dofmap comes from its layout and the stride of packed coefficients from the
    element, neither from ``dofs``; where they disagree DOLFINx computes wrong numbers silently.

    Args:
        mesh: Carrier mesh.
        index_map: Map of the blocks that are borrowed.
        dofs: Blocks of each cell, shape (num_pairs, width).
        block_size: Dofs a block.

    Returns:
        A ``dolfinx.cpp.fem.FunctionSpace_float64``.

    Raises:
        RuntimeError: If the widths of dofmap, layout and element disagree.
    """
    width = dofs.shape[1]
    element = _element(width, block_size)
    entities = [[[]], [[]], [[]], [list(range(width))]]
    layout = cpp.fem.ElementDofLayout(block_size, entities, entities, [], [])
    dofmap = cpp.fem.DofMap(
        layout, index_map, block_size, graph.adjacencylist(dofs)._cpp_object, block_size
    )
    widths = (
        dofmap.map().shape[1],
        layout.num_dofs,
        element._cpp_object.space_dimension // block_size,
    )
    if widths != (width, width, width):
        raise RuntimeError(
            f"a borrowed space of width {width} came out with widths {widths} of dofmap, layout "
            "and element: this DOLFINx is not one that contactx knows, take DOLFINx 0.11"
        )
    return cpp.fem.FunctionSpace_float64(mesh, element._cpp_object, dofmap)
