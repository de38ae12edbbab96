# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kinds of arguments."""

from __future__ import annotations

from typing import Any

import numpy as np


def is_number(value: Any) -> bool:
    """Return True for a real number of Python or NumPy; True and False are none."""
    array = value if isinstance(value, np.ndarray | np.generic) else None
    if array is not None:
        return array.ndim == 0 and array.dtype.kind in "iuf"
    return isinstance(value, int | float) and not isinstance(value, bool)


def described(value: Any) -> str:
    """Describe a value in a message: its type, and the value itself if it is short."""
    text = repr(value)
    return f"{type(value).__name__} {text}" if len(text) <= 40 else type(value).__name__


def check_switch(name: str, value: Any) -> None:
    """Check that an option is True or False: any other text or number would count as True.

    Args:
        name: Name of the argument.
        value: Its value.

    Raises:
        TypeError: If it is something else.
    """
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name} is {described(value)}: give True or False")
