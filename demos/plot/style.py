# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the pictures share: their colours, and the packages that draw them."""

from __future__ import annotations

import importlib
from typing import Any

COLOURS = ("#e6e9ed", "#fbd992", "#f4973f", "#d1372c", "#5e0d2a")
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


def colour_map() -> Any:
    """Make a map from the grey of an unloaded body to a dark red."""
    return import_plotter("matplotlib.colors").LinearSegmentedColormap.from_list(
        "contactx", COLOURS
    )
