# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A gmsh model of one's own, quiet, and cleaned up in every case."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import ModuleType

# A gmsh that the user has initialised may carry options that would change our meshes.
_OPTIONS: Mapping[str, float] = {
    "General.Terminal": 0,
    "General.NumThreads": 1,
    "Mesh.Algorithm": 6,
    "Mesh.Algorithm3D": 1,
    "Mesh.ElementOrder": 1,
    "Mesh.MeshSizeExtendFromBoundary": 0,
    "Mesh.MeshSizeFactor": 1,
    "Mesh.MeshSizeFromCurvature": 0,
    "Mesh.MeshSizeFromPoints": 0,
    "Mesh.MeshSizeMax": 1e22,
    "Mesh.MeshSizeMin": 0,
    "Mesh.Optimize": 1,
    "Mesh.RandomSeed": 1,
    "Mesh.RecombineAll": 0,
    "Mesh.SecondOrderLinear": 0,
    "Mesh.SubdivisionAlgorithm": 0,
    "Mesh.TransfiniteTri": 0,
}


def _import_gmsh() -> ModuleType:
    """Import gmsh, or say how to get it."""
    try:
        return importlib.import_module("gmsh")
    except ImportError as error:
        raise ImportError(
            "meshes needs gmsh; install it with: pip install contactx[demo]"
        ) from error


@contextmanager
def gmsh_session(name: str, options: Mapping[str, float] | None = None) -> Iterator[ModuleType]:
    """Open an empty gmsh model and remove it at the end, also after an error.

    If gmsh runs already, its options and its current model are the same afterwards as before;
    otherwise it is started and finalised.

    Args:
        name: Name of the model.
        options: Number options of gmsh that the model needs, by their full name.

    Yields:
        The gmsh module, with the new model as its current one.

    Raises:
        ImportError: If gmsh is not installed.
    """
    gmsh = _import_gmsh()
    started_here = not gmsh.isInitialized()
    if started_here:
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    wanted = {**_OPTIONS, **(options or {})}
    saved = {key: gmsh.option.getNumber(key) for key in wanted}
    previous = gmsh.model.getCurrent()
    try:
        for key, value in wanted.items():
            gmsh.option.setNumber(key, value)
        gmsh.model.add(f"contactx_{name}")
        try:
            yield gmsh
        finally:
            gmsh.model.remove()
    finally:
        if started_here:
            gmsh.finalize()
        else:
            for key, value in saved.items():
                gmsh.option.setNumber(key, value)
            # Without a name gmsh has no model that setCurrent could find.
            if previous:
                gmsh.model.setCurrent(previous)
