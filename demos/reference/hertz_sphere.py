# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Frictionless contact of two spheres, or of a sphere and a flat body, after Hertz."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.checks import check_positive


@dataclass(frozen=True)
class HertzSphere:
    """Hertz's solution of point contact between elastic half-spaces.

    Source: K. L. Johnson, Contact Mechanics, Cambridge University Press, 1985, chapter 4, the
    part on solids of revolution. It holds while the contact radius is small beside the radius.

    Attributes:
        force: Force F that presses the bodies together; that of the whole model, so four times
            the one of a quarter model.
        radius: Radius R, length. For two spheres 1/R = 1/R_1 + 1/R_2.
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
    def contact_radius(self) -> float:
        """Radius of the contact circle, a = (3 F R / (4 E*))^(1/3), length."""
        return math.cbrt(3 * self.force * self.radius / (4 * self.modulus))

    @property
    def peak_pressure(self) -> float:
        """Pressure in the centre, p_0 = 3 F / (2 pi a^2), force/area."""
        return 3 * self.force / (2 * math.pi * self.contact_radius**2)

    @property
    def approach(self) -> float:
        """Approach of points of the two bodies far from the contact, a^2 / R, length."""
        return self.contact_radius**2 / self.radius

    def pressure(self, r: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Evaluate the pressure p(r) = p_0 sqrt(1 - (r/a)^2), zero for |r| > a.

        Args:
            r: Distances from the axis, length, any shape.

        Returns:
            The pressures, force/area, in the shape of r.
        """
        ratio = np.asarray(r, dtype=np.float64) / self.contact_radius
        return self.peak_pressure * np.sqrt(np.maximum(1 - ratio**2, 0))
