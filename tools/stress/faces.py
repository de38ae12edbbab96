# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets between the nodes of a displacement, and closest points on them, without contactx.

Facets of a quadratic displacement are split into those between their nodes, which is what contact
of such bodies is enforced on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

import basix
from dolfinx import fem, mesh

from stress import inside

type Array = npt.NDArray[np.float64]
type Numbers = npt.NDArray[np.int64]

# Iterations of Newton's method on bilinear facets: more than any that is not folded takes
_ITERATIONS = 25
# The same for lines that meet them, which are nearly normal to them
_CASTS = 6
# Points that are compared with all facets at once, and what lies on the edge of a ball
_ROWS, _CLOSE = 256, 1e-6
# No mesh of a smooth surface has facets of a node that meet at a larger angle
_EDGE = np.cos(np.radians(50))


def vertex_nodes(V: fem.FunctionSpace) -> Numbers:
    """Node of V at each vertex of a mesh of order 1, shape (num_vertices,)."""
    vertices = V.mesh.geometry.dofmaps[0]
    nodes = np.empty(len(V.mesh.geometry.x), dtype=np.int64)
    # Vertices come first among the dofs of a cell
    nodes[vertices.ravel()] = V.dofmap.list[:, : vertices.shape[1]].ravel()
    return nodes


def surface(V: fem.FunctionSpace, tags: mesh.MeshTags, values: Sequence[int]) -> Numbers:
    """Nodes of the facets of tagged faces, oriented outwards, shape (m, k)."""
    facets = np.concatenate([tags.find(value) for value in values])
    return split(vertex_nodes(V)[inside.outwards(V.mesh, facets)], V)


def body(V: fem.FunctionSpace, tags: mesh.MeshTags, value: int) -> Numbers:
    """The same of the whole boundary of the body that a tagged face belongs to."""
    return split(vertex_nodes(V)[inside.boundary(V.mesh, tags, value)], V)


def split(parts: Numbers, V: fem.FunctionSpace) -> Numbers:
    """Facets between all nodes, of facets between vertices.

    Args:
        parts: Nodes of V at the vertices of segments, triangles or quadrilaterals, shape (m, k).
        V: Space of the displacement.

    Returns:
        The same for degree 1, else twice or four times as many facets.
    """
    if V.ufl_element().degree == 1:
        return parts
    cell, dofs = V.mesh.basix_cell(), V.dofmap.list
    number: dict[tuple[int, ...], int] = {}
    element = basix.create_element(basix.ElementFamily.P, cell, 2, basix.LagrangeVariant.gll_warped)
    for entities, own in zip(basix.topology(cell), element.entity_dofs, strict=True):
        for vertices, (dof, *_) in zip(entities, [d or [-1] for d in own], strict=True):
            if dof >= 0:
                ends = np.sort(dofs[:, vertices], axis=1)
                number |= zip(map(tuple, ends.tolist()), dofs[:, dof].tolist(), strict=True)

    def middle(*columns: int) -> Numbers:
        ends = np.sort(parts[:, list(columns)], axis=1)
        return np.array([number[tuple(row)] for row in ends.tolist()])

    if parts.shape[1] == 2:
        a, b = parts.T
        m = middle(0, 1)
        return np.concatenate([np.stack(s, axis=1) for s in ((a, m), (m, b))])
    if parts.shape[1] == 3:
        a, b, c = parts.T
        ab, bc, ca = middle(0, 1), middle(1, 2), middle(2, 0)
        four = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
        return np.concatenate([np.stack(s, axis=1) for s in four])
    a, b, c, d = parts.T
    ab, ac, bd, cd = middle(0, 1), middle(0, 2), middle(1, 3), middle(2, 3)
    m = middle(0, 1, 2, 3)
    four = ((a, ab, ac, m), (ab, b, m, bd), (ac, m, c, cd), (m, bd, cd, d))
    return np.concatenate([np.stack(s, axis=1) for s in four])


def shapes(xi: Array, k: int) -> tuple[Array, Array]:
    """Shape functions of segments, triangles or quadrilaterals, and their derivatives.

    Args:
        xi: Local coordinates, from 0 to 1 within a facet, shape (n, dim - 1).
        k: Nodes of a facet.

    Returns:
        Arrays of shapes (n, k) and (n, k, dim - 1).
    """
    n, one = len(xi), np.ones(len(xi))
    if k < 4:
        N = np.concatenate([1 - xi.sum(axis=1, keepdims=True), xi], axis=1)
        d = np.concatenate([-np.ones((1, k - 1)), np.eye(k - 1)])
        return N, np.broadcast_to(d, (n, k, k - 1))
    s, t = xi.T
    N = np.stack([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t], axis=1)
    by_s = np.stack([t - 1, 1 - t, -t, t], axis=1)
    by_t = np.stack([s - 1, -s, one - s, s], axis=1)
    return N, np.stack([by_s, by_t], axis=2)


