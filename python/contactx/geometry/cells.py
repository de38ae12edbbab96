# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shape of the cells of a mesh."""

from __future__ import annotations

from itertools import product

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel import reduce
from dolfinx import mesh
from dolfinx.mesh import CellType

_ROUNDING = 1e-12
# Cells, for which memory for their corners is enough
_AT_ONCE = 1 << 16
_SIMPLICES = (CellType.triangle, CellType.tetrahedron)
# Kinds of cells that contact is made for
KINDS = (*_SIMPLICES, CellType.quadrilateral, CellType.hexahedron)


def _corners(cell_type: CellType, gdim: int) -> npt.NDArray[np.int64]:
    """Edges that span the Jacobian at each corner, as pairs of vertices, shape (c, gdim, 2)."""
    if cell_type in _SIMPLICES:
        return np.array([[(0, k + 1) for k in range(gdim)]])
    corners = []
    for corner in product(range(2), repeat=gdim):
        along = []
        for axis in range(gdim):
            ends = [tuple(end if k == axis else c for k, c in enumerate(corner)) for end in (0, 1)]
            # The first axis counts fastest
            along.append([sum(c << k for k, c in enumerate(end)) for end in ends])
        corners.append(along)
    return np.array(corners)


def jacobians(x: npt.NDArray[np.float64], cell_type: CellType) -> npt.NDArray[np.float64]:
    """Determinants at the corners of cells where they differ, over the lengths of the edges.

    Args:
        x: Vertices, shape (num_cells, num_vertices, gdim).
        cell_type: Triangle, quadrilateral, tetrahedron or hexahedron.

    Returns:
        Determinants of unit vectors, 0 where an edge has no length, shape (num_cells, c).
    """
    edges = _corners(cell_type, x.shape[2])
    t = x[:, edges[:, :, 1]] - x[:, edges[:, :, 0]]
    length = np.linalg.norm(t, axis=3, keepdims=True)
    unit = np.divide(t, length, out=np.zeros_like(t), where=length > 0)
    determinants: npt.NDArray[np.float64] = np.linalg.det(unit)
    return determinants


def _degenerate(nodes: npt.NDArray[np.int32], domain: mesh.Mesh) -> npt.NDArray[np.bool_]:
    """Mark degenerate cells, shape (n,), given by their vertices, shape (n, num_vertices)."""
    x = domain.geometry.x[nodes, : domain.geometry.dim]
    found = jacobians(x, domain.topology.cell_type)
    low, high = found.min(axis=1), found.max(axis=1)
    turned = (low < -_ROUNDING) & (high > _ROUNDING)
    return turned | (np.maximum(-low, high) <= _ROUNDING)


def check_cells(domain: mesh.Mesh) -> None:
    """Check that cells have a volume and are not turned inside out at some of their corners.

    Which way round a cell is numbered does not matter. All ranks must take part.

    Args:
        domain: The mesh.

    Raises:
        ValueError: If a cell of any rank is degenerate, on all ranks.
    """
    topology, geometry = domain.topology, domain.geometry
    if topology.cell_type not in KINDS:
        return
    owned = topology.index_map(topology.dim).size_local
    # Vertices come first in the geometry of a cell
    vertices = 1 + geometry.dim if topology.cell_type in _SIMPLICES else 2**geometry.dim
    nodes = geometry.dofmaps[0][:owned, :vertices]
    found = [_degenerate(nodes[k : k + _AT_ONCE], domain) for k in range(0, owned, _AT_ONCE)]
    bad = np.flatnonzero(np.concatenate([np.zeros(0, dtype=bool), *found]))
    count = reduce.total(domain.comm, len(bad))
    if count > 0:
        numbers = topology.original_cell_index[bad].tolist()
        middles = geometry.x[nodes[bad], : geometry.dim].mean(axis=1)
        number, at = reduce.first(domain.comm, numbers, list(zip(numbers, middles, strict=True)))
        size = float(reduce.extent(domain.comm, geometry.x).max())
        raise ValueError(
            f"{count} cells of the mesh are degenerate: they have no volume, or are folded so that "
            f"their Jacobian changes sign. The first is at {core.point_text(at, size)} and is cell "
            f"{number} of the mesh as it was made: repair the mesh there. The vertices of "
            "quadrilaterals and hexahedra may be in another order than DOLFINx has: row by row, "
            "not round about (manual: errors/refused-mesh)"
        )
