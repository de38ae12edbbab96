# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid sphere, in 2D a circle."""

from __future__ import annotations

from contactx import cpp as core
from contactx._host.checks import check_switch
from contactx.obstacles.parameters import Parameter, Placed, angle, number, vector
from dolfinx import fem


class Sphere(core.Sphere):
    """Ball, or with ``hollow`` the space around one, as of a bowl; in 2D a disc.

    Changing the value of a ``fem.Constant`` moves it.
    """

    def __init__(
        self,
        centre: Parameter,
        radius: float | fem.Constant,
        *,
        hollow: bool = False,
        angle: Parameter | None = None,
    ):
        """Create a sphere.

        Args:
            centre: Centre, shape (gdim,), numbers or a ``fem.Constant``.
            radius: Radius, a number or a ``fem.Constant``.
            hollow: False: bodies may be outside of the sphere. True: inside, as in a bowl.
            angle: Rotation in radians, which drags what touches it by friction or ties: in 2D
                counter-clockwise, a number or a ``fem.Constant``; in 3D a rotation vector, shape
                (3,). Turn it by less than a right angle in a step.

        Raises:
            TypeError: If hollow is neither True nor False.
        """
        check_switch("hollow", hollow)
        super().__init__(bool(hollow))
        self._placed = Placed()
        self.centre = centre
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
            self.centre,
            self.radius,
            self.angle,
            place=lambda: self.place(
                vector(self.centre, gdim, "centre of a Sphere"),
                number(self.radius, "radius of a Sphere"),
                angle(self.angle, "angle of a Sphere"),
            ),
        )