def normals(corners: Array, xi: Array) -> Array:
    """Outward unit normals of facets, each at a point of its own, shape (n, dim)."""
    _, d = shapes(xi, corners.shape[1])
    along = np.einsum("nka,nkd->nad", d, corners)
    if corners.shape[2] == 2:
        normal = np.stack([along[:, 0, 1], -along[:, 0, 0]], axis=1)
    else:
        normal = np.cross(along[:, 0], along[:, 1])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.asarray(normal / np.where(size > 0, size, 1.0))


def project(points: Array, corners: Array) -> Array:
    """Closest points on facets that are extended beyond their edges, shape (n, dim - 1)."""
    n, k, _ = corners.shape
    if k < 4:
        along = corners[:, 1:] - corners[:, :1]
        metric = np.einsum("nad,nbd->nab", along, along)
        right = np.einsum("nad,nd->na", along, points - corners[:, 0])
        return np.asarray(np.linalg.solve(metric, right[..., None])[..., 0])
    # Newton's method from the best of nine points
    starts = np.stack([a.ravel() for a in np.meshgrid([0.0, 0.5, 1.0], [0.0, 0.5, 1.0])], axis=1)
    at = np.einsum("sk,nkd->nsd", shapes(starts, 4)[0], corners)
    xi = starts[np.linalg.norm(at - points[:, None], axis=2).argmin(axis=1)]
    twist = corners[:, 0] - corners[:, 1] - corners[:, 2] + corners[:, 3]
    for _ in range(_ITERATIONS):
        N, d = shapes(xi, 4)
        off = points - np.einsum("nk,nkd->nd", N, corners)
        along = np.einsum("nka,nkd->nad", d, corners)
        matrix = np.einsum("nad,nbd->nab", along, along)
        curved = (off * twist).sum(axis=1)
        convex = curved**2 < 0.5 * matrix[:, 0, 0] * matrix[:, 1, 1]
        matrix[:, 0, 1] -= np.where(convex, curved, 0.0)
        matrix[:, 1, 0] -= np.where(convex, curved, 0.0)
        step = np.linalg.solve(matrix, np.einsum("nad,nd->na", along, off)[..., None])[..., 0]
        xi = np.clip(xi + step, -1.0, 2.0)
        if n == 0 or np.abs(step).max() < 1e-13:
            break
    return np.asarray(xi)


def cast(points: Array, ways: Array, corners: Array) -> tuple[Array, Array]:
    """Where lines through points along unit vectors meet facets that are extended.

    Returns:
        Local coordinates, shape (n, dim - 1), and distances along the vectors, shape (n,).
    """
    n, k, dim = corners.shape
    xi, distance = np.full((n, dim - 1), 1 / 3), np.zeros(n)
    for _ in range(1 if k < 4 else _CASTS):
        N, d = shapes(xi, k)
        off = points + distance[:, None] * ways - np.einsum("nk,nkd->nd", N, corners)
        matrix = np.concatenate([np.einsum("nka,nkd->nda", d, corners), -ways[..., None]], axis=2)
        # Facets that lie along the vector are met nowhere
        size = np.abs(matrix[..., :-1]).max(axis=(1, 2)) ** (dim - 1)
        met = np.abs(np.linalg.det(matrix)) > 1e-6 * size
        matrix[~met] = np.eye(dim)
        step = np.linalg.solve(matrix, off[..., None])[..., 0]
        step[~met] = np.inf if k < 4 else 1.0
        xi, distance = xi + step[:, :-1], distance + step[:, -1]
        if k == 4:
            xi = np.clip(xi, -1.0, 2.0)
        if n == 0 or np.abs(step[met]).max(initial=0.0) < 1e-13:
            break
    return xi, distance


def lattice(k: int, ratio: int) -> tuple[Array, Array]:
    """Points of a facet, its corners among them, and the parts of it that they stand for.

    Args:
        k: Nodes of the facet.
        ratio: How many facets lie in front of one along a line.

    Returns:
        Arrays of shapes (n, dim - 1) and (n,).
    """
    n = min(24 * ratio, 400) if k == 2 else min(6 * ratio, 18)
    s = np.linspace(0, 1, n + 1)
    ends = np.where((s == 0) | (s == 1), 0.5, 1.0)
    if k == 2:
        return s[:, None], ends
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
    xi = np.stack([s[i], s[j]], axis=1)
    if k == 4:
        return xi, ends[i] * ends[j]
    kept = i + j <= n
    # Small triangles around each point: six within, three at a side, one at a corner
    sides = (i == 0).astype(int) + (j == 0) + (i + j == n)
    return xi[kept], np.array([6.0, 3.0, 1.0])[sides[kept]]


