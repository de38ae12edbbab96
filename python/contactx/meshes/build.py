# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From a recipe for a gmsh model to a distributed dolfinx mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import ModuleType

from mpi4py import MPI

from contactx.meshes.gmsh_session import gmsh_session
from dolfinx.io.gmsh import MeshData, model_to_mesh

MODEL_RANK = 0


def build_mesh(
    name: str,
    dim: int,
    recipe: Callable[[ModuleType], None],
    comm: MPI.Comm,
    options: Mapping[str, float] | None = None,
) -> MeshData:
    """Run a recipe in a gmsh model on rank 0 and distribute its mesh (collective).

    Args:
        name: Name of the model.
        dim: Dimension of the mesh and of its space.
        recipe: Draws, tags and meshes the model; called with the gmsh module.
        comm: Communicator of the mesh.
        options: Number options of gmsh that the model needs, by their full name.

    Returns:
        The mesh with its cell tags and facet tags.

    Raises:
        RuntimeError: On the other ranks, if the recipe failed on rank 0.
    """
    with ExitStack() as stack:
        gmsh: ModuleType | None = None
        error: Exception | None = None
        if comm.rank == MODEL_RANK:
            try:
                gmsh = stack.enter_context(gmsh_session(name, options))
                recipe(gmsh)
            except Exception as caught:
                error = caught
        # Every rank has to hear of the failure, or it would wait for a mesh for ever.
        message = comm.bcast(None if error is None else str(error), root=MODEL_RANK)
        if error is not None:
            raise error
        if message is not None:
            raise RuntimeError(f"gmsh failed on rank {MODEL_RANK}: {message}")
        model = None if gmsh is None else gmsh.model
        return model_to_mesh(model, comm, MODEL_RANK, gdim=dim)
