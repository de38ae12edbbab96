# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid half-space."""

from __future__ import annotations

from contactx import cpp as core
from contactx.obstacles.parameters import Parameter, Placed, vector


class Plane(core.Plane):
    """Half-space bounded by a plane; its outward normal points to where bodies may be.

    Changing the value of a ``fem.Constant`` moves it.
    """

    def __init__(self, point: Parameter, normal: Parameter):
        """Create a plane.

        Args:
            point: A point of the plane, shape (gdim,), numbers or a ``fem.Constant``.
            normal: Outward normal of any length, shape (gdim,), numbers or a ``fem.Constant``.
        """
        super().__init__()
        self._placed = Placed()
        self.point = point
        self.normal = normal

    def refresh(self, gdim: int) -> None:
        """Hand the current parameters to the core, which calls this before it uses them.

        Args:
            gdim: Geometric dimension, 2 or 3.

        Raises:
            TypeError: If a parameter is no number, vector or ``fem.Constant``.
            ValueError: If a parameter is not finite or of another shape, or out of its range.
        """
        self._placed.again(
            gdim,
            self.point,
            self.normal,
            place=lambda: self.place(
                vector(self.point, gdim, "point of a Plane"),
                vector(self.normal, gdim, "normal of a Plane"),
            ),
        )
