# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid sphere, in the plane a circle."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.arguments import check_switch
from contactx.obstacles.obstacle import Geometry, Obstacle, Parameter, Placement, positive, vector
from dolfinx import fem


class Sphere(Obstacle):
    """Ball, or with ``hollow`` all that is outside of one; in the plane a disc."""

    usual_mistake = "Perhaps hollow is the wrong way round: bodies within need hollow=True"

    def __init__(self, centre: Parameter, radius: float | fem.Constant, *, hollow: bool = False):
        """Create a sphere.

        Args:
            centre: Centre, shape (gdim,), numbers or a ``fem.Constant``.
            radius: Radius, a number or a ``fem.Constant``.
            hollow: False: bodies may be outside of the sphere. True: inside, as in a bowl.

        Raises:
            TypeError: If hollow is neither True nor False.
        """
        self.centre = centre
        self.radius = radius
        check_switch("hollow", hollow)
        self.hollow = hollow

    def evaluate(self, x: npt.NDArray[np.float64]) -> Geometry:
        """See ``Obstacle``; g = |x - centre| - radius, or its opposite for a hollow sphere."""
        return radial(self._from_centre(x), self._radius(), self.hollow)

    def distance(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Obstacle``."""
        return radial_gap(self._from_centre(x), self._radius(), self.hollow)

    def size(self) -> float:
        """See ``Obstacle``."""
        return np.inf if self.hollow else 2 * self._radius()

    def placement(self, gdim: int) -> Placement:
        """See ``Obstacle``."""
        return Placement(vector(self.centre, gdim, "centre of a Sphere"))

    def _from_centre(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        return x - vector(self.centre, x.shape[1], "centre of a Sphere")

    def _radius(self) -> float:
        return positive(self.radius, "radius of a Sphere")


def radial_gap(d: npt.NDArray[np.float64], radius: float, hollow: bool) -> npt.NDArray[np.float64]:
    """Gap of ``radial``, which exists for a zero vector too, shape (n,)."""
    gap: npt.NDArray[np.float64] = np.linalg.norm(d, axis=1) - radius
    return -gap if hollow else gap


def radial(d: npt.NDArray[np.float64], radius: float, hollow: bool) -> Geometry:
    """A surface at a constant distance from a point or a line.

    Args:
        d: Vectors from the point or line, at right angles to the line, shape (n, gdim).
        radius: Distance.
        hollow: Whether bodies are inside.

    Returns:
        The geometry; its derivatives are those within the span of all such ``d``.
        Where a vector is zero there is no normal, and it is zero, too: nothing faces it.
    """
    distance = np.linalg.norm(d, axis=1)
    away = distance > 0
    sign = -1.0 if hollow else 1.0
    inverse = np.divide(1, distance, out=np.zeros_like(distance), where=away)
    unit = d * inverse[:, None]
    projector = np.eye(d.shape[1]) - unit[:, :, None] * unit[:, None, :]
    normal = sign * unit
    return Geometry(
        radial_gap(d, radius, hollow), normal, normal, sign * projector * inverse[:, None, None]
    )
