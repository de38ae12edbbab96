# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is near the slave of a contact: gaps, normals and slip on deformed facets, by the judge.

A node is measured at the closest point of a facet of the master, or of an obstacle. By
surface-to-surface points of the slave's facets are, along the normals of these.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields

import numpy as np

from dolfinx import mesh

from stress import faces
from stress.faces import Array, Numbers

# Parts of a facet: how far beside it a node may be and still be measured on it, or where its pair
# was kept so that it ends; how deep such a pair may hide that the node lies in the next facet
_BESIDE, _KEPT, _HIDDEN = 0.06, 3.0, 0.04
# How far off facets are in front of points, in sizes of the larger facets
_FRONT = 1.0
# Part of the largest cosine by which facets there oppose a facet of the slave, from which on others
# count, too, and how near they do anyway, in sizes of that facet
_OPPOSED, _AT_EDGE = 0.4, 0.5
# Part of a normal at a corner that rounding of what touches there may add
_TILT = 1e-6
# Rounding of local coordinates
_EPS = 1e-9
# Steps of differences, in sizes of the slave's facets: of first ones, so short that curvature may
# jump, and of second ones
_STEP, _TWICE = 1e-7, 1e-3


@dataclass(frozen=True)
class Obstacle:
    """A rigid obstacle that moves without turning.

    Attributes:
        level: Function of points that is zero on it and negative inside, where it is now, shape
            (n, dim) to (n,).
        at: Where one of its points is now, shape (dim,).
    """

    level: Callable[[Array], Array]
    at: Callable[[], Array]

    def measure(self, x: Array, step: float) -> tuple[Array, Array]:
        """Distances to first order and outward unit normals, by differences over a step."""
        slope = _slope(self.level, x, step)
        length = np.linalg.norm(slope, axis=1)
        length = np.where(length > 0, length, 1.0)
        return self.level(x) / length, slope / length[:, None]

    def slope(self, x: Array, step: float) -> Array:
        """Derivatives of these distances, shape (n, dim)."""
        return _slope(lambda y: self.measure(y, step)[0], x, step)


@dataclass(frozen=True)
class Contact:
    """What may touch what, and how.

    Attributes:
        tags: Tags of facets.
        slave: Those of the slave.
        master: Those of the master, or an obstacle.
        friction: Coefficient.
        is_mean: Whether gaps are means over facets.
        is_finite: Whether gaps are measured on the deformed facets, not along fixed directions.
        offset: Length that gaps are smaller by.
        reported: Multipliers that were reported: nodes, and force over area, shape (n,) or
            (n, dim).
        into: How far a node may lie in the other body, over the size of the bodies; not looked for
            if None.
    """

    tags: mesh.MeshTags
    slave: Sequence[int]
    master: Sequence[int] | Obstacle
    friction: float
    is_mean: bool
    is_finite: bool
    offset: Callable[[], float]
    reported: Callable[[], tuple[Numbers, Array]]
    into: float | None = None


@dataclass
class Near:
    """Points of the slave and what is near them, a row for each pair of these.

    Attributes:
        point: Numbers of the points.
        facet: Facets of the master; 0 of an obstacle.
        weights: Of the nodes of that facet where the point is measured, shape (n, k).
        normal: Outward unit normal of the master, shape (n, dim).
        gap: Along it, or along the slave's; less the offset.
        before: The same at the start of the step; infinite where nothing was in front.
        slip: Along the surface, since then, shape (n, dim).
        apart: Length that a small change of the normal changes the gap by.
        beyond: How far the facet's edges are, in facets; negative within.
        hidden: Distance from the facet over its size, to first order.
    """

    point: Numbers
    facet: Numbers
    weights: Array
    normal: Array
    gap: Array
    before: Array
    slip: Array
    apart: Array
    beyond: Array
    hidden: Array

    def __getitem__(self, rows: Array) -> Near:
        """Some of the rows."""
        return Near(*(getattr(self, field.name)[rows] for field in fields(self)))


