# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Along what a contact without friction pushes, seen in the deformed faces alone.

A force on a slave node must be along the normal of the face that it touches; on an edge or at a
vertex of the master, within the cone of the normals of all facets there. A node counts as on an
edge where it lies within ``_HIDDEN`` facets of the next facet, or of its plane beside it: by as
much contactx lets a pair hide a penetration. Of bilinear facets the normals at the corners count:
those between are in their cone.

By surface-to-surface a node stands for its facets, along whose normals it is pushed, so that what
is allowed is the largest angle between these and what lies in front of them. At an edge of the
slave no facet has the normal of what touches it: there nothing is allowed.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import nnls

import contactx as cx
from dolfinx import mesh

from stress import inside
from stress.grids import Array, Numbers

# No mesh of a smooth surface has facets of a node that meet at a larger angle
_EDGE = np.cos(np.radians(50))
# What rounding leaves of an angle
_ANGLE = 1e-6
# How far off a facet or its plane is touched, too, how far beside a facet it still counts as in
# front of a point, and how far off facets are in front of a slave facet, at first and where nothing
# is so near; in sizes of facets
_HIDDEN, _BESIDE, _FRONT, _APART = 0.04, 0.05, 0.5, 2.0


def oriented(domain: mesh.Mesh, surface: cx.Surface) -> Numbers:
    """Nodes of the geometry of a surface's facets, oriented outwards, shape (m, k)."""
    tags = surface.facet_tags
    facets = np.concatenate([tags.find(tag) for tag in surface.tags])
    return np.asarray(inside.outwards(domain, facets))


class Directions:
    """Looks at the directions of the forces of a contact of two surfaces."""

    def __init__(self, contact: cx.Contact, domain: mesh.Mesh, node_of: Numbers):
        """Find the facets of both sides.

        Args:
            contact: The contact, by finite sliding and without friction.
            domain: Mesh, of order 1.
            node_of: Node of the displacement at each node of the geometry.
        """
        assert isinstance(contact.master, cx.Surface)
        self._is_mean = contact.method == "surface-to-surface"
        sides = contact.slave, contact.master
        self._slave, self._master = (node_of[oriented(domain, side)] for side in sides)
        self._both = np.intersect1d(self._slave, self._master)

    def __call__(self, x: Array, forces: Array, small: Array) -> float:
        """Largest part of a force beside what is allowed, relative to that.

        Args:
            x: Positions of the nodes, shape (n, dim).
            forces: What pushes each node, shape (n, dim).
            small: Size of each force that is rounding, shape (n,).
        """
        self._x = x
        self._corners, self._normals = x[self._master], normals(x[self._master])
        self._sizes = np.linalg.norm(np.ptp(self._corners, axis=1), axis=1)
        self._own = normals(x[self._slave])
        self._edge = np.isin(self._slave, edges(self._slave, self._own)).any(axis=1)
        self._seen: dict[tuple[int, float], Array] = {}
        size = np.linalg.norm(forces, axis=1)
        worst = 0.0
        for node in np.setdiff1d(self._slave, self._both):
            if size[node] > small[node]:
                allowed, cone = self._of_facets(node) if self._is_mean else self._of_node(node)
                out = beside(forces[node], cone)
                worst = max(worst, out / (small[node] + (allowed + _ANGLE) * size[node]))
        return worst

    def _of_node(self, node: int) -> tuple[float, Array]:
        """Normals of the master's facets that a node touches."""
        near, distance, _ = self._near(self._x[node][None], self._sizes.max())
        if near.size == 0:
            return 0.0, self._flat(near)
        to = self._corners[near].mean(axis=1) - self._x[node]
        height = np.abs((to * self._normals[near].mean(axis=1)).sum(axis=1))
        nearest, h = distance.min(), self._sizes[near]
        hit = distance[0] <= nearest + _HIDDEN * h
        hit |= (distance[0] <= nearest + h) & (np.abs(height - nearest) <= _HIDDEN * h)
        return 0.0, self._flat(near[hit])

    def _of_facets(self, node: int) -> tuple[float, Array]:
        """What is allowed of a node's facets, and normals of the master's in front of them."""
        facets = np.flatnonzero((self._slave == node).any(axis=1)).tolist()
        rows = [self._in_front(f) for f in facets]
        if not any(map(len, rows)):
            # Offsets keep both apart
            rows = [self._in_front(f, _APART) for f in facets]
        allowed = [
            beside(-n, row)
            for f, row in zip(facets, rows, strict=True)
            if len(row) and not self._edge[f]
            for n in self._own[f]
        ]
        # A mean of two directions is shorter than either
        return 1.2 * max(allowed, default=0.0), np.concatenate(rows)

    def _in_front(self, facet: int, front: float = _FRONT) -> Array:
        """Normals of the master's facets in front of a slave facet.

        At an edge a facet is tilted against what it touches, and all that face it count.
        """
        if (facet, front) in self._seen:
            return self._seen[facet, front]
        corners = self._x[self._slave[facet]]
        h = float(np.linalg.norm(np.ptp(corners, axis=0)))
        reach = h * (max(front, 1.0) if self._edge[facet] else front)
        near, distance, over = self._near(_samples(corners), reach)
        hit = distance <= reach
        if self._edge[facet]:
            hit &= self._normals[near].mean(axis=1) @ self._own[facet].mean(axis=0) < 0
        elif near.size:
            nearest = distance.min(axis=1, keepdims=True)
            hit &= distance <= nearest + _HIDDEN * self._sizes[near]
            if (hit & over).any():
                hit &= over
        self._seen[facet, front] = self._flat(near[hit.any(axis=0)])
        return self._seen[facet, front]

    def _near(self, points: Array, reach: float) -> tuple[Numbers, Array, Array]:
        """Master's facets within reach, their distances, and whether points are over them."""
        low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
        near = (self._corners.max(axis=1) >= low) & (self._corners.min(axis=1) <= high)
        numbers = np.flatnonzero(near.all(axis=1))
        return numbers, *_distances(points, self._corners[numbers])

    def _flat(self, facets: Numbers) -> Array:
        return np.asarray(self._normals[facets].reshape(-1, self._x.shape[1]))


