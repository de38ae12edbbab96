# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid circular cylinder."""

from __future__ import annotations

from contactx import cpp as core
from contactx._host.checks import check_switch
from contactx.obstacles.parameters import Parameter, Placed, angle, number, vector
from dolfinx import fem


class Cylinder(core.Cylinder):
    """Infinite circular cylinder, or with ``hollow`` the space around one, as of a pipe.

    Changing the value of a ``fem.Constant`` moves it.
    """

    def __init__(
        self,
        point: Parameter,
        axis: Parameter,
        radius: float | fem.Constant,
        *,
        hollow: bool = False,
        angle: float | fem.Constant | None = None,
    ):
        """Create a cylinder.

        Args:
            point: A point of the axis, shape (3,), numbers or a ``fem.Constant``.
            axis: Direction of the axis, of any length, shape (3,), numbers or a ``fem.Constant``.
            radius: Radius, a number or a ``fem.Constant``.
            hollow: False: bodies may be outside of the cylinder. True: inside, as in a pipe.
            angle: Rotation about its axis, right-handed, in radians, which drags what touches it by
                friction or ties. Turn it by less than a right angle in a step.

        Raises:
            TypeError: If hollow is neither True nor False.
        """
        check_switch("hollow", hollow)
        super().__init__(bool(hollow))
        self._placed = Placed()
        self.point = point
        self.axis = axis
        self.radius = radius
        self.angle = angle

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
            self.axis,
            self.radius,
            self.angle,
            place=lambda: self.place(
                vector(self.point, gdim, "point of a Cylinder"),
                vector(self.axis, gdim, "axis of a Cylinder"),
                number(self.radius, "radius of a Cylinder"),
                angle(self.angle, "angle of a Cylinder"),
            ),
        )
