# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes for all values of an axis and all variants."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np

from dolfinx.mesh import CellType

from stress.blocks import Blocks
from stress.scene import METHODS, SHORT, SLIDINGS, Case, Scene

CELLS = (CellType.quadrilateral, CellType.tetrahedron)
ALL_CELLS = (*CELLS, CellType.triangle, CellType.hexahedron)


def name_of(value: Any) -> str:
    """Short name of an option's value."""
    if isinstance(value, CellType):
        return value.name[:4]
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, (tuple, list)):
        return ":".join(name_of(v) for v in value)
    return SHORT.get(value, str(value))


def variants(**options: Iterable[Any]) -> Iterator[dict[str, Any]]:
    """All combinations of options."""
    for values in product(*options.values()):
        yield dict(zip(options, values, strict=True))


def usual(
    cells: Sequence[CellType] = CELLS, friction: Sequence[float] = (0.0, 0.3)
) -> list[dict[str, Any]]:
    """Both methods, both kinematics, with and without friction."""
    return list(variants(cell=cells, method=METHODS, sliding=SLIDINGS, friction=friction))


def label(options: Mapping[str, Any]) -> str:
    """Name of a variant."""
    words = {"friction": "mu ", "young": "E ", "nu": "nu "}
    return ", ".join(words.get(key, "") + name_of(value) for key, value in options.items())


def scenes(
    family: str,
    values: Iterable[Any],
    options: Sequence[Mapping[str, Any]],
    make: Callable[..., Case],
) -> Iterator[Scene]:
    """Scenes of a family.

    Args:
        family: Its name.
        values: Values of its axis.
        options: Options of each variant.
        make: Makes the case of a value, given first, and options.
    """
    for value in values:
        for own in options:
            yield Scene(
                family,
                name_of(value),
                label(own),
                lambda value=value, own=own: make(value, **own),  # type: ignore[misc]
            )


def divisions(cell: CellType, flat: Any, solid: Any) -> Any:
    """Numbers of cells: more in the plane than in space."""
    return flat if cell in (CellType.triangle, CellType.quadrilateral) else solid


def block_case(**options: Any) -> Case:
    """Case of two blocks."""
    return Blocks(**options).case()


def drawn(number: int, seed: int, **options: Sequence[Any]) -> list[dict[str, Any]]:
    """Some combinations of options, each value about as often as the others of its option.

    Args:
        number: How many; fewer if some come twice.
        seed: Seed.
        options: Values of each option.
    """
    rng = np.random.default_rng(seed)
    columns = {}
    for name, values in options.items():
        order = np.resize(np.arange(len(values)), number)
        columns[name] = [values[i] for i in rng.permutation(order)]
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    return [row for i, row in enumerate(rows) if row not in rows[:i]]
