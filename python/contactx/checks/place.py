# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where something is, for a message."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt


def place(x: npt.NDArray[np.float64], size: float) -> str:
    """Coordinates of a point in six digits, without what rounding has left of a zero.

    Args:
        x: Point, shape (gdim,).
        size: Size of what it is a part of.
    """
    return f"({', '.join(f'{0.0 if abs(value) < 1e-9 * size else value:.6g}' for value in x)})"
