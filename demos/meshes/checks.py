# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks of the arguments of the mesh functions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contactx._host.checks import described, is_number
from dolfinx.mesh import CellType

_DIMENSIONS = {
    CellType.triangle: 2,
    CellType.quadrilateral: 2,
    CellType.tetrahedron: 3,
    CellType.hexahedron: 3,
}


def check_positive(**values: float) -> None:
    """Check that lengths and ratios are positive and finite.

    Args:
        values: Values by the name of their argument.

    Raises:
        TypeError: If it is of another kind.
        ValueError: If a value is not a positive finite number.
    """
    for name, value in values.items():
        _check_number(name, value)
        if not (np.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value}; give a positive number.")


def check_numbers(name: str, values: Sequence[float]) -> None:
    """Check that a sequence consists of numbers.

    Args:
        name: Name of the argument.
        values: The entries.

    Raises:
        TypeError: If it is no sequence, or an entry is no number.
    """
    if not np.iterable(values) or isinstance(values, str):
        raise TypeError(f"{name} is {described(values)}; give a sequence of numbers.")
    for i, value in enumerate(values):
        _check_number(f"{name}[{i}]", value)


def check_finite(name: str, value: float) -> None:
    """Check that a number is finite.

    Args:
        name: Name of the argument.
        value: Its value.

    Raises:
        TypeError: If it is no number.
        ValueError: If it is not finite.
    """
    _check_number(name, value)
    if not np.isfinite(value):
        raise ValueError(f"{name} is {value}; give a finite number.")


def _check_number(name: str, value: object) -> None:
    if not is_number(value):
        raise TypeError(f"{name} is {described(value)}; give a number.")


def check_zone(zone: float, radius: float) -> None:
    """Check that a contact zone lies within a round body.

    Args:
        zone: Radius of the zone.
        radius: Radius of the body.

    Raises:
        ValueError: If it reaches beyond the radius.
    """
    if zone > radius:
        raise ValueError(f"zone is {zone}; give at most the radius, {radius}.")


def check_divisions(**values: int) -> None:
    """Check numbers of cells along an edge.

    Args:
        values: Values by the name of their argument.

    Raises:
        TypeError: If it is of another kind.
        ValueError: If a value is not an integer of at least one.
    """
    for name, value in values.items():
        _check_number(name, value)
        if not np.isfinite(value) or value != int(value) or value < 1:
            raise ValueError(f"{name} is {value}; give a whole number of cells, at least 1.")


def check_vector(name: str, values: Sequence[float], dim: int) -> None:
    """Check that a sequence has one finite entry per direction.

    Args:
        name: Name of the argument.
        values: The entries.
        dim: The number of entries that is expected.

    Raises:
        TypeError: If it is of another kind.
        ValueError: If the number of entries is another one, or one is not finite.
    """
    check_numbers(name, values)
    if len(values) != dim or not np.all(np.isfinite(values)):
        raise ValueError(f"{name} is {values}; give {dim} finite numbers, one per direction.")


def check_cell_type(cell_type: CellType) -> int:
    """Check that a box can be meshed with a cell type.

    Args:
        cell_type: The cell type.

    Returns:
        Its dimension.

    Raises:
        TypeError: If it is of another kind.
        ValueError: If it is neither of triangle, quadrilateral, tetrahedron and hexahedron.
    """
    if not isinstance(cell_type, CellType):
        raise TypeError(f"cell_type is {described(cell_type)}; give a dolfinx.mesh.CellType.")
    if cell_type not in _DIMENSIONS:
        names = ", ".join(known.name for known in _DIMENSIONS)
        raise ValueError(f"cell_type is {cell_type.name}; give one of {names}.")
    return _DIMENSIONS[cell_type]
