# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two boxes, one on the other, on structured grids; the upper one's bottom may be round."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import CellType

from meshes.bend import Bottom, move_nodes
from meshes.build import build_mesh
from meshes.checks import (
    check_cell_type,
    check_divisions,
    check_finite,
    check_positive,
    check_vector,
)
from meshes.entities import add_box, tag_body
from meshes.tags import Tag


def _faces(body: str, dim: int) -> dict[str, Tag]:
    """Name all faces of a box, by side; the bodies face each other along the last axis."""
    below, above = ("CONTACT", "TOP") if body == "UPPER" else ("BOTTOM", "CONTACT")
    up = "xyz"[dim - 1]
    named = {f"{up}0": Tag[f"{body}_{below}"], f"{up}1": Tag[f"{body}_{above}"]}
    for side in ("x0", "x1", "y0", "y1")[: 2 * (dim - 1)]:
        named[side] = Tag[f"{body}_{side.upper()}"]
    return named


def blocks(
    cell_type: CellType,
    n_upper: Sequence[int],
    n_lower: Sequence[int],
    *,
    size_upper: Sequence[float] | None = None,
    size_lower: Sequence[float] | None = None,
    shift: Sequence[float] | None = None,
    gap: float = 0.0,
    radius: float | None = None,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh two boxes, the upper on the lower one (collective).

    The lower box has a corner in the origin, spans its size along the horizontal axes and lies
    below height zero; the upper box begins at the height ``gap``. The last axis is the height.
    They share no node, also where their grids match. All faces of both bodies are tagged.

    Args:
        cell_type: Triangle or quadrilateral for 2D, tetrahedron or hexahedron for 3D.
        n_upper: Number of cells of the upper box along each axis, shape (dim,).
        n_lower: The same for the lower box.
        size_upper: Edge lengths of the upper box, shape (dim,); a unit box if None.
        size_lower: The same for the lower box.
        shift: Horizontal offset of the upper box's corner from the lower box's, shape
            (dim - 1,); zero if None.
        gap: Distance between the boxes; negative if they overlap.
        radius: Radius of the sphere, or circle in 2D, that the upper box's bottom is bent to, by
            lifting its nodes about the middle; flat if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If the cell type is another one, a sequence has a wrong length, a number of
            cells is below one, a length is not positive, a position is not finite, or the radius
            does not span the upper box or lifts its bottom's corners to its top.
    """
    dim = check_cell_type(cell_type)
    size_upper = (1.0,) * dim if size_upper is None else size_upper
    size_lower = (1.0,) * dim if size_lower is None else size_lower
    shift = (0.0,) * (dim - 1) if shift is None else shift
    for name, n in (("n_upper", n_upper), ("n_lower", n_lower)):
        check_vector(name, n, dim)
        check_divisions(**{f"{name}[{i}]": n_i for i, n_i in enumerate(n)})
    for name, size in (("size_upper", size_upper), ("size_lower", size_lower)):
        check_vector(name, size, dim)
        check_positive(**{f"{name}[{i}]": length for i, length in enumerate(size)})
    check_vector("shift", shift, dim - 1)
    check_finite("gap", gap)
    bottom: Bottom | None = None
    if radius is not None:
        check_positive(radius=radius)
        half = float(np.hypot.reduce(np.asarray(size_upper[:-1]) / 2))
        # Below it the corners would be as high as the box, or not be on the sphere at all
        least = half if half < size_upper[-1] else (half**2 / size_upper[-1] + size_upper[-1]) / 2
        if radius <= least:
            raise ValueError(
                f"radius is {radius}; give more than {least:g}, or the corners of the upper box "
                "do not stay below its top."
            )
        middle = [s + size / 2 for s, size in zip(shift, size_upper[:-1], strict=True)]
        bottom = Bottom(middle, gap, size_upper[-1], radius)
    corner_upper = (*shift, gap)
    corner_lower = (0.0,) * (dim - 1) + (-size_lower[-1],)
    recombine = cell_type in (CellType.quadrilateral, CellType.hexahedron)

    def recipe(gmsh: ModuleType) -> None:
        upper = add_box(gmsh, corner_upper, size_upper, n_upper, recombine)
        lower = add_box(gmsh, corner_lower, size_lower, n_lower, recombine)
        tag_body(gmsh, dim, upper, Tag.UPPER, _faces("UPPER", dim))
        tag_body(gmsh, dim, lower, Tag.LOWER, _faces("LOWER", dim))
        gmsh.model.mesh.generate(dim)
        if bottom is not None:
            move_nodes(gmsh, dim, upper, bottom.bend)

    return build_mesh("blocks", dim, recipe, comm)
