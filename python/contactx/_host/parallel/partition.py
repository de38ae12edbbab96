# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes whose ranks all have a part of the contact."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp
from contactx._host.parallel.mpi_host import MPIRanks
from contactx._host.parallel.reduce import agreed
from dolfinx.cpp.mesh import cell_num_vertices
from dolfinx.graph import adjacencylist


def partitioner(
    x: npt.ArrayLike, near: Callable[[npt.NDArray[np.float64]], npt.ArrayLike]
) -> Callable[..., Any]:
    """Make a partitioner that gives each rank as many cells and as much of the contact.

    DOLFINx's own keeps a rank's cells together and knows nothing of contact: often one rank has all
    slave nodes and another one most of the master, and each waits for the other. This one cuts the
    mesh by planes across the contact, each of which halves the cells and, turned as far as it
    takes, the contact (Stone and Tukey 1942, Generalized "sandwich" theorems). It is handed to what
    makes the mesh::

        x = gmshio.extract_geometry(model) if comm.rank == 0 else np.zeros((0, 3))
        part = cx.partitioner(x, lambda x: abs(x[2]) < 0.1)
        data = gmshio.model_to_mesh(model, comm, 0, partitioner=part)

    Args:
        x: Positions of the nodes as they are handed to DOLFINx with the cells: on each rank those
            that it gives, if only none, shape (n, gdim). Of a gmsh model what ``extract_geometry``
            returns on the rank that has the model, of an XDMF file what ``read_geometry_data``
            does.
        near: Tells which points are on surfaces where they may come into contact, as markers of
            ``locate_entities`` do: takes positions, shape (gdim, n), and returns n booleans. What
            comes into contact early counts; where none is, the cells alone are shared out.

    Returns:
        A function for the argument ``partitioner`` of ``create_mesh``, ``model_to_mesh`` and
        ``read_from_msh``. It makes no ghost cells. It raises a ValueError on all ranks if there is
        more than one kind of cells, or a cell has a vertex that is not among the nodes.

    Raises:
        TypeError: If ``near`` cannot be called.
        ValueError: If ``x`` has not 2 or 3 columns, or ``near`` does not return a boolean for each
            point.
    """
    points = np.ascontiguousarray(x, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"x must be of shape (n, 2) or (n, 3), not {points.shape}")
    if not callable(near):
        raise TypeError(f"near must be a function of points, not {type(near).__name__}")
    marks = np.asarray(near(points.T)) if len(points) else np.zeros(0, dtype=bool)
    if marks.shape != (len(points),) or marks.dtype != np.bool_:
        raise ValueError(
            f"near must return a boolean for each of the {len(points)} points, not values of "
            f"{marks.dtype.name} of shape {marks.shape}"
        )

    def parts(comm: MPI.Comm, size: int, cell_types: Sequence[Any], cells: Sequence[Any]) -> Any:
        with agreed(comm):
            if len(cell_types) != 1:
                raise ValueError(
                    f"the mesh must have cells of one kind, not of {len(cell_types)}: contact has "
                    "no mixed meshes"
                )
        vertices = np.asarray(cells[0], dtype=np.int64)
        ranks = cpp.parts_with_contact(
            MPIRanks(comm),
            vertices.reshape(-1, cell_num_vertices(cell_types[0])),
            points,
            marks.astype(np.int8),
            size,
        )
        return adjacencylist(ranks.reshape(-1, 1))._cpp_object

    return parts
