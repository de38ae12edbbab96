# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid circular cylinder."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.arguments import check_switch
from contactx.obstacles.obstacle import (
    Geometry,
    Obstacle,
    Parameter,
    Placement,
    direction,
    positive,
    vector,
)
from contactx.obstacles.sphere import radial, radial_gap
from dolfinx import fem


class Cylinder(Obstacle):
    """Endless circular cylinder, or with ``hollow`` all that is outside of one."""

    usual_mistake = "Perhaps hollow is the wrong way round: bodies within need hollow=True"

    def __init__(
        self,
        point: Parameter,
        axis: Parameter,
        radius: float | fem.Constant,
        *,
        hollow: bool = False,
    ):
        """Create a cylinder.

        Args:
            point: A point of the axis, shape (3,), numbers or a ``fem.Constant``.
            axis: Direction of the axis, of any length, shape (3,), numbers or a ``fem.Constant``.
            radius: Radius, a number or a ``fem.Constant``.
            hollow: False: bodies may be outside of the cylinder. True: inside, as in a pipe.

        Raises:
            TypeError: If hollow is neither True nor False.
        """
        self.point = point
        self.axis = axis
        self.radius = radius
        check_switch("hollow", hollow)
        self.hollow = hollow

    def evaluate(self, x: npt.NDArray[np.float64]) -> Geometry:
        """See ``Obstacle``; g is the distance from the axis less the radius.

        Raises:
            ValueError: In the plane, where a cylinder is a Sphere.
        """
        if x.shape[1] != 3:
            raise ValueError("a Cylinder needs three dimensions: in the plane take a Sphere")
        across = self._across()
        geometry = radial(self._from_point(x) @ across, self._radius(), self.hollow)
        return Geometry(
            geometry.gap, geometry.gradient, geometry.normal, geometry.curvature @ across
        )

    def size(self) -> float:
        """See ``Obstacle``."""
        return np.inf if self.hollow else 2 * self._radius()

    def placement(self, gdim: int) -> Placement:
        """See ``Obstacle``."""
        return Placement(
            vector(self.point, gdim, "point of a Cylinder"),
            direction(self.axis, gdim, "axis of a Cylinder"),
        )

    def distance(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Obstacle``."""
        return radial_gap(self._from_point(x) @ self._across(), self._radius(), self.hollow)

    def _across(self) -> npt.NDArray[np.float64]:
        """Projector on the plane across the axis, shape (3, 3)."""
        axis = direction(self.axis, 3, "axis of a Cylinder")
        return np.eye(3) - np.outer(axis, axis)

    def _from_point(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        return x - vector(self.point, 3, "point of a Cylinder")

    def _radius(self) -> float:
        return positive(self.radius, "radius of a Cylinder")
