# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From a recipe for a gmsh model to a distributed dolfinx mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import ModuleType
from typing import Any

from mpi4py import MPI

import numpy as np

from contactx.parallel.agreement import agreed
from dolfinx.cpp.mesh import cell_num_vertices
from dolfinx.graph import adjacencylist
from dolfinx.io.gmsh import MeshData, extract_geometry, model_to_mesh

from meshes.gmsh_session import gmsh_session

MODEL_RANK = 0


def build_mesh(
    name: str,
    dim: int,
    recipe: Callable[[ModuleType], None],
    comm: MPI.Comm,
    options: Mapping[str, float] | None = None,
    *,
    in_strips: bool = False,
) -> MeshData:
    """Run a recipe in a gmsh model on rank 0 and distribute its mesh (collective).

    Args:
        name: Name of the model.
        dim: Dimension of the mesh and of its space.
        recipe: Draws, tags and meshes the model; called with the gmsh module.
        comm: Communicator of the mesh.
        options: Number options of gmsh that the model needs, by their full name.
        in_strips: Whether each rank has a strip of the cells along x, with its part of all bodies;
            by default a rank may have one body and another rank the other one, so that all slave
            nodes are on one of them.

    Returns:
        The mesh with its cell tags and facet tags.

    Raises:
        Exception: What the recipe raised on rank 0, on all ranks.
    """
    with ExitStack() as stack:
        gmsh: ModuleType | None = None
        with agreed(comm):
            if comm.rank == MODEL_RANK:
                gmsh = stack.enter_context(gmsh_session(name, options))
                recipe(gmsh)
        model = None if gmsh is None else gmsh.model
        partitioner = _strips(model) if in_strips else None
        return model_to_mesh(model, comm, MODEL_RANK, gdim=dim, partitioner=partitioner)


def _strips(model: Any) -> Callable[..., Any]:
    """A partitioner that gives each rank as many cells, in the order of their places along x.

    Args:
        model: Model of gmsh on the rank that has it, else None.
    """
    x = np.empty(0) if model is None else extract_geometry(model)[:, 0]

    def partition(comm: MPI.Comm, parts: int, kinds: Any, cells: list[Any]) -> Any:
        (vertices,) = cells
        places = x[vertices.reshape(-1, cell_num_vertices(kinds[0]))].mean(axis=1)
        order = np.argsort(places, kind="stable")
        destination = np.empty(len(order), dtype=np.int32)
        destination[order] = np.arange(len(order)) * parts // max(len(order), 1)
        return adjacencylist(destination[:, None])._cpp_object

    return partition
