# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From a recipe for a gmsh model to a distributed dolfinx mesh."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from types import ModuleType

from mpi4py import MPI

from contactx.parallel.agreement import agreed
from dolfinx.io.gmsh import MeshData, model_to_mesh

from meshes.gmsh_session import gmsh_session

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
        Exception: What the recipe raised on rank 0, on all ranks.
    """
    with ExitStack() as stack:
        gmsh: ModuleType | None = None
        with agreed(comm):
            if comm.rank == MODEL_RANK:
                gmsh = stack.enter_context(gmsh_session(name, options))
                recipe(gmsh)
        model = None if gmsh is None else gmsh.model
        return model_to_mesh(model, comm, MODEL_RANK, gdim=dim)
