# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of grids that ``demos/meshes`` does not have, and tags of their faces."""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
from dolfinx import mesh

type Part = tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]
type Facets = npt.NDArray[np.int32]


def grid(low: Sequence[float], high: Sequence[float], n: Sequence[int]) -> Part:
    """Nodes and cells of a box: corners, and numbers of cells along the axes."""
    gdim = len(n)
    axes = [np.linspace(a, b, k + 1) for a, b, k in zip(low, high, n, strict=True)]
    x = np.stack([a.ravel() for a in np.meshgrid(*axes, indexing="ij")], axis=1)
    number = np.arange(len(x)).reshape([k + 1 for k in n])
    # Numbers of the corners of a cell run along the first axis first
    corners = np.stack(np.meshgrid(*[[0, 1]] * gdim, indexing="ij"), -1).reshape(-1, gdim)[:, ::-1]
    origins = np.stack([a.ravel() for a in np.meshgrid(*map(range, n), indexing="ij")], 1)
    return x, number[tuple((origins[:, None] + corners[None]).transpose(2, 0, 1))]


def create(*parts: Part) -> mesh.Mesh:
    """A mesh of quadrilaterals or hexahedra in parts that are apart."""
    first = np.cumsum([0, *(len(x) for x, _ in parts)])
    x = np.concatenate([x for x, _ in parts])
    cells = np.concatenate([cells + first[k] for k, (_, cells) in enumerate(parts)])
    gdim = x.shape[1]
    kind = "quadrilateral" if gdim == 2 else "hexahedron"
    element = basix.ufl.element("Lagrange", kind, 1, shape=(gdim,))
    mine = slice(None if MPI.COMM_WORLD.rank == 0 else 0)
    return mesh.create_mesh(MPI.COMM_WORLD, cells[mine], element, x[mine])


def outside(domain: mesh.Mesh) -> Facets:
    """All outer facets."""
    domain.topology.create_connectivity(domain.topology.dim - 1, domain.topology.dim)
    return mesh.exterior_facet_indices(domain.topology)


def middles(domain: mesh.Mesh, facets: Facets) -> tuple[np.ndarray, np.ndarray]:
    """Middles of facets, and of the cells that they belong to, shape (n, gdim)."""
    dim = domain.topology.dim
    cells = domain.topology.connectivity(dim - 1, dim)
    of_facet = np.array([cells.links(f)[0] for f in facets], dtype=np.int32)
    return (
        mesh.compute_midpoints(domain, dim - 1, facets)[:, :dim],
        mesh.compute_midpoints(domain, dim, of_facet)[:, :dim],
    )


def tagged(domain: mesh.Mesh, facets: Facets) -> mesh.MeshTags:
    """Tags of facets, all of them 1."""
    ones = np.ones(len(facets), dtype=np.int32)
    return mesh.meshtags(domain, domain.topology.dim - 1, np.sort(facets), ones)


def chosen(domain: mesh.Mesh, facets: Facets, values: npt.ArrayLike) -> mesh.MeshTags:
    """Tags of facets by their values, without those of 0."""
    values = np.asarray(values, dtype=np.int32)
    return mesh.meshtags(domain, domain.topology.dim - 1, facets[values > 0], values[values > 0])


def faces(domain: mesh.Mesh, places: Sequence[tuple[int, float]]) -> mesh.MeshTags:
    """Tags of faces across the axes of a box, 1, 2, ... in the order of their places.

    Args:
        places: Axis and coordinate of each face.
    """
    dim = domain.topology.dim
    marked = [
        mesh.locate_entities_boundary(domain, dim - 1, lambda x, i=i, at=at: np.isclose(x[i], at))
        for i, at in places
    ]
    facets = np.concatenate(marked)
    order = np.argsort(facets)
    values = np.repeat(np.arange(1, len(marked) + 1, dtype=np.int32), [len(f) for f in marked])
    return mesh.meshtags(domain, dim - 1, facets[order], values[order])
