# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rubber cord squeezed between rigid plates, per length, in plane strain."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class SqueezedCord:
    """Cord of a diameter whose material keeps its volume.

    Sources: K. L. Johnson, Contact Mechanics, 1985, equations (4.43), (4.45) and (5.57), for small
    squeezes; P. B. Lindley, Compression characteristics of laterally-unrestrained rubber O-rings,
    Journal of the Institution of the Rubber Industry 1, 1967, pages 209 to 213, up to 40 %; there
    the modulus is Young's, here that of plane strain.

    Attributes:
        diameter: A length.
        young: Young's modulus, force/area.
    """

    diameter: float
    young: float

    @property
    def modulus(self) -> float:
        """Modulus of plane strain, E/(1 - nu^2) with nu = 1/2."""
        return self.young / 0.75

    def lindley(self, squeeze: float) -> float:
        """Force per length.

        Args:
            squeeze: Change of height over the diameter.
        """
        return self.modulus * self.diameter * (1.25 * math.pow(squeeze, 1.5) + 50 * squeeze**6)

    def width(self, force: float) -> float:
        """Width of Hertz's line contact for a force per length."""
        return math.sqrt(8 * force * self.diameter / (math.pi * self.modulus))

    def peak(self, force: float) -> float:
        """Largest pressure of Hertz's line contact for a force per length."""
        return 4 * force / (math.pi * self.width(force))

    def approach(self, force: float) -> float:
        """Change of height between two plates by Hertz, for a force per length."""
        logarithm = 2 * math.log(4 * self.diameter / self.width(force)) - 1
        return 2 * force / (math.pi * self.modulus) * logarithm

    def hertz(self, squeeze: float) -> float:
        """Force per length that makes a small squeeze.

        Args:
            squeeze: Change of height over the diameter.
        """
        low, high = 0.0, self.modulus * self.diameter * squeeze
        for _ in range(60):
            middle = (low + high) / 2
            is_less = self.approach(middle) < squeeze * self.diameter
            low, high = (middle, high) if is_less else (low, middle)
        return (low + high) / 2
