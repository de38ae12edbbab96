# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Boxes whose bottom is bent to a part of a sphere, or of a circle in the plane."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import ModuleType

import numpy as np

from meshes.grids import Coordinates


@dataclass(frozen=True)
class Bottom:
    """The bottom of a box, bent upward about a vertical axis; the last coordinate is the height.

    Attributes:
        axis: Horizontal place of the axis, shape (dim - 1,).
        height: Height of the bottom at the axis.
        length: Height of the box, whose top stays flat.
        radius: Radius of the sphere or circle, a length.
    """

    axis: Sequence[float]
    height: float
    length: float
    radius: float

    def bend(self, x: Coordinates) -> Coordinates:
        """Lift points of the box, the less the nearer they are to its top.

        Args:
            x: Positions, shape (3, n).

        Returns:
            The new positions, shape (3, n).
        """
        dim = len(self.axis) + 1
        away = x[: dim - 1] - np.reshape(self.axis, (-1, 1))
        rise = self.radius - np.sqrt(self.radius**2 - np.sum(away**2, axis=0))
        moved = x.copy()
        moved[dim - 1] += rise * (1 - (x[dim - 1] - self.height) / self.length)
        return moved


def move_nodes(
    gmsh: ModuleType, dim: int, body: int, moved: Callable[[Coordinates], Coordinates]
) -> None:
    """Map the coordinates of all nodes of a body.

    Args:
        gmsh: The gmsh module with its current model, which is meshed.
        dim: Dimension of the body.
        body: The gmsh tag of the body.
        moved: New positions of nodes, both of shape (3, n).
    """
    nodes, flat, _ = gmsh.model.mesh.getNodes(dim, body, includeBoundary=True)
    for node, x in zip(nodes, moved(np.reshape(flat, (-1, 3)).T).T, strict=True):
        gmsh.model.mesh.setNode(node, x, [])
