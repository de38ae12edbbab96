# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Any number of boxes, each on the one before, on structured grids."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import CellType

from meshes.build import build_mesh
from meshes.checks import (
    check_cell_type,
    check_divisions,
    check_positive,
    check_vector,
)
from meshes.entities import add_box, group_body
from meshes.tags import block_tag


def _faces(index: int, dim: int) -> dict[str, tuple[int, str]]:
    """Number and name all faces of a block, by side; the last axis is the height."""
    up = "xyz"[dim - 1]
    names = {f"{up}0": "bottom", f"{up}1": "top"}
    names.update((side, side) for side in ("x0", "x1", "y0", "y1")[: 2 * (dim - 1)])
    return {side: (block_tag(index, name), f"block_{index}_{name}") for side, name in names.items()}


def stack(
    cell_type: CellType,
    divisions: Sequence[Sequence[int]],
    *,
    sizes: Sequence[Sequence[float]] | None = None,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh boxes that lie on each other, the lowest on the plane of height zero (collective).

    The last axis is the height. Each box has a corner above the origin and spans its size along
    the horizontal axes. They touch and share no node, also where their grids match. All faces of
    all boxes are tagged; `block_tag` gives the tags by the number of the box, 0 for the lowest.

    Args:
        cell_type: Triangle or quadrilateral for 2D, tetrahedron or hexahedron for 3D.
        divisions: Number of cells of each box along each axis, the lowest box first, shape
            (n, dim).
        sizes: Edge lengths of each box, shape (n, dim); unit boxes if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with tags of its boxes in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If the cell type is another one, there is no box, a sequence has a wrong
            length, a number of cells is below one, or a length is not positive.
    """
    dim = check_cell_type(cell_type)
    if not np.iterable(divisions):
        raise TypeError(f"divisions is {divisions!r}; give the numbers of cells of each box.")
    if len(divisions) == 0:
        raise ValueError("divisions is empty; give the numbers of cells of each box.")
    sizes = [(1.0,) * dim] * len(divisions) if sizes is None else sizes
    if len(sizes) != len(divisions):
        raise ValueError(
            f"sizes has {len(sizes)} entries and divisions {len(divisions)}; give one for each box."
        )
    for i, (n, size) in enumerate(zip(divisions, sizes, strict=True)):
        check_vector(f"divisions[{i}]", n, dim)
        check_divisions(**{f"divisions[{i}][{k}]": n_k for k, n_k in enumerate(n)})
        check_vector(f"sizes[{i}]", size, dim)
        check_positive(**{f"sizes[{i}][{k}]": length for k, length in enumerate(size)})
    recombine = cell_type in (CellType.quadrilateral, CellType.hexahedron)

    def recipe(gmsh: ModuleType) -> None:
        height = 0.0
        for i, (n, size) in enumerate(zip(divisions, sizes, strict=True)):
            box = add_box(gmsh, (*(0.0,) * (dim - 1), height), size, n, recombine)
            group_body(gmsh, dim, box, (block_tag(i), f"block_{i}"), _faces(i, dim))
            height += size[-1]
        gmsh.model.mesh.generate(dim)

    return build_mesh("stack", dim, recipe, comm)
