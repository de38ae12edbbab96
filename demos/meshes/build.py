# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From a recipe for a gmsh model to a distributed dolfinx mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import ModuleType

from mpi4py import MPI

import numpy as np

from contactx._host.parallel.reduce import agreed
from dolfinx.io.gmsh import MeshData, extract_geometry, model_to_mesh

from meshes.gmsh_session import gmsh_session
from meshes.partition import by_middles, strips

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
        partitioner = None
        if in_strips:
            x = np.zeros((0, 3)) if model is None else extract_geometry(model)
            partitioner = by_middles(strips, x)
        return model_to_mesh(model, comm, MODEL_RANK, gdim=dim, partitioner=partitioner)
