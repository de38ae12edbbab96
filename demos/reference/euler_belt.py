# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A belt that slides around a drum, after Euler."""

from __future__ import annotations

import math


def belt_ratio(friction: float, angle: float, thickness: float = 0.0) -> float:
    """Tension where the belt is held over that where it is pulled, exp(mu angle).

    Source: L. Euler, Remarques sur l'effet du frottement dans l'equilibre, Memoires de l'academie
    des sciences de Berlin 18, 1769, pages 265 to 278. Friction acts at the inside of a belt and
    its tension in the middle, so that of a thickness t on a radius R it is mu/(1 + t/(2 R)).

    Args:
        friction: Coulomb's coefficient.
        angle: Angle of the belt around the drum, radians.
        thickness: Thickness of the belt over the radius of the drum.
    """
    return math.exp(friction * angle / (1 + thickness / 2))