class Measure:
    """Measures a contact.

    Attributes:
        points: Nodes of the slave, or points of its facets.
        parts: Part of its facet that each point stands for, shape (n,).
        facet: Facet of the slave of each point of facets.
        own: Outward unit normals of the slave at its points, when it was last measured.
        corners: The same at the corners of its facets, shape (m, k, dim).
        edge: Facets of the slave on its edges, whose normals are not those of what they touch.
        ahead: For points on such facets, the number of the facet and the normal of what their own
            normals meet, when it was last measured, shapes (n,) and (n, dim).
    """

    own: Array
    corners: Array
    ahead: tuple[Numbers, Array]

    def __init__(self, contact: Contact, slave: Numbers, master: Numbers | None, x: Array):
        """Find the points.

        Args:
            contact: The contact.
            slave: Nodes of the slave's facets, shape (m, k).
            master: Those of the master; None for an obstacle.
            x: Positions of the nodes before deformation, shape (n, dim).
        """
        self._contact, self._slave, self._master, self._x0 = contact, slave, master, x
        self.edge = np.isin(slave, faces.edges(slave, x)).any(axis=1)
        nodes, k = np.unique(slave), slave.shape[1]
        if contact.is_mean:
            other = slave if master is None else master
            ratio = faces.sizes(x[slave]).max() / np.median(faces.sizes(x[other]))
            xi, parts = faces.lattice(k, int(np.ceil(ratio)))
            self.facet = np.repeat(np.arange(len(slave)), len(xi))
            self._xi = np.tile(xi, (len(slave), 1))
            self.parts = np.tile(parts, len(slave))
            self.points = faces.Points(slave[self.facet], faces.shapes(self._xi, k)[0])
        else:
            self.facet, self.parts = np.zeros(len(nodes), dtype=np.int64), np.ones(len(nodes))
            self.points = faces.Points(nodes[:, None], np.ones((len(nodes), 1)))
        self._at = contact.master.at() if isinstance(contact.master, Obstacle) else np.zeros(0)
        self._reference: Near | None = None
        self.ahead = (np.zeros(0, dtype=np.int64), np.zeros((0, x.shape[1])))

    def accept(self) -> None:
        """The next step starts here."""
        if isinstance(self._contact.master, Obstacle):
            self._at = self._contact.master.at()

    def __call__(self, x: Array, start: Array) -> Near:
        """Measure.

        Args:
            x: Positions of the nodes, shape (n, dim).
            start: Those at the start of the step.
        """
        finite = self._contact.is_finite
        self._find_normals(x if finite else self._x0)
        if isinstance(self._contact.master, Obstacle):
            near = self._obstacle(self._contact.master, x, start)
        elif finite:
            near = self._facets(x)
            self._slipped(near, x, start)
        else:
            if self._reference is None:
                self._reference = self._facets(self._x0)
            near = self._fixed_directions(self._reference, x, start)
        return near

    def _find_normals(self, x: Array) -> None:
        self.corners = faces.corner_normals(x[self._slave])
        if self._contact.is_mean:
            self.own = faces.normals(x[self._slave][self.facet], self._xi)
            return
        total = np.zeros_like(x)
        np.add.at(total, self._slave, self.corners)
        total = total[self.points.nodes[:, 0]]
        size = np.linalg.norm(total, axis=1, keepdims=True)
        self.own = total / np.where(size > 0, size, 1.0)

    def _obstacle(self, obstacle: Obstacle, x: Array, start: Array) -> Near:
        at, then = self.points.at(x), self.points.at(start)
        n, size = len(at), float(faces.sizes(x[self._slave]).min())
        moved, offset = obstacle.at() - self._at, self._contact.offset()
        if self._contact.is_finite:
            gap, normal = obstacle.measure(at, _STEP * size)
            before = obstacle.measure(then + moved, _STEP * size)[0]
        else:
            X = self.points.at(self._x0)
            gap, normal = obstacle.measure(X, _TWICE * size)
            slope = obstacle.slope(X, _TWICE * size)
            before = gap + (slope * (then - X)).sum(axis=1)
            gap = gap + (slope * (at - X)).sum(axis=1)
        none = np.zeros(n)
        near = Near(
            np.arange(n),
            np.zeros(n, dtype=np.int64),
            np.zeros((n, 0)),
            normal,
            gap - offset,
            before - offset,
            _along(at - then - moved, normal),
            np.abs(gap),
            none - 0.5,
            none,
        )
        return near[(self.own * normal).sum(axis=1) < 0]

    def _facets(self, x: Array) -> Near:
        """Facets of the master that face points, and gaps."""
        assert self._master is not None
        mean, finite = self._contact.is_mean, self._contact.is_finite
        points, corners = self.points.at(x), x[self._master]
        size = faces.sizes(corners)
        margin = _EPS if mean else _KEPT if finite else _BESIDE
        if finite:
            longest = np.maximum(size, faces.sizes(x[self._slave]).max())
            far = _FRONT * longest if mean else _HIDDEN * size
            reach = far + abs(self._contact.offset())
            point, facet = faces.pairs(points, corners, reach, margin)
        elif mean:
            point, facet = faces.met(points, self.own, corners)
        else:
            every = np.indices((len(points), len(corners)), dtype=np.int64)
            point, facet = every.reshape(2, -1)
        middle = faces.middles(corners)
        facing = (faces.normals(corners, middle)[facet] * self.own[point]).sum(axis=1) < -_EPS
        point, facet = point[facing], facet[facing]
        k = corners.shape[1]
        if mean:
            edge = np.flatnonzero(self.edge[self.facet[point]])
            met = faces.cast(points[point[edge]], self.own[point[edge]], corners[facet[edge]])[0]
            within = faces.beyond(met, k) <= margin
            edge, met = edge[within], met[within]
            normals = faces.normals(corners[facet[edge]], met)
            self.ahead = self.facet[point[edge]], normals
            ways = self._ways(points, corners, point, facet)[point]
            xi, gap = faces.cast(points[point], ways, corners[facet])
        else:
            xi = faces.project(points[point], corners[facet])
        weights, beyond = faces.shapes(xi, k)[0], faces.beyond(xi, k)
        normal = faces.normals(corners[facet], xi)
        off = points[point] - np.einsum("nk,nkd->nd", weights, corners[facet])
        if not mean:
            gap = (off * normal).sum(axis=1)
        hidden = np.hypot(gap / size[facet], np.maximum(beyond, 0.0))
        gap = gap - self._contact.offset()
        none = np.zeros_like(normal)
        near = Near(
            point, facet, weights, normal, gap, gap.copy(), none, np.abs(gap), beyond, hidden
        )
        near = near[beyond <= margin]
        if mean:
            # The nearest facet along a point's way
            order = np.lexsort((np.abs(near.gap), near.point))
            near = near[order[np.unique(near.point[order], return_index=True)[1]]]
            return self._facing(near, faces.sizes(x[self._slave]), len(x))
        if k > 2:
            return near
        return self._with_corners(near, points, x) if finite else self._with_vertices(near, x)

    def _facing(self, near: Near, sizes: Array, n: int) -> Near:
        """Without what opposes a facet far less than the best there and beside it.

        Behind an edge of the master are its sides, far off.
        """
        facet = self.facet[near.point]
        against = -(near.normal * self.own[near.point]).sum(axis=1)
        best = np.zeros(n)
        np.maximum.at(best, self._slave[facet], against[:, None])
        opposed = against >= _OPPOSED * best[self._slave].max(axis=1)[facet]
        return near[opposed | self.edge[facet] | (np.abs(near.gap) <= _AT_EDGE * sizes[facet])]

    def _ways(self, points: Array, corners: Array, point: Numbers, facet: Numbers) -> Array:
        """Directions along which points of facets are measured.

        On edges of the slave it is that of the master's facets that are nearest.
        """
        ways = self.own.copy()
        edge = self.edge[self.facet] & self._contact.is_finite
        rows = np.flatnonzero(edge[point])
        if len(rows) == 0:
            return ways
        xi = faces.project(points[point[rows]], corners[facet[rows]])
        within = faces.beyond(xi, corners.shape[1]) <= _BESIDE
        rows, xi = rows[within], xi[within]
        total = np.zeros((len(self._slave), ways.shape[1]))
        normal = faces.normals(corners[facet[rows]], xi)
        N = faces.shapes(xi, corners.shape[1])[0]
        off = points[point[rows]] - np.einsum("nk,nkd->nd", N, corners[facet[rows]])
        distance = np.linalg.norm(off, axis=1)
        order = np.lexsort((distance, point[rows]))
        first = order[np.unique(point[rows][order], return_index=True)[1]]
        np.add.at(total, self.facet[point[rows[first]]], -normal[first])
        size = np.linalg.norm(total, axis=1)
        known = edge & (size[self.facet] > 0)
        ways[known] = (total / np.where(size > 0, size, 1.0)[:, None])[self.facet[known]]
        return ways

    def _with_vertices(self, near: Near, x: Array) -> Near:
        """At an end of a segment a node may have the mean of both normals, too."""
        assert self._master is not None
        normal = np.zeros_like(x)
        np.add.at(normal, self._master, faces.corner_normals(x[self._master]))
        more = near[np.abs(near.beyond) <= _BESIDE]
        end = near.weights[np.abs(near.beyond) <= _BESIDE].argmax(axis=1)
        more.weights = np.eye(2)[end]
        vertex = self._master[more.facet, end]
        more.normal = normal[vertex] / np.linalg.norm(normal[vertex], axis=1, keepdims=True)
        return _joined(near, more)

    def _with_corners(self, near: Near, points: Array, x: Array) -> Near:
        """Beside a corner of segments a node may be measured along any normal in its cone.

        One that touches so has a normal across the way to the corner.
        """
        assert self._master is not None
        corners = x[self._master]
        outward = faces.normals(corners, faces.middles(corners))
        at: dict[int, list[int]] = {}
        for facet, ends in enumerate(self._master.tolist()):
            for end in ends:
                at.setdefault(end, []).append(facet)
        rows, normals, weights, on = [], [], [], []
        for row in np.flatnonzero(np.abs(near.beyond) <= _BESIDE):
            facet = near.facet[row]
            end = near.weights[row].argmax()
            vertex = self._master[facet, end]
            way = points[near.point[row]] - x[vertex]
            beside = float(np.linalg.norm(way))
            if len(at[vertex]) != 2 or not 0 < beside <= _BESIDE * faces.sizes(corners[[facet]])[0]:
                continue
            if abs(np.linalg.det(outward[at[vertex]])) < _TILT:  # Flat: there is no corner
                continue
            across = np.array([-way[1], way[0]]) / beside
            across *= np.sign(across @ outward[at[vertex]].sum(axis=0))
            if (np.linalg.solve(outward[at[vertex]].T, across) >= -_TILT).all():
                # On the corner itself, or on the facet that it is nearest to the front of
                other = max(at[vertex], key=lambda f: float(across @ outward[f]))
                xi = faces.project(points[[near.point[row]]], corners[[other]])
                rows += [row, row]
                normals += [across, across]
                on += [facet, other]
                weights += [np.eye(2)[end], faces.shapes(xi, 2)[0][0]]
        if not rows:
            return near
        more = near[np.array(rows)]
        more.facet, more.weights, more.normal = np.array(on), np.array(weights), np.array(normals)
        more.gap = np.zeros(len(rows)) - self._contact.offset()
        return _joined(near, more)

    def _slipped(self, near: Near, x: Array, start: Array) -> None:
        """Find the gap at the start of the step, and slip since then.

        A node has slipped on the facet that it touches now, a point of a facet on that which was
        in front of it then.
        """
        assert self._master is not None
        if self._contact.friction == 0:
            return
        at, then = self.points.at(x), self.points.at(start)
        if self._contact.is_mean:
            own, corners = self.own, self.corners
            self._find_normals(start)
            first = self._facets(start)
            self.own, self.corners = own, corners
            row = np.full(len(at), -1)
            row[first.point] = np.arange(len(first.point))
            row = row[near.point]
            known = row >= 0
            first, point = first[row[known]], near.point[known]
            moved = at[point] - np.einsum("nk,nkd->nd", first.weights, x[self._master][first.facet])
            gap = first.gap + self._contact.offset()
            near.before = np.full(len(row), np.inf)
            near.before[known] = first.gap
            near.slip[known] = _along(moved + gap[:, None] * own[point], own[point])
            return
        before, now = start[self._master][near.facet], x[self._master][near.facet]
        xi, k = faces.project(then[near.point], before), now.shape[1]
        weights = faces.shapes(xi, k)[0]
        gap = then[near.point] - np.einsum("nk,nkd->nd", weights, before)
        gap = (gap * faces.normals(before, xi)).sum(axis=1)
        moved = at[near.point] - np.einsum("nk,nkd->nd", weights, now)
        moved -= gap[:, None] * faces.normals(now, xi)
        near.before = gap - self._contact.offset()
        near.slip = _along(moved, near.normal)

    def _fixed_directions(self, near: Near, x: Array, start: Array) -> Near:
        """Gaps and slip along directions of the reference configuration."""
        assert self._master is not None
        nodes, offset = self._master[near.facet], self._contact.offset()

        def apart(y: Array) -> Array:
            off = self.points.at(y)[near.point] - np.einsum("nk,nkd->nd", near.weights, y[nodes])
            return np.asarray(off)

        now, before = apart(x), apart(start)
        return Near(
            near.point,
            near.facet,
            near.weights,
            near.normal,
            (now * near.normal).sum(axis=1) - offset,
            (before * near.normal).sum(axis=1) - offset,
            _along(now - before, near.normal),
            np.linalg.norm(now, axis=1),
            near.beyond,
            near.hidden,
        )


def _joined(near: Near, more: Near) -> Near:
    """The rows of both."""
    both = ([getattr(n, field.name) for n in (near, more)] for field in fields(near))
    return Near(*(np.concatenate(pair) for pair in both))


def _slope(value: Callable[[Array], Array], x: Array, step: float) -> Array:
    """Derivatives of a function of points, by differences of fourth order, shape (n, dim)."""
    rows = []
    for way in step * np.eye(x.shape[1]):
        near, far = (value(x + k * way) - value(x - k * way) for k in (1, 2))
        rows.append((8 * near - far) / (12 * step))
    return np.stack(rows, axis=1)


def _along(vectors: Array, normal: Array) -> Array:
    """Parts of vectors beside normals."""
    return np.asarray(vectors - (vectors * normal).sum(axis=1, keepdims=True) * normal)
