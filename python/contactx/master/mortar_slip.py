# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where the slip of slave facets is measured from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from contactx.master.master import touching
from contactx.master.mortar_pairs import Array, Index, Mortar, Sides


class MortarSlip:
    """Weights with which slave nodes are measured against points of the master.

    They are those of the step's start: what was in front of a slave node then stays what its
    movement is relative to. A node that touches first within a step gets weights in proportion to
    the way, between those at both of its ends.

    Attributes:
        origin: What is taken off the movement in small sliding, shape (n, gdim).
    """

    def __init__(self, sides: Sides, gdim: int, *, small: bool):
        """Create it for slave nodes that have not moved.

        Args:
            sides: Both surfaces.
            gdim: Geometric dimension.
            small: Whether weights never change.
        """
        self._sides = sides
        self._small = small
        self.origin = np.zeros((len(sides.slaves), gdim))
        self._start: Mortar | None = None

    def begin_step(self, now: Mortar, distances: Array) -> None:
        """Start a step.

        Args:
            now: Pairs at its start, divided by the slave nodes' areas.
            distances: Means of x_slave - x_master there, shape (n, gdim).
        """
        if self._small:
            self.origin = distances
            return
        self._start = now
        self._gap = self._gaps(now)

    def touch(
        self,
        which: npt.NDArray[np.bool_],
        now: Mortar,
        distances: Array,
        normals: Array,
        offset: Array,
    ) -> None:
        """Measure from where nodes touch.

        Args:
            which: Which slave nodes, shape (n,).
            now: Pairs at the iterate that closes them, divided by the areas.
            distances: Means of x_slave - x_master there, shape (n, gdim).
            normals: Unit normals, shape (n, gdim).
            offset: What is taken off the gap, shape (n,).
        """
        if self._small:
            before = self.origin
            gaps = [np.einsum("ij,ij->i", normals, d) - offset for d in (before, distances)]
            part = touching(*gaps)[:, None]
            self.origin = np.where(which[:, None], before + part * (distances - before), before)
            return
        part = touching(self._gap - offset, self._gaps(now) - offset)
        sides, start = self._sides, self._start
        assert start is not None
        known = np.zeros(len(sides.around), dtype=bool)
        known[sides.numbers[start.slave][start.weight.any(axis=2)]] = True
        # What had no master at the start is measured from here
        part = np.where(which, np.where(known[: len(which)], part, 1.0), 0.0)
        self._start = start.scaled(sides.at_corners(1 - part, start.slave)).joined(
            now.scaled(sides.at_corners(part, now.slave))
        )

    def pairs(self, now: Mortar, area: Array) -> Mortar:
        """Pairs that the movement is measured with.

        Args:
            now: Current pairs.
            area: Areas of the slave nodes, shape (n,).
        """
        if self._small:
            return Mortar(now.slave, now.master, now.weight, np.zeros_like(now.gap))
        assert self._start is not None
        return self._start.scaled(self._sides.at_corners(area, self._start.slave))

    @property
    def masters(self) -> Index:
        """Master facets that slip is measured with."""
        return np.zeros(0, dtype=np.int32) if self._start is None else self._start.master

    def rename(self, numbers: Index) -> None:
        """Take other numbers of the master facets."""
        if self._start is not None:
            self._start = replace(self._start, master=numbers[self._start.master])

    def _gaps(self, mortar: Mortar) -> Array:
        return self._sides.total(mortar.gap, mortar.slave)
