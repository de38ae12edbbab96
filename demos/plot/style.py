# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the pictures share: their colours, and the packages that draw them."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

import numpy as np

COLOURS = ("#e6e9ed", "#fbd992", "#f4973f", "#d1372c", "#5e0d2a")
# Of what is below zero
BELOW = ("#e6e9ed", "#a9cbe0", "#5b9bc7", "#2b6cb0", "#14315c")
INK = "#22262b"
DOTS_PER_INCH = 150


def import_plotter(name: str) -> Any:
    """Import a plotting package when it is needed, or say how to get it.

    Args:
        name: Name of the module.

    Returns:
        The module.

    Raises:
        ImportError: If the package is not installed.
    """
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(
            f"plot needs {name.partition('.')[0]}; install it with: pip install contactx[demo]"
        ) from error


def is_signed(limits: Sequence[float]) -> bool:
    """Whether a quantity has both signs, but for rounding."""
    low, high = limits
    return -low > 1e-3 * (high - low) and high > 1e-3 * (high - low)


def colour_map(limits: Sequence[float] = (0.0, 1.0)) -> Any:
    """Make a map from the grey of an unloaded body to a dark red.

    Of a signed quantity the grey is at zero, and what is below it is blue, as deep as what is as
    far above it is red.

    Args:
        limits: Lowest and highest value.
    """
    colours: list[str] | list[tuple[float, str]] = list(COLOURS)
    make = import_plotter("matplotlib.colors").LinearSegmentedColormap.from_list
    if is_signed(limits):
        low, high = limits
        zero = -low / (high - low)
        largest = max(-low, high)

        def branch(reach: float, shades: Sequence[str]) -> list[tuple[float, str]]:
            """Part of the shades that a branch of some reach needs, by its part of that."""
            whole = make("", shades)
            parts = np.linspace(0, 1, 9)
            to_hex = import_plotter("matplotlib.colors").to_hex
            return [(float(x), to_hex(whole(x * reach / largest))) for x in parts]

        below = [(zero * (1 - x), c) for x, c in branch(-low, BELOW)][::-1]
        above = [(zero + (1 - zero) * x, c) for x, c in branch(high, COLOURS)]
        colours = [*below[:-1], *above]
        colours[0], colours[-1] = (0.0, colours[0][1]), (1.0, colours[-1][1])
    return make("contactx", colours)
