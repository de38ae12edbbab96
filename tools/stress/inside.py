# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How deep points lie in a body, from its boundary alone and without contactx."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from dolfinx import mesh

type Array = npt.NDArray[np.float64]
type Facets = npt.NDArray[np.integer]

# Points that are treated at once
_CHUNK = 64
# Parts of each edge that bilinear facets are split into
_SPLIT = 4


def boundary(domain: mesh.Mesh, tags: mesh.MeshTags, connected_to: int) -> Facets:
    """Boundary of the body that a tagged face belongs to, oriented outwards.

    Args:
        domain: Mesh.
        tags: Facet tags.
        connected_to: Tag of the face.

    Returns:
        Nodes of the geometry of its segments, triangles or quadrilaterals, shape (m, k).
    """
    tdim = domain.topology.dim
    for pair in ((tdim - 1, tdim), (tdim, tdim - 1), (tdim, 0), (0, tdim)):
        domain.topology.create_connectivity(*pair)
    to_cell = domain.topology.connectivity(tdim - 1, tdim)
    cells = _body(domain, to_cell.links(tags.find(connected_to)[0])[0])
    facets = mesh.exterior_facet_indices(domain.topology)
    owner = np.array([to_cell.links(f)[0] for f in facets])
    return outwards(domain, facets[cells[owner]])


def outwards(domain: mesh.Mesh, facets: npt.NDArray[np.integer]) -> Facets:
    """Nodes of the geometry of exterior facets, oriented outwards, shape (m, k)."""
    tdim = domain.topology.dim
    domain.topology.create_connectivity(tdim - 1, tdim)
    to_cell = domain.topology.connectivity(tdim - 1, tdim)
    owner = np.array([to_cell.links(f)[0] for f in facets])
    nodes = mesh.entities_to_geometry(domain, tdim - 1, facets)
    x = domain.geometry.x
    middle = x[domain.geometry.dofmaps[0][owner]].mean(axis=1)
    points = x[nodes]
    if tdim == 2:
        along = points[:, 1] - points[:, 0]
        normal = np.stack([along[:, 1], -along[:, 0], 0 * along[:, 0]], axis=1)
    else:
        normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    inwards = np.einsum("ij,ij->i", normal, points.mean(axis=1) - middle) < 0
    parts = nodes.copy()
    # dolfinx numbers a quadrilateral's corners line by line
    other = [1, 0, 3, 2] if parts.shape[1] == 4 else [1, 0, *range(2, parts.shape[1])]
    parts[inwards] = parts[inwards][:, other]
    return parts


def triangles(corners: Array) -> Array:
    """Triangles that bilinear facets are split into, shape (num_triangles, 3, 3)."""
    s = np.linspace(0, 1, _SPLIT + 1)
    grid = (
        corners[:, None, None, 0] * np.outer(1 - s, 1 - s)[..., None]
        + corners[:, None, None, 1] * np.outer(1 - s, s)[..., None]
        + corners[:, None, None, 2] * np.outer(s, 1 - s)[..., None]
        + corners[:, None, None, 3] * np.outer(s, s)[..., None]
    )
    a, b, c, d = grid[:, :-1, :-1], grid[:, :-1, 1:], grid[:, 1:, :-1], grid[:, 1:, 1:]
    halves = [np.stack(t, axis=3).reshape(-1, 3, 3) for t in ((a, b, d), (a, d, c))]
    return np.concatenate(halves)


def _body(domain: mesh.Mesh, seed: int) -> npt.NDArray[np.bool_]:
    """Which cells hang together with one, shape (num_cells,)."""
    tdim = domain.topology.dim
    to_vertex, to_cell = (domain.topology.connectivity(*p) for p in ((tdim, 0), (0, tdim)))
    reached = np.zeros(domain.topology.index_map(tdim).size_local, dtype=bool)
    front = [seed]
    reached[seed] = True
    while front:
        cell = front.pop()
        for vertex in to_vertex.links(cell):
            for other in to_cell.links(vertex):
                if not reached[other]:
                    reached[other] = True
                    front.append(other)
    return reached


def depth(points: Array, x: Array, parts: Facets) -> Array:
    """Distance from the boundary of points inside a body, 0 of those outside.

    Args:
        points: Points, shape (n, gdim).
        x: Positions of the mesh's nodes, shape (num_nodes, gdim).
        parts: Its boundary, oriented outwards, shape (m, k).
    """
    result = np.zeros(len(points))
    corners = x[parts] if parts.shape[1] < 4 else triangles(x[parts])
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    near = np.flatnonzero(((points > low) & (points < high)).all(axis=1))
    turns, distance = (_turns_2d, _distance_2d) if x.shape[1] == 2 else (_turns_3d, _distance_3d)
    for chunk in np.array_split(near, max(1, len(near) // _CHUNK)):
        to = corners[None] - points[chunk][:, None, None]
        inside = turns(to) > 0.5
        result[chunk] = np.where(inside, distance(to), 0.0)
    return result


def _turns_2d(to: Array) -> Array:
    """Winding number, from the vectors to the segments' ends, shape (n, m, 2, 2)."""
    a, b = to[:, :, 0], to[:, :, 1]
    cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return np.arctan2(cross, (a * b).sum(axis=-1)).sum(axis=1) / (2 * np.pi)


def _turns_3d(to: Array) -> Array:
    """Winding number by the solid angles of triangles (Van Oosterom & Strackee 1983)."""
    a, b, c = (to[:, :, i] for i in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=-1) for v in (a, b, c))
    triple = (a * np.cross(b, c)).sum(axis=-1)
    below = la * lb * lc + (a * b).sum(-1) * lc + (b * c).sum(-1) * la + (c * a).sum(-1) * lb
    return 2 * np.arctan2(triple, below).sum(axis=1) / (4 * np.pi)


def _distance_2d(to: Array) -> Array:
    return _to_segment(to[:, :, 0], to[:, :, 1]).min(axis=1)


def _to_segment(a: Array, b: Array) -> Array:
    along = b - a
    square = (along**2).sum(axis=-1)
    share = np.clip(-(a * along).sum(axis=-1) / np.where(square > 0, square, 1), 0, 1)
    return np.linalg.norm(a + share[..., None] * along, axis=-1)


def _distance_3d(to: Array) -> Array:
    a, b, c = (to[:, :, i] for i in range(3))
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=-1)
    normal = normal / np.where(size > 0, size, 1)[..., None]
    height = (a * normal).sum(axis=-1)
    foot = height[..., None] * normal
    over = np.ones_like(height, dtype=bool)
    for p, q in ((a, b), (b, c), (c, a)):
        over &= (np.cross(q - p, foot - p) * normal).sum(axis=-1) >= 0
    edges = np.minimum(np.minimum(_to_segment(a, b), _to_segment(b, c)), _to_segment(c, a))
    return np.where(over, np.abs(height), edges).min(axis=1)
