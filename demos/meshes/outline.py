# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Plane bodies by their outline: polygons with rounded corners, meshed with triangles."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np
import numpy.typing as npt

from meshes.tags import Tag

Points = npt.NDArray[np.float64]


@dataclass
class Outline:
    """A closed polygon, counterclockwise, with rounded corners.

    Attributes:
        points: Corners, lengths, shape (n, 2).
        radii: Radius of each corner, a length, shape (n,); 0 for a sharp one.
        edges: Tag of the edge from each corner to the next, shape (n,); None for no tag. A round
            corner belongs to the edges before and after it: the tag of the first that has one.
        sizes: Cell size at each corner, a length, shape (n,).
    """

    points: Sequence[tuple[float, float]]
    radii: Sequence[float]
    edges: Sequence[Tag | None]
    sizes: Sequence[float]
    _lines: dict[Tag, list[int]] = field(default_factory=dict)

    def add(self, gmsh: ModuleType, body: Tag) -> int:
        """Draw the body and tag it and its edges.

        Args:
            gmsh: The gmsh module with its current model.
            body: Tag of the body's cells.

        Returns:
            The gmsh tag of the body, an entity of dimension 2.
        """
        geo = gmsh.model.geo
        p = np.asarray(self.points, dtype=np.float64)
        n = len(p)
        corners = [_rounded(p[i - 1], p[i], p[(i + 1) % n], self.radii[i]) for i in range(n)]
        loop: list[int] = []
        first = last = geo.addPoint(*corners[0][0], 0, self.sizes[0])
        for i, (_, centre, end) in enumerate(corners):
            if self.radii[i] > 0:
                begin, last = last, geo.addPoint(*end, 0, self.sizes[i])
                loop.append(geo.addCircleArc(begin, geo.addPoint(*centre, 0), last))
                before, after = self.edges[i - 1], self.edges[i]
                self._keep(after if before is None else before, loop[-1])
            following = corners[(i + 1) % n][0]
            # Two round corners may take up all of an edge
            if np.linalg.norm(following - end) > 1e-9 * np.ptp(p):
                begin, last = last, first
                if i + 1 < n:
                    last = geo.addPoint(*following, 0, self.sizes[i + 1])
                loop.append(geo.addLine(begin, last))
                self._keep(self.edges[i], loop[-1])
        surface = int(geo.addPlaneSurface([geo.addCurveLoop(loop)]))
        geo.synchronize()
        group(gmsh, surface, body, self._lines)
        return surface

    def _keep(self, tag: Tag | None, line: int) -> None:
        if tag is not None:
            self._lines.setdefault(tag, []).append(line)


def group(gmsh: ModuleType, surface: int, body: Tag, lines: Mapping[Tag, Sequence[int]]) -> None:
    """Make physical groups of a plane body and of its edges.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        surface: The gmsh tag of the body.
        body: Tag of the body's cells.
        lines: The gmsh tags of the edges by the tag of their facets.
    """
    gmsh.model.addPhysicalGroup(2, [surface], int(body), name=body.name.lower())
    for tag, curves in lines.items():
        gmsh.model.addPhysicalGroup(1, list(curves), int(tag), name=tag.name.lower())


# Options of gmsh with which cell sizes follow those of the points
POINT_SIZES = {"Mesh.MeshSizeFromPoints": 1.0, "Mesh.MeshSizeExtendFromBoundary": 1.0}


def _rounded(before: Points, corner: Points, after: Points, radius: float) -> Sequence[Points]:
    """Begin, centre and end of the arc that rounds a corner."""
    if radius == 0:
        return corner, corner, corner
    to, on = before - corner, after - corner
    to, on = to / np.linalg.norm(to), on / np.linalg.norm(on)
    half = math.acos(float(np.clip(to @ on, -1, 1))) / 2
    tangent = radius / math.tan(half)
    middle = (to + on) / np.linalg.norm(to + on)
    return corner + tangent * to, corner + radius / math.sin(half) * middle, corner + tangent * on
