# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of the arguments of pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from contactx._host.checks import described, is_number
from contactx._host.parallel.reduce import total
from dolfinx import fem


def check_functions(u: Any, scalar: Any) -> None:
    """Check the functions of a picture of bodies; all ranks must take part.

    Args:
        u: Displacement.
        scalar: Coloured quantity.

    Raises:
        TypeError: If one is no function.
        ValueError: If they are of different meshes, of wrong shapes, or not finite.
    """
    for name, function in (("u", u), ("scalar", scalar)):
        if not isinstance(function, fem.Function):
            raise TypeError(f"{name} must be a fem.Function, not {type(function).__name__}")
    domain = u.function_space.mesh
    if scalar.function_space.mesh is not domain:
        raise ValueError("scalar is on another mesh than u: give one of the same mesh")
    if u.function_space.dofmap.bs != domain.geometry.dim:
        raise ValueError(f"u is of {u.function_space.ufl_element()}: give the displacement")
    element = scalar.function_space.ufl_element()
    if element.degree != 1 or element.discontinuous or element.block_size != 1:
        raise ValueError(f"scalar is of {element}; interpolate it into a space of ('P', 1).")
    for name, function in (("u", u), ("scalar", scalar)):
        bad = total(domain.comm, int(np.count_nonzero(~np.isfinite(function.x.array))))
        if bad > 0:
            raise ValueError(
                f"{name} is not finite at {bad} dofs; replace what is NaN or infinite. A contact's "
                "gap is NaN off its slave surface."
            )


def check_numbers(name: str, values: Any, count: int) -> None:
    """Check that there are so many finite numbers.

    Args:
        name: Name of the argument.
        values: The numbers, one alone where count is 1.
        count: How many there must be.

    Raises:
        TypeError: If they are no numbers.
        ValueError: If there are more or less, or one is not finite.
    """
    items: Any = [values] if count == 1 else values
    is_sequence = bool(np.iterable(items)) and not isinstance(items, str)
    if not is_sequence or not all(map(is_number, items)):
        raise TypeError(f"{name} is {described(values)}; give {count} numbers.")
    if len(items) != count or not np.all(np.isfinite(items)):
        raise ValueError(f"{name} is {values}; give {count} finite numbers.")


def check_increasing(name: str, values: Any) -> None:
    """Check that there are a lower and a higher number.

    Raises:
        TypeError: If they are no numbers.
        ValueError: If there are more or less, or the second is not above the first.
    """
    check_numbers(name, values, 2)
    if not values[0] < values[1]:
        raise ValueError(f"{name} is {values}; give the lower number first.")


def check_labels(labels: Any) -> None:
    """Check the names of two axes.

    Raises:
        TypeError: If there are no two names.
    """
    if (
        isinstance(labels, str)
        or not isinstance(labels, Sequence)
        or [type(label) for label in labels] != [str, str]
    ):
        raise TypeError(f"labels is {labels!r}; give the names of both axes.")


def check_curves(name: str, curves: Any) -> None:
    """Check that curves have as many positions as values.

    Args:
        name: Name of the argument.
        curves: Positions and values by the name of the curve.

    Raises:
        TypeError: If they are no dictionary of pairs.
        ValueError: If a curve has not as many positions as values.
    """
    if not isinstance(curves, Mapping):
        raise TypeError(f'{name} is a {type(curves).__name__}; give {{"name": (x, y)}}.')
    for key, curve in curves.items():
        if not isinstance(curve, tuple | list) or len(curve) != 2:
            raise TypeError(f"{name}[{key!r}] is {described(curve)}; give positions and values.")
        shapes = [np.shape(np.atleast_1d(values)) for values in curve]
        if shapes[0] != shapes[1]:
            raise ValueError(
                f"{name}[{key!r}] has positions of shape {shapes[0]} and values of shape "
                f"{shapes[1]}; give as many of both."
            )
