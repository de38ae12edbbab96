# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which ranks have facets within reach."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.geometry.facets import corner_normals
from contactx.parallel.halo import Halo
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]

_ROUNDING = 1e-9


class Reach:
    """Boxes of the ranks' facets, and cones around their normals; all ranks make it together."""

    def __init__(self, halo: Halo, own: FacetList, x: Array):
        """Exchange the boxes.

        Args:
            halo: Nodes of this rank.
            own: Facets of this rank.
            x: Positions of all nodes, shape (num_nodes, gdim).
        """
        comm, g = halo.comm, halo.gdim
        mine = np.full(3 * g + 1, np.inf)
        if len(own.nodes) > 0:
            points = x[own.nodes]
            axis, sine = _cone(own, x)
            mine = np.concatenate([points.min(axis=0), points.max(axis=0), axis, [sine]])
        every = np.empty((comm.size, len(mine)))
        comm.Allgather(mine, every)
        self._low, self._high = every[:, :g], every[:, g : 2 * g]
        self._axis, self._sine = every[:, 2 * g : 3 * g], every[:, 3 * g]
        self._there = np.isfinite(self._low).all(axis=1)
        self._slack = _ROUNDING * np.abs(every[self._there][:, : 2 * g]).max(initial=0.0)

    def from_points(
        self, points: Array, normals: Array, bound: Array
    ) -> tuple[npt.NDArray[np.int64], Array]:
        """Distances from points to the boxes of ranks that may matter.

        Args:
            points: Points, shape (n, gdim).
            normals: Normals there that facets must oppose, or zero, shape (n, gdim).
            bound: Largest distance that matters to each point, shape (n,).

        Returns:
            Ranks, shape (k,), and distances, rounded down, infinite where no facet of theirs
            matters, shape (n, k).
        """
        ranks = np.flatnonzero(self._there) if len(points) > 0 else np.zeros(0, dtype=np.int64)
        if len(ranks) > 0:
            low, high = points.min(axis=0), points.max(axis=0)
            off = np.maximum(np.maximum(self._low[ranks] - high, low - self._high[ranks]), 0)
            ranks = ranks[np.linalg.norm(off, axis=1) - self._slack <= bound.max()]
        distance = np.full((len(points), len(ranks)), np.inf)
        any_normal = ~normals.any(axis=1)
        for column, rank in enumerate(ranks):
            off = np.maximum(np.maximum(self._low[rank] - points, points - self._high[rank]), 0)
            d = np.maximum(np.linalg.norm(off, axis=1) - self._slack, 0)
            faces = normals @ self._axis[rank] < self._sine[rank]
            matters = (d <= bound) & (faces | any_normal)
            distance[matters, column] = d[matters]
        return ranks, distance

    def from_facets(
        self, x: Array, slave: FacetList, reach: float, margin: float
    ) -> npt.NDArray[np.bool_]:
        """Whether boxes may meet the prisms over slave facets, shape (num_facets, num_ranks).

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            slave: Slave facets.
            reach: Half the height of the prisms.
            margin: By which part they are wider than the facets.
        """
        near = np.zeros((len(slave.offsets) - 1, len(self._low)), dtype=bool)
        for which, nodes in slave.groups():
            corners = x[nodes]
            middle = corners.mean(axis=1)
            normal = corner_normals(corners).mean(axis=1)
            normal /= np.linalg.norm(normal, axis=1, keepdims=True)
            wide = 2 * (1 + margin) * np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
            for rank in np.flatnonzero(self._there):
                centre = (self._low[rank] + self._high[rank]) / 2 - middle
                half = (self._high[rank] - self._low[rank]) / 2 + self._slack
                height = np.abs(np.einsum("ij,ij->i", normal, centre))
                meets = height <= np.abs(normal) @ half + reach + wide
                # Beside the prism: the distance from its axis
                along = np.einsum("ij,ij->i", normal, centre)[:, None] * normal
                beside = np.linalg.norm(centre - along, axis=1)
                meets &= beside <= np.linalg.norm(half) + wide
                near[which, rank] = meets | ~np.isfinite(height)
        return near


def _cone(facets: FacetList, x: Array) -> tuple[Array, float]:
    """Axis and sine of half the angle of a cone around the facets' normals.

    Normals within a facet are positive combinations of those at its corners.
    """
    corners = [corner_normals(x[nodes]).reshape(-1, x.shape[1]) for _, nodes in facets.groups()]
    normals = np.concatenate(corners)
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, size, out=np.zeros_like(normals), where=size > 0)
    axis = normals.sum(axis=0)
    length = np.linalg.norm(axis)
    if not length > 0:
        return np.zeros(x.shape[1]), 2.0
    axis /= length
    cosine = float((normals @ axis).min())
    # All normals oppose a point's unless its own is within 90 degrees less that angle of the axis
    sine = float(np.sqrt(max(0.0, 1 - cosine**2))) if cosine > 0 else 2.0
    return axis, sine + _ROUNDING
