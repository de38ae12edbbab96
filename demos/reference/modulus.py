# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The stiffness of two elastic bodies in contact."""

from __future__ import annotations

import math

from contactx._host.checks import described, is_number


def contact_modulus(young_1: float, nu_1: float, young_2: float, nu_2: float) -> float:
    """Combine the elastic constants of two bodies.

    E* = [(1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2]^-1, after K. L. Johnson, Contact Mechanics,
    Cambridge University Press, 1985, chapter 4.

    Args:
        young_1: Young's modulus of the first body, force/area; ``math.inf`` if it is rigid.
        nu_1: Poisson's ratio of the first body.
        young_2: Young's modulus of the second body, force/area; ``math.inf`` if it is rigid.
        nu_2: Poisson's ratio of the second body.

    Returns:
        The contact modulus E*, force/area.

    Raises:
        TypeError: If a value is no number.
        ValueError: If a Young's modulus is not positive, a Poisson's ratio is outside
            (-1, 0.5], or both bodies are rigid.
    """
    for name, value in (("young_1", young_1), ("nu_1", nu_1), ("young_2", young_2), ("nu_2", nu_2)):
        if not is_number(value):
            raise TypeError(f"{name} is {described(value)}; give a number.")
    for name, young in (("young_1", young_1), ("young_2", young_2)):
        if not young > 0:
            raise ValueError(f"{name} is {young}; give a positive modulus.")
    for name, nu in (("nu_1", nu_1), ("nu_2", nu_2)):
        if not -1 < nu <= 0.5:
            raise ValueError(f"{name} is {nu}; give a Poisson's ratio in (-1, 0.5].")
    if math.isinf(young_1) and math.isinf(young_2):
        raise ValueError("young_1 and young_2 are infinite; at most one body may be rigid.")
    return 1 / ((1 - nu_1**2) / young_1 + (1 - nu_2**2) / young_2)
