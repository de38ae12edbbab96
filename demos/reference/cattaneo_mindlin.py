# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Parallel cylinders pressed together and then pushed sideways, after Cattaneo and Mindlin."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from reference.checks import check_positive
from reference.hertz_cylinder import HertzCylinder


@dataclass(frozen=True)
class CattaneoMindlin(HertzCylinder):
    """Partial slip of a line contact under a constant normal and a growing tangential force.

    Source: C. Cattaneo, Sul contatto di due corpi elastici, Rend. Accad. Naz. Lincei 27, 1938;
    R. D. Mindlin, Compliance of elastic bodies in contact, J. Appl. Mech. 16, 1949; K. L. Johnson,
    Contact Mechanics, Cambridge University Press, 1985, chapter 7, the part on incipient sliding.
    Half-spaces in plane strain, Coulomb friction, forces per unit of length. The pressure is
    Hertz's: it takes no notice of the shear if both bodies are of the same material, or both are
    incompressible, or one is rigid and the other incompressible.

    Attributes:
        force: Normal force N per unit of length, as for `HertzCylinder`.
        radius: Radius R, length. For two cylinders 1/R = 1/R_1 + 1/R_2.
        modulus: Contact modulus E*, force/area; see `contact_modulus`.
        friction: Coefficient of friction mu.
        tangential: Tangential force Q per unit of length, from 0 to mu N.

    Raises:
        ValueError: If an argument is not positive, or the tangential force is negative or above
            mu N, where the cylinders slide.
    """

    friction: float
    tangential: float

    def __post_init__(self) -> None:
        """Check the arguments."""
        super().__post_init__()
        check_positive(friction=self.friction)
        limit = self.friction * self.force
        if not 0 <= self.tangential <= limit:
            raise ValueError(
                f"tangential is {self.tangential}; give a force from 0 to {limit}, "
                "which is friction * force."
            )

    @property
    def stick_half_width(self) -> float:
        """Half the width of the strip that sticks, c = b sqrt(1 - Q / (mu N)), length."""
        return self.half_width * math.sqrt(1 - self.tangential / (self.friction * self.force))

    def shear(self, x: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Evaluate the shear traction, that of sliding less what the stick zone does not need.

        q(x) = mu p_0 [sqrt(1 - (x/b)^2) - (c/b) sqrt(1 - (x/c)^2)], each root zero outside its
        strip.

        Args:
            x: Distances from the middle line, length, any shape.

        Returns:
            The shear tractions in the direction of Q, force/area, in the shape of x.
        """
        x = np.asarray(x, dtype=np.float64)
        b, c = self.half_width, self.stick_half_width
        # (c/b) sqrt(1 - (x/c)^2), which is fine without a stick zone, too
        stuck = np.sqrt(np.maximum(c**2 - x**2, 0)) / b
        return self.friction * (self.pressure(x) - self.peak_pressure * stuck)