def beyond(xi: Array, k: int) -> Array:
    """How far points lie beyond the edges of their facets, in facets; negative within, (n,)."""
    if k == 3:
        xi = np.concatenate([xi, 1 - xi.sum(axis=1, keepdims=True)], axis=1)
        return np.asarray(-xi.min(axis=1))
    return np.asarray(np.maximum(-xi, xi - 1).max(axis=1))


def sizes(corners: Array) -> Array:
    """Longest distance of two nodes of each facet, the same however it is turned, shape (m,)."""
    return np.asarray(np.linalg.norm(corners[:, :, None] - corners[:, None], axis=3).max((1, 2)))


def areas(facets: Numbers, x: Array) -> Array:
    """Integral of each node's shape functions over all facets, shape (num_nodes,)."""
    corners, k = x[facets], facets.shape[1]
    gauss = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3)
    if k == 3:
        points, weights = np.full((1, 2), 1 / 3), [0.5]
    else:
        points = np.stack([a.ravel() for a in np.meshgrid(*[gauss] * (x.shape[1] - 1))], axis=1)
        weights = [1 / len(points)] * len(points)
    total = np.zeros(len(x))
    for xi, weight in zip(points, weights, strict=True):
        N, d = shapes(np.broadcast_to(xi, (len(facets), len(xi))), k)
        along = np.einsum("nka,nkd->nad", d, corners)
        metric = np.einsum("nad,nbd->nab", along, along)
        stretch = np.sqrt(np.linalg.det(metric))
        np.add.at(total, facets, N * (weight * stretch)[:, None])
    return total


def _corner_points(k: int) -> Array:
    return np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])[:k, : 1 if k == 2 else 2]


def corner_normals(corners: Array) -> Array:
    """Unit normals at the corners of facets, shape (m, k, dim)."""
    m, k, _ = corners.shape
    rows = [normals(corners, np.tile(xi, (m, 1))) for xi in _corner_points(k)]
    return np.stack(rows, axis=1)


def middles(facets: Array) -> Array:
    """Local coordinates of the middle of each facet, shape (m, dim - 1)."""
    m, k = facets.shape[:2]
    return np.full((m, 1 if k == 2 else 2), 1 / 3 if k == 3 else 0.5)


def edges(facets: Numbers, x: Array) -> list[int]:
    """Nodes on edges of a surface, by the normals in the middle of its facets."""
    normal = normals(x[facets], middles(facets))
    around: dict[int, list[Array]] = {}
    for facet, own in zip(facets.tolist(), normal, strict=True):
        for node in facet:
            around.setdefault(node, []).append(own)
    return [n for n, rows in around.items() if (np.array(rows) @ np.array(rows).T).min() < _EDGE]


@dataclass
class Points:
    """Points of a surface: its nodes, or points within its facets.

    Attributes:
        nodes: Nodes that each is interpolated from, shape (n, k).
        weights: Their weights, shape (n, k).
    """

    nodes: Numbers
    weights: Array

    def at(self, x: Array) -> Array:
        """Values of a field there, shape (n, dim)."""
        return np.einsum("nk,nkd->nd", self.weights, x[self.nodes])


def pairs(points: Array, corners: Array, reach: Array, margin: float) -> tuple[Numbers, Numbers]:
    """Points and facets that may be near each other.

    Args:
        points: Points, shape (n, dim).
        corners: Facets, shape (m, k, dim).
        reach: How far off a facet a point may be, shape (m,).
        margin: How far beside it, in sizes of the facet.
    """
    middle = corners.mean(axis=1)
    far = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    found = cKDTree(points).query_ball_point(middle, (1 + 2 * margin) * far + reach)
    facet = np.repeat(np.arange(len(corners)), [len(row) for row in found])
    return np.array([p for row in found for p in row], dtype=np.int64), facet


def met(points: Array, ways: Array, corners: Array) -> tuple[Numbers, Numbers]:
    """Points and facets that lines through these may meet, however far off.

    Args:
        points: Points, shape (n, dim).
        ways: Unit directions of the lines, shape (n, dim).
        corners: Facets, shape (m, k, dim).
    """
    middle = corners.mean(axis=1)
    far = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    found = []
    for first in range(0, len(points), _ROWS):
        rows = slice(first, first + _ROWS)
        off = middle - points[rows, None]
        ahead = (off * ways[rows, None]).sum(axis=2)
        beside = (off**2).sum(axis=2) - ahead**2
        point, facet = np.nonzero(beside <= (1 + _CLOSE) * far**2)
        found.append((point + first, facet))
    point, facet = (np.concatenate(rows) for rows in zip(*found, strict=True))
    return point, facet
