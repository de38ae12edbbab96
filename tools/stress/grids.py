# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies on mapped grids, of which every node and facet is known without asking a mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from stress import inside

type Array = npt.NDArray[np.float64]
type Numbers = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Body:
    """A body of quadrilaterals or hexahedra.

    Attributes:
        x: Its nodes, shape (n, dim).
        cells: Nodes of the cells, line by line as dolfinx numbers them, shape (m, 2**dim).
        faces: Nodes of the facets of each face, oriented outwards; faces are named by their axis
            and end, as in "y1".
    """

    x: Array
    cells: Numbers
    faces: dict[str, Numbers]

    @property
    def boundary(self) -> Numbers:
        """Facets of all faces."""
        return np.concatenate(list(self.faces.values()))


def grid(
    *axes: npt.ArrayLike, shape: Callable[..., Sequence[Array]] | None = None, ring: bool = False
) -> Body:
    """A body whose grid lines stand at given places.

    Args:
        axes: Places of the lines along each axis.
        shape: Maps the coordinates of the grid to those of the body.
        ring: Whether the last axis, of a plane grid, returns to where it began.
    """
    points = np.meshgrid(*(np.asarray(a, dtype=float) for a in axes), indexing="ij")
    mapped = points if shape is None else shape(*points)
    x = np.stack([np.asarray(p).ravel() for p in mapped], axis=1)
    number = np.arange(len(x)).reshape(points[0].shape)
    if ring:
        number[:, -1] = number[:, 0]
    if number.ndim == 2:
        cells = [number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]]
        faces = {
            "x0": _line(number[0])[:, ::-1],
            "x1": _line(number[-1]),
            "y0": _line(number[:, 0]),
            "y1": _line(number[:, -1])[:, ::-1],
        }
        if ring:
            del faces["y0"], faces["y1"]
    else:
        a, b = slice(None, -1), slice(1, None)
        cells = [number[i, j, k] for k in (a, b) for j in (a, b) for i in (a, b)]
        faces = {
            "x0": _sheet(number[0].T),
            "x1": _sheet(number[-1]),
            "y0": _sheet(number[:, 0]),
            "y1": _sheet(number[:, -1].T),
            "z0": _sheet(number[:, :, 0].T),
            "z1": _sheet(number[:, :, -1]),
        }
    table = np.stack([c.ravel() for c in cells], axis=1)
    used, again = np.unique(table, return_inverse=True)
    new = np.full(len(x), -1)
    new[used] = np.arange(len(used))
    body = Body(x[used], again.reshape(table.shape), {k: new[f] for k, f in faces.items()})
    middle = body.x[body.cells[0]].mean(axis=0)[None]
    if inside.depth(middle, body.x, body.boundary)[0] == 0:
        # The map has turned it inside out
        turned = [1, 0] if number.ndim == 2 else [0, 2, 1, 3]
        body.faces.update({k: f[:, turned] for k, f in body.faces.items()})
    return body


def _line(number: Numbers) -> Numbers:
    return np.stack([number[:-1], number[1:]], axis=1)


def _sheet(number: Numbers) -> Numbers:
    parts = number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]
    return np.stack([p.ravel() for p in parts], axis=1)


def even(begin: float, end: float, n: int) -> Array:
    """Places of n cells of one size."""
    return np.linspace(begin, end, n + 1)


def disc(n: int, radius: float, centre: Sequence[float]) -> Body:
    """A disc of n by n cells, its lowest quarter the face "y0" and its highest one "y1"."""
    a = even(-1, 1, n)
    return grid(
        a,
        a,
        shape=lambda p, q: (
            centre[0] + radius * p * np.sqrt(1 - q**2 / 2),
            centre[1] + radius * q * np.sqrt(1 - p**2 / 2),
        ),
    )
