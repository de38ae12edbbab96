# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Parameters of obstacles, which users may change at any time.

They are numbers or ``fem.Constant``, and the core asks for them whenever it uses an obstacle. It
checks what they are, too.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

import ufl
from contactx._host.checks import is_number
from dolfinx import fem

type Parameter = npt.ArrayLike | fem.Constant


class Placed:
    """What an obstacle was placed with last: the core asks for it many times an iterate."""

    def __init__(self) -> None:
        """Start with an obstacle that has no place yet."""
        self._with: tuple[object, ...] | None = None

    def again(self, gdim: int, *values: object, place: Callable[[], None]) -> None:
        """Place the obstacle unless it stands there already.

        Args:
            gdim: Geometric dimension.
            values: Its parameters.
            place: Places it.

        Raises:
            TypeError: As ``place`` does.
            ValueError: As ``place`` does.
        """
        now = (gdim, *map(_contents, values))
        if now == self._with:
            return
        self._with = None
        place()
        if None not in now:
            self._with = now


def _contents(value: object) -> object:
    """What a parameter holds, to be compared; None for what has to be looked at each time."""
    if isinstance(value, fem.Constant):
        value = value.value
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if value is None:
        return "none"
    if isinstance(value, tuple | list):
        value = tuple(value)
        return value if all(type(v) in (int, float) for v in value) else None
    return value if type(value) in (int, float) else None


def vector(value: Parameter, gdim: int, name: str) -> list[float]:
    """Current value of a vector parameter.

    Args:
        value: Numbers or a constant.
        gdim: Geometric dimension.
        name: Name of the parameter.

    Returns:
        Its components.

    Raises:
        TypeError: If it does not consist of real numbers in a row.
    """
    given = value.value if isinstance(value, fem.Constant) else value
    try:
        array = np.array([]) if isinstance(given, ufl.core.expr.Expr) else np.array(given, float)
    except (TypeError, ValueError):
        array = np.array([])
    if array.size == 0 or array.ndim > 1:
        raise TypeError(
            f"{name} is {given!r}: give {gdim} finite numbers, or a fem.Constant of them"
        )
    components: list[float] = array.reshape(-1).tolist()
    return components


def number(value: float | fem.Constant, name: str) -> float:
    """Current value of a positive number.

    Args:
        value: A number or a constant.
        name: Name of the parameter.

    Returns:
        The number.

    Raises:
        TypeError: If it is no real number.
    """
    given = value.value if isinstance(value, fem.Constant) else value
    if not is_number(given):
        raise TypeError(f"{name} is {given!r}: give a positive number, or a fem.Constant of one")
    return float(given)


def angle(value: Parameter | None, name: str) -> list[float]:
    """Current value of an angle, or of a rotation vector.

    Args:
        value: Numbers or a constant, in radians; None where nothing spins.
        name: Name of the parameter.

    Returns:
        The angle, or the components of the vector; nothing for None.

    Raises:
        TypeError: If it does not consist of real numbers.
    """
    return [] if value is None else vector(value, 1, name)
