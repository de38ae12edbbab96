# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One body of a model of several, for scenes with a rigid obstacle."""

from __future__ import annotations

from numbers import Integral

from dolfinx import mesh
from dolfinx.io.gmsh import MeshData

from meshes.tags import Tag


def single(data: MeshData, body: Tag) -> tuple[mesh.Mesh, mesh.MeshTags]:
    """Mesh of one body of a model (collective).

    Args:
        data: A model of this package.
        body: The body, ``Tag.UPPER`` or ``Tag.LOWER``.

    Returns:
        The mesh of the body alone and its facet tags.

    Raises:
        ValueError: If the model has no such body.
    """
    if not isinstance(data, MeshData):
        raise TypeError(f"data is a {type(data).__name__}; give what a mesh function has returned.")
    if not isinstance(body, Integral):
        raise TypeError(f"body is {body!r}; give a Tag, such as Tag.UPPER.")
    cells = data.cell_tags.find(body)
    if data.mesh.comm.allreduce(len(cells)) == 0:
        raise ValueError(f"body is {body!r}, which the model does not have; give one that it has.")
    alone, cell_map, vertex_map, _ = mesh.create_submesh(data.mesh, data.mesh.topology.dim, cells)
    # Boundary conditions on facets need it
    alone.topology.create_connectivity(alone.topology.dim - 1, alone.topology.dim)
    tags = mesh.transfer_meshtags_to_submesh(data.facet_tags, alone, vertex_map, cell_map)
    return alone, tags
