# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Frictionless contact of parallel cylinders, or of a cylinder and a flat body, after Hertz."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.checks import check_positive


@dataclass(frozen=True)
class HertzCylinder:
    """Hertz's solution of line contact between elastic half-spaces in plane strain.

    Source: K. L. Johnson, Contact Mechanics, Cambridge University Press, 1985, chapter 4, the
    part on two-dimensional contact of cylindrical bodies. It holds while the half-width is small
    beside the radius. An approach does not exist: it depends on the size of the bodies.

    Attributes:
        force: Force F per unit of the cylinder's length; that of the whole model, so twice the
            one of a half model.
        radius: Radius R, length. For two cylinders 1/R = 1/R_1 + 1/R_2.
        modulus: Contact modulus E*, force/area; see `contact_modulus`.

    Raises:
        ValueError: If an argument is not positive.
    """

    force: float
    radius: float
    modulus: float

    def __post_init__(self) -> None:
        """Check the arguments."""
        check_positive(force=self.force, radius=self.radius, modulus=self.modulus)

    @property
    def half_width(self) -> float:
        """Half the width of the contact strip, b = sqrt(4 F R / (pi E*)), length."""
        return math.sqrt(4 * self.force * self.radius / (math.pi * self.modulus))

    @property
    def peak_pressure(self) -> float:
        """Pressure in the middle, p_0 = 2 F / (pi b), force/area."""
        return 2 * self.force / (math.pi * self.half_width)

    def pressure(self, x: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Evaluate the pressure p(x) = p_0 sqrt(1 - (x/b)^2), zero for |x| > b.

        Args:
            x: Distances from the middle line, length, any shape.

        Returns:
            The pressures, force/area, in the shape of x.
        """
        ratio = np.asarray(x, dtype=np.float64) / self.half_width
        return self.peak_pressure * np.sqrt(np.maximum(1 - ratio**2, 0))
