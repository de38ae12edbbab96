# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A look at a surface from points of any rank, which changes nothing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.search.reach import Reach
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Seen:
    """What points see of a surface, a row a point.

    Attributes:
        distance: Distance to the nearest facet, infinite without one.
        gap: Height over it, NaN where the point is beside the surface.
        height: The same before points and facets moved, where that is given.
        inside: Whether the point is above or below the facet, not beside its edges.
        margin: How far the point is from the surface's outer edge, as a part of the facet.
        way: How far the point has moved relatively to the facet since, where that is given.
        values: Values of the facet, shape (n, k).
    """

    distance: Array
    gap: Array
    height: Array
    inside: npt.NDArray[np.bool_]
    margin: Array
    way: Array
    values: Array


class Onlooker:
    """Finds the nearest facet of a surface, of which each rank may have a part.

    A search for pairs adds what it finds to the halo; this does not, so that it may come after a
    solve.

    Attributes:
        num_facets: Number of facets of this rank.
    """

    def __init__(self, halo: Halo, facets: FacetList):
        """Take the facets.

        Args:
            halo: Nodes of this rank.
            facets: Facets of the surface that this rank has; several may have the same one.
        """
        self._halo, self._facets = halo, facets
        self.num_facets = len(facets.offsets) - 1
        self._finder = core.Finder(facets.offsets, facets.nodes, halo.gdim)

    def look(
        self,
        x: Array,
        points: Array,
        normals: Array,
        reach: float,
        values: Array,
        ways: tuple[Array, Array] | None = None,
    ) -> Seen:
        """Look from points; all ranks must take part.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            points: Points, shape (n, gdim).
            normals: Outward normals there that facets must oppose, or zero, shape (n, gdim).
            reach: Largest distance, the same on all ranks.
            values: Values of this rank's facets, shape (num_facets, k).
            ways: Displacements of all nodes and of the points since; gaps then are linear in them,
                as in small sliding.
        """
        n, gdim = points.shape
        best = Seen(
            np.full(n, np.inf),
            np.full(n, np.nan),
            np.full(n, np.nan),
            np.zeros(n, dtype=bool),
            np.ones(n),
            np.zeros(n),
            np.zeros((n, values.shape[1])),
        )
        ranks, distance = Reach(self._halo, self._facets, x).from_points(
            points, normals, np.full(n, reach)
        )
        nodal, own = ways or (np.zeros((0, gdim)), np.zeros((n, gdim)))
        asked = {
            int(r): np.flatnonzero(np.isfinite(d)) for r, d in zip(ranks, distance.T, strict=True)
        }
        exchange = self._halo.exchange
        questions = exchange({r: (points[w], normals[w], own[w]) for r, w in asked.items()})
        answers = exchange(
            {r: self._answer(x, q, reach, values, nodal) for r, q in questions.items()}
        )
        # By rank, so that of facets as near the same one is taken in every run
        for rank in sorted(answers):
            seen, which = answers[rank], asked[rank]
            nearer = seen.distance < best.distance[which]
            for name, part in vars(best).items():
                part[which[nearer]] = getattr(seen, name)[nearer]
        return best

    def _answer(
        self,
        x: Array,
        question: tuple[Array, Array, Array],
        reach: float,
        values: Array,
        nodal: Array,
    ) -> Seen:
        """What this rank's facets are to points, with their normals and their ways."""
        points, normals, own = question
        found = self._finder.find(x, points, normals, np.full(len(points), reach))
        facet = found["facet"]
        has = facet >= 0
        gap = height = np.where(has, found["gap"], np.nan)
        way = np.zeros_like(points)
        if len(nodal) > 0:
            way = self._ways(found, own, nodal)
            normal = found["normal"][:, : points.shape[1]]
            gap = gap + np.einsum("ij,ij->i", normal, way)
        rows = np.zeros((len(points), values.shape[1]))
        rows[has] = values[facet[has]]
        inside = has & (found["feature"] == 0)
        margin = self._finder.outer_margins(facet, found["xi"])
        length = np.linalg.norm(way, axis=1)
        return Seen(found["distance"], gap, height, inside, margin, length, rows)

    def _ways(self, found: dict[str, npt.NDArray[Any]], own: Array, nodal: Array) -> Array:
        """How far points move relatively to their facets, shape (n, gdim)."""
        way = own.copy()
        facets, facet = self._facets, found["facet"]
        sizes = np.zeros(len(facet), dtype=np.int32)
        has = facet >= 0
        sizes[has] = np.diff(facets.offsets)[facet[has]]
        for size in np.unique(sizes[has]):
            which = np.flatnonzero(sizes == size)
            nodes = facets.nodes[facets.offsets[facet[which]][:, None] + np.arange(size)]
            N = core.shape_functions(int(size), found["xi"][which])
            way[which] -= np.einsum("ij,ijk->ik", N, nodal[nodes])
        return way
