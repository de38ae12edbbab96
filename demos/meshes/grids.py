# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Boxes on grids whose lines stand at given places, for hexahedra of graded size."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import numpy.typing as npt

Coordinates = npt.NDArray[np.float64]


def graded(length: float, first: float, ratio: float, largest: float) -> Coordinates:
    """Coordinates of cells that grow from zero.

    Args:
        length: Length that the cells fill.
        first: Size of the first cell, a length; the cells are all made smaller by the same factor,
            so that a whole number of them fits.
        ratio: Size of a cell over that of the one before, at least 1.
        largest: Size that no cell exceeds, a length.

    Returns:
        Coordinates of the cells' ends from 0 to ``length``, increasing, shape (n + 1,).
    """
    sizes = [min(first, largest)]
    # Rounding must not add a cell
    while sum(sizes) < (1 - 1e-12) * length:
        sizes.append(min(ratio * sizes[-1], largest))
    ends = np.concatenate([[0.0], np.cumsum(sizes)])
    return np.asarray(ends * (length / ends[-1]))


def graded_between(
    begin: float, end: float, fine: tuple[bool, bool], first: float, ratio: float, largest: float
) -> Coordinates:
    """Coordinates of cells that are fine at none, one or both ends of an interval.

    Unless one end alone is fine, the middle is one of them.

    Args:
        begin: Lower end of the interval, a length.
        end: Upper end.
        fine: Whether the cells are fine at the lower and at the upper end.
        first: Size of the cells at a fine end, a length.
        ratio: Size of a cell over that of its neighbour towards the fine end.
        largest: Size that no cell exceeds, a length.

    Returns:
        Coordinates from ``begin`` to ``end``, increasing, shape (n + 1,).
    """
    length = end - begin
    if fine[0] != fine[1]:
        local = graded(length, first, ratio, largest)
        local = local if fine[0] else length - local[::-1]
    else:
        half = graded(length / 2, first if fine[0] else largest, ratio, largest)
        local = np.concatenate([half, length - half[-2::-1]])
    points = begin + local
    points[0], points[-1] = begin, end
    return points


def add_grid(gmsh: ModuleType, x: Coordinates, y: Coordinates, z: Coordinates) -> int:
    """Draw a box of hexahedra whose nodes stand at given coordinates.

    Args:
        gmsh: The gmsh module with its current model.
        x: Coordinates of the grid's planes across the first axis, increasing, shape (nx + 1,).
        y: The same for the second axis.
        z: The same for the third axis.

    Returns:
        The gmsh tag of the box, an entity of dimension 3.
    """
    occ = gmsh.model.occ
    entity = (0, occ.addPoint(float(x[0]), float(y[0]), float(z[0])))
    for axis, points in enumerate((x, y, z)):
        length = float(points[-1] - points[0])
        direction = [length * float(i == axis) for i in range(3)]
        heights = ((points[1:] - points[0]) / length).tolist()
        made = occ.extrude([entity], *direction, [1] * len(heights), heights, recombine=True)
        entity = next(e for e in made if e[0] == axis + 1)
    occ.synchronize()
    return int(entity[1])
