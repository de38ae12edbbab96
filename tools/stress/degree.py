# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Degree of the displacement of the scenes of blocks: the map can be drawn of either."""

from __future__ import annotations

import os

import numpy as np
import numpy.typing as npt

import basix
from dolfinx import fem

VARIABLE = "CONTACTX_STRESS_DEGREE"
DEGREE = int(os.environ.get(VARIABLE, "1"))


def vertex_nodes(V: fem.FunctionSpace) -> npt.NDArray[np.int64]:
    """Node of V at each vertex of a mesh of order 1, shape (num_vertices,)."""
    geometry = V.mesh.geometry
    vertices = geometry.dofmaps[0]
    nodes = np.empty(len(geometry.x), dtype=np.int64)
    # Vertices come first among the dofs of a cell
    nodes[vertices.ravel()] = V.dofmap.list[:, : vertices.shape[1]].ravel()
    return nodes


def split(parts: npt.NDArray[np.integer], V: fem.FunctionSpace) -> npt.NDArray[np.integer]:
    """Facets between all nodes, of facets between vertices.

    Args:
        parts: Nodes of V at the vertices of segments, triangles or quadrilaterals, shape (m, k).
        V: Space of the displacement.

    Returns:
        The same for degree 1, else twice or four times as many facets.
    """
    if DEGREE == 1:
        return parts
    cell, dofs = V.mesh.basix_cell(), V.dofmap.list
    number: dict[tuple[int, ...], int] = {}
    element = basix.create_element(basix.ElementFamily.P, cell, 2, basix.LagrangeVariant.gll_warped)
    for entities, own in zip(basix.topology(cell), element.entity_dofs, strict=True):
        for vertices, (dof, *_) in zip(entities, [d or [-1] for d in own], strict=True):
            if dof >= 0:
                ends = np.sort(dofs[:, vertices], axis=1)
                number |= zip(map(tuple, ends.tolist()), dofs[:, dof].tolist(), strict=True)

    def middle(*columns: int) -> npt.NDArray[np.integer]:
        ends = np.sort(parts[:, list(columns)], axis=1)
        return np.array([number[tuple(row)] for row in ends.tolist()])

    if parts.shape[1] == 2:
        a, b = parts.T
        m = middle(0, 1)
        return np.concatenate([np.stack(s, axis=1) for s in ((a, m), (m, b))])
    if parts.shape[1] == 3:
        a, b, c = parts.T
        ab, bc, ca = middle(0, 1), middle(1, 2), middle(2, 0)
        four = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
        return np.concatenate([np.stack(s, axis=1) for s in four])
    a, b, c, d = parts.T
    ab, ac, bd, cd = middle(0, 1), middle(0, 2), middle(1, 3), middle(2, 3)
    m = middle(0, 1, 2, 3)
    four = ((a, ab, ac, m), (ab, b, m, bd), (ac, m, c, cd), (m, bd, cd, d))
    return np.concatenate([np.stack(s, axis=1) for s in four])
