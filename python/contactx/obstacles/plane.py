# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid half-space."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.obstacles.obstacle import Geometry, Obstacle, Parameter, Placement, direction, vector


class Plane(Obstacle):
    """Half-space bounded by a plane; its outward normal points to where bodies may be."""

    usual_mistake = "Its normal probably points the wrong way: it must point to where bodies may be"

    def __init__(self, point: Parameter, normal: Parameter):
        """Create a plane.

        Args:
            point: A point of the plane, shape (gdim,), numbers or a ``fem.Constant``.
            normal: Outward normal of any length, shape (gdim,), numbers or a ``fem.Constant``.
        """
        self.point = point
        self.normal = normal

    def evaluate(self, x: npt.NDArray[np.float64]) -> Geometry:
        """See ``Obstacle``; g = n . (x - point)."""
        n, gdim = x.shape
        normal = direction(self.normal, gdim, "normal of a Plane")
        gap = (x - vector(self.point, gdim, "point of a Plane")) @ normal
        normals = np.tile(normal, (n, 1))
        return Geometry(gap, normals, normals, np.zeros((n, gdim, gdim)))

    def placement(self, gdim: int) -> Placement:
        """See ``Obstacle``."""
        return Placement(
            vector(self.point, gdim, "point of a Plane"),
            direction(self.normal, gdim, "normal of a Plane"),
        )
