# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Drawing and naming entities in a gmsh model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import ModuleType

import numpy as np
import numpy.typing as npt

from dolfinx.io.gmsh import MeshData

from meshes.tags import Tag, block_tag

CURVED = "curved"
_AXES = "xyz"


def add_box(
    gmsh: ModuleType,
    corner: Sequence[float],
    size: Sequence[float],
    n: Sequence[int],
    recombine: bool,
) -> int:
    """Draw a box whose mesh is an even structured grid.

    Args:
        gmsh: The gmsh module with its current model.
        corner: The box's lowest corner, shape (dim,) with dim 2 or 3.
        size: Edge lengths, shape (dim,).
        n: Number of cells along each axis, shape (dim,).
        recombine: True for quadrilaterals and hexahedra, False for triangles and tetrahedra.

    Returns:
        The gmsh tag of the box, an entity of dimension dim.
    """
    dim, occ, mesh = len(n), gmsh.model.occ, gmsh.model.mesh
    # The built-in kernel would merge coincident faces of two bodies; OpenCASCADE does not.
    body = occ.addBox(*corner, *size) if dim == 3 else occ.addRectangle(*corner, 0, *size)
    occ.synchronize()
    boundary = gmsh.model.getBoundary([(dim, body)], oriented=False)
    faces = [face for _, face in boundary] if dim == 3 else [body]
    for face in faces:
        for _, edge in gmsh.model.getBoundary([(2, face)], oriented=False):
            extent = np.array(gmsh.model.getBoundingBox(1, edge)).reshape(2, 3)
            axis = int(np.argmax(extent[1] - extent[0]))
            mesh.setTransfiniteCurve(edge, n[axis] + 1)
        mesh.setTransfiniteSurface(face)
        if recombine:
            mesh.setRecombine(2, face)
    if dim == 3:
        mesh.setTransfiniteVolume(body)
    return int(body)


def sides(gmsh: ModuleType, dim: int, body: int) -> dict[str, list[int]]:
    """Sort the faces of a body by the side of its bounding box they lie on.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        dim: Dimension of the body, 2 or 3.
        body: The gmsh tag of the body.

    Returns:
        The gmsh tags of the faces by "x0", "x1", "y0", ... (axis, then 0 for the lower and 1
        for the upper side), or by "curved" if a face lies on no side.
    """
    box = np.array(gmsh.model.getBoundingBox(dim, body)).reshape(2, 3)
    # Bounding boxes of gmsh are padded by about 1e-7.
    tolerance = 1e-5 * float((box[1] - box[0]).max())
    found: dict[str, list[int]] = {}
    for _, face in gmsh.model.getBoundary([(dim, body)], oriented=False):
        low, high = np.array(gmsh.model.getBoundingBox(dim - 1, face)).reshape(2, 3)
        key = CURVED
        for axis in range(dim):
            if high[axis] - low[axis] < tolerance:
                side = int(abs(low[axis] - box[1, axis]) < tolerance)
                key = f"{_AXES[axis]}{side}"
        found.setdefault(key, []).append(face)
    return found


def tag_body(
    gmsh: ModuleType,
    dim: int,
    body: int,
    tag: Tag,
    faces: Mapping[str, Tag],
) -> None:
    """Make physical groups of a body and of its faces.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        dim: Dimension of the body, 2 or 3.
        body: The gmsh tag of the body.
        tag: The tag of the body's cells.
        faces: The tags of its facets by the side, as `sides` names them.
    """
    named = {side: (int(face), face.name.lower()) for side, face in faces.items()}
    group_body(gmsh, dim, body, (int(tag), tag.name.lower()), named)


def group_body(
    gmsh: ModuleType,
    dim: int,
    body: int,
    group: tuple[int, str],
    faces: Mapping[str, tuple[int, str]],
) -> None:
    """Make physical groups of a body and of its faces, by number and name.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        dim: Dimension of the body, 2 or 3.
        body: The gmsh tag of the body.
        group: Number and name of the body's group.
        faces: Numbers and names of its faces' groups by the side, as `sides` names them.
    """
    gmsh.model.addPhysicalGroup(dim, [body], group[0], name=group[1])
    found = sides(gmsh, dim, body)
    for side, (number, name) in faces.items():
        gmsh.model.addPhysicalGroup(dim - 1, found[side], number, name=name)


def group_slabs(gmsh: ModuleType, bodies: Sequence[int], ground: str) -> None:
    """Make physical groups of slabs in a row, of what they lie on, and of all their faces.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        bodies: The gmsh tags of the bodies, the ground first; `block_tag` numbers them so.
        ground: Name of what the slabs lie on.
    """
    sides_of = {"z0": "bottom", "z1": "top"} | {side: side for side in ("x0", "x1", "y0", "y1")}
    for i, body in enumerate(bodies):
        name = f"slab_{i}" if i else ground
        groups = {key: (block_tag(i, side), f"{name}_{side}") for key, side in sides_of.items()}
        group_body(gmsh, 3, body, (block_tag(i), name), groups)


def nodes_of_block(data: MeshData, index: int) -> npt.NDArray[np.integer]:
    """Nodes of the geometry of a block.

    Args:
        data: The mesh.
        index: Number of the block, as `block_tag` takes it.
    """
    cells = data.cell_tags.find(block_tag(index))
    return np.unique(data.mesh.geometry.dofmaps[0][cells])
