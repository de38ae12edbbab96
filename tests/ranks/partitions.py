# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes distributed in ways that the usual partitioner would not find."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

import numpy as np

import contactx as cx
from dolfinx import mesh
from dolfinx.io.gmsh import MeshData, extract_geometry, model_to_mesh

from meshes import build
from meshes.partition import Points, Ranks, by_middles, parts, strips


def first(x: Points, size: int) -> Ranks:
    """All on rank 0; the others have nothing."""
    return np.zeros(len(x), dtype=np.int32)


def bodies(x: Points, size: int) -> Ranks:
    """The upper body on rank 0, the lower one on the last rank, nothing on those between."""
    return np.where(x[:, -1] > 0, 0, size - 1).astype(np.int32)


def opposed(x: Points, size: int) -> Ranks:
    """Strips, in the upper body from left to right and in the lower one the other way round."""
    strip = strips(x, size)
    return np.where(x[:, -1] > 0, strip, size - 1 - strip).astype(np.int32)


def layers(x: Points, size: int) -> Ranks:
    """Layers by the distance from height zero: the last rank is far from any contact there."""
    return parts(np.abs(x[:, -1]), size)


def scattered(x: Points, size: int) -> Ranks:
    """Each cell anywhere: nodes of a surface belong to ranks that have no facet of it."""
    return np.random.default_rng(1).integers(size, size=len(x), dtype=np.int32)


def shifted(x: Points, size: int) -> Ranks:
    """Strips of one width along the first axis, in the lower body shifted by half of it."""
    low, high = x[:, 0].min(), x[:, 0].max()
    place = size * (x[:, 0] - low) / (high - low)
    return np.clip(place + np.where(x[:, -1] > 0, 0.0, 0.5), 0, size - 1).astype(np.int32)


CUSTOM: dict[str, Callable[[Points, int], Ranks]] = {
    function.__name__: function for function in (first, bodies, opposed, layers, scattered, shifted)
}
# That of DOLFINx, without and with ghost cells, and one that shares out what is at height zero
DEFAULT, GHOSTED, SHARED = "default", "ghosted", "shared"


@contextmanager
def partitioned(name: str) -> Iterator[None]:
    """Distribute all meshes made inside as a partition of this name has it."""
    before = build.model_to_mesh
    build.model_to_mesh = partial(_distributed, name)
    try:
        yield
    finally:
        build.model_to_mesh = before


def _distributed(
    name: str, model: Any, comm: Any, rank: int, gdim: int, partitioner: Any = None
) -> MeshData:
    if name == GHOSTED and comm.size > 1:
        partitioner = mesh.create_cell_partitioner(mesh.GhostMode.shared_facet, 2)
    elif name in (SHARED, *CUSTOM) and comm.size > 1:
        x = extract_geometry(model)[:, :gdim] if comm.rank == rank else np.zeros((0, gdim))
        if name == SHARED:
            partitioner = cx.partitioner(x, lambda x: np.abs(x[-1]) < 1e-9)
        else:
            partitioner = by_middles(CUSTOM[name], x)
    elif name not in (DEFAULT, GHOSTED, SHARED, *CUSTOM):
        raise ValueError(f"no partition {name}")
    return model_to_mesh(model, comm, rank, gdim=gdim, partitioner=partitioner)
