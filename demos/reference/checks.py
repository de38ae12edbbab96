# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of the arguments of the closed formulas."""

from __future__ import annotations

import math

from contactx._host.checks import described, is_number


def check_positive(**values: float) -> None:
    """Check that quantities are positive and finite.

    Args:
        values: Values by the name of their argument.

    Raises:
        TypeError: If a value is no number.
        ValueError: If a value is not a positive finite number.
    """
    for name, value in values.items():
        if not is_number(value):
            raise TypeError(f"{name} is {described(value)}; give a positive number.")
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value}; give a positive number.")