def normals(corners: Array) -> Array:
    """Unit normals at the corners of facets, shape (m, k, dim)."""
    if corners.shape[2] == 2:
        along = corners[:, 1] - corners[:, 0]
        normal = np.stack([along[:, 1], -along[:, 0]], axis=1)[:, None].repeat(2, axis=1)
    elif corners.shape[1] == 3:
        a, b, c = np.moveaxis(corners, 1, 0)
        normal = np.cross(b - a, c - a)[:, None].repeat(3, axis=1)
    else:
        a, b, c, d = np.moveaxis(corners, 1, 0)
        ways = [(b - a, c - a), (b - a, d - b), (d - c, c - a), (d - c, d - b)]
        at_corners = np.stack([np.cross(u, v) for u, v in ways], axis=1)
        # It is linear in each direction, and a node may lie beside its facet by as much
        line = np.array([[1 + _BESIDE, -_BESIDE], [-_BESIDE, 1 + _BESIDE]])
        normal = np.einsum("ij,mjd->mid", np.kron(line, line), at_corners)
    return np.asarray(normal / np.linalg.norm(normal, axis=2, keepdims=True))


def edges(facets: Numbers, normal: Array) -> list[int]:
    """Nodes on edges of a surface, by the normals at the corners of its facets."""
    around: dict[int, list[Array]] = {}
    for facet, own in zip(facets.tolist(), normal, strict=True):
        for node, row in zip(facet, own, strict=True):
            around.setdefault(node, []).append(row)
    return [n for n, rows in around.items() if (np.array(rows) @ np.array(rows).T).min() < _EDGE]


def beside(vector: Array, cone: Array) -> float:
    """Distance of a vector from the cone of some directions."""
    if len(cone) == 0:
        return float(np.linalg.norm(vector))
    return float(nnls(np.unique(np.round(cone, 12), axis=0).T, vector)[1])


def _samples(corners: Array) -> Array:
    """Points of a facet, its corners among them."""
    s = np.linspace(0, 1, 9 if len(corners) == 2 else 5)
    if len(corners) == 2:
        weights = np.stack([1 - s, s], axis=1)
    else:
        s, t = (a.ravel() for a in np.meshgrid(s, s))
        if len(corners) == 3:
            s, t = s[s + t <= 1], t[s + t <= 1]
            weights = np.stack([1 - s - t, s, t], axis=1)
        else:
            weights = np.stack([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t], axis=1)
    return np.asarray(weights @ corners)


def _distances(points: Array, corners: Array) -> tuple[Array, Array]:
    """Distances of points from facets, and whether they are over them, shape (n, m)."""
    m = len(corners)
    if corners.shape[2] == 2:
        a, b = (corners[:, k] - points[:, None] for k in range(2))
        along = b - a
        share = -(a * along).sum(axis=-1) / (along**2).sum(axis=-1)
        foot = a + np.clip(share, 0, 1)[..., None] * along
        return np.linalg.norm(foot, axis=-1), np.abs(share - 0.5) <= 0.5 + _BESIDE
    parts = corners if corners.shape[1] == 3 else inside.triangles(corners)
    a, b, c = (parts[:, k] - points[:, None] for k in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    height = (a * normal).sum(axis=-1)
    foot = height[..., None] * normal
    over = np.ones_like(height, dtype=bool)
    sides = []
    for p, q in ((a, b), (b, c), (c, a)):
        along = q - p
        square = (along**2).sum(axis=-1)
        over &= (np.cross(along, foot - p) * normal).sum(axis=-1) >= -_BESIDE * square
        share = np.clip(-(p * along).sum(axis=-1) / square, 0, 1)
        sides.append(np.linalg.norm(p + share[..., None] * along, axis=-1))
    distance = np.where(over, np.abs(height), np.min(sides, axis=0))
    if len(parts) > m:
        # Two halves of each of the parts of a facet
        distance, over = (v.reshape(len(points), 2, m, -1) for v in (distance, over))
        return distance.min(axis=(1, 3)), over.any(axis=(1, 3))
    return distance, over
