# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A bolted joint as two springs, after VDI 2230."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class BoltedJoint:
    """A bolt in a tapped hole clamps a sleeve that is as wide as its head.

    Source: VDI 2230, Systematic calculation of highly stressed bolted joints, part 1, 2015:
    sections 5.1.1 (resilience of the bolt: the head counts as 0.5 d of its shank, the thread
    engaged as 0.5 d and what is around it as 0.33 d), 5.1.2 (of clamped parts, here a sleeve) and
    5.3 (load factor).

    Attributes:
        young: Young's modulus of all parts, force/area.
        shank: Radius of the shank and the thread, a length.
        hole: Radius of the hole in the sleeve, a length.
        outer: Radius of the sleeve, a length.
        grip: Height of the sleeve, a length.
    """

    young: float
    shank: float
    hole: float
    outer: float
    grip: float

    @property
    def bolt(self) -> float:
        """Resilience of the bolt, length/force."""
        length = self.grip + (0.5 + 0.5 + 0.33) * 2 * self.shank
        return length / (self.young * math.pi * self.shank**2)

    @property
    def clamped(self) -> float:
        """Resilience of the sleeve, length/force."""
        return self.grip / (self.young * math.pi * (self.outer**2 - self.hole**2))

    def preload(self, shortening: float) -> float:
        """Force in the bolt whose free shank would be shorter by a length."""
        return shortening / (self.bolt + self.clamped)

    def share(self, part: float) -> float:
        """Part of a working load that the bolt feels as long as the joint is closed.

        Args:
            part: Part of the sleeve that the load relieves: height where it acts over the grip.
        """
        return part * self.clamped / (self.bolt + self.clamped)
