# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A ring that is pressed into another one, after Lame."""

from __future__ import annotations

from dataclasses import dataclass

from reference.checks import check_positive


@dataclass(frozen=True)
class PressFit:
    """Lame's solution of two thick rings that interfere, frictionless and in plane strain.

    Source: S. P. Timoshenko and J. N. Goodier, Theory of Elasticity, McGraw-Hill, 1970, chapter 4,
    the part on stress symmetrical about an axis. It holds while the interference is small beside
    the radii. In plane strain E and nu of plane stress become E/(1 - nu^2) and nu/(1 - nu).

    Attributes:
        interference: Outer radius of the inner ring less inner radius of the outer ring, both
            before they are fitted, length.
        bore: Inner radius of the inner ring, length.
        radius: Radius of the interface, length.
        rim: Outer radius of the outer ring, length.
        young_inner: Young's modulus of the inner ring, force/area.
        nu_inner: Poisson's ratio of the inner ring.
        young_outer: Young's modulus of the outer ring, force/area.
        nu_outer: Poisson's ratio of the outer ring.

    Raises:
        ValueError: If a length or a modulus is not positive, the radii do not increase, or a
            Poisson's ratio is outside (-1, 0.5].
    """

    interference: float
    bore: float
    radius: float
    rim: float
    young_inner: float
    nu_inner: float
    young_outer: float
    nu_outer: float

    def __post_init__(self) -> None:
        """Check the arguments."""
        names = ("interference", "bore", "radius", "rim", "young_inner", "young_outer")
        check_positive(**{name: getattr(self, name) for name in names})
        if not self.bore < self.radius < self.rim:
            raise ValueError(
                f"bore, radius and rim are {self.bore}, {self.radius} and {self.rim}; "
                "give numbers that increase."
            )
        for name in ("nu_inner", "nu_outer"):
            nu = getattr(self, name)
            if not -1 < nu <= 0.5:
                raise ValueError(f"{name} is {nu}; give a Poisson's ratio in (-1, 0.5].")

    @property
    def _inner_compliance(self) -> float:
        """Inward displacement of the inner ring's outer face by a pressure of one on it."""
        a2, b2, nu = self.bore**2, self.radius**2, self.nu_inner
        ratio = (b2 + a2) / (b2 - a2) - nu / (1 - nu)
        return self.radius * (1 - nu**2) / self.young_inner * ratio

    @property
    def _outer_compliance(self) -> float:
        """Outward displacement of the outer ring's inner face by a pressure of one on it."""
        b2, c2, nu = self.radius**2, self.rim**2, self.nu_outer
        ratio = (c2 + b2) / (c2 - b2) + nu / (1 - nu)
        return self.radius * (1 - nu**2) / self.young_outer * ratio

    @property
    def pressure(self) -> float:
        """Pressure between the rings, force/area."""
        return self.interference / (self._inner_compliance + self._outer_compliance)

    @property
    def inner_displacement(self) -> float:
        """Radial displacement of the inner ring at the interface, length, negative."""
        return -self.pressure * self._inner_compliance

    @property
    def outer_displacement(self) -> float:
        """Radial displacement of the outer ring at the interface, length, positive."""
        return self.pressure * self._outer_compliance

    @property
    def bore_hoop_stress(self) -> float:
        """Hoop stress in the bore, -2 p b^2 / (b^2 - a^2), force/area, negative."""
        a2, b2 = self.bore**2, self.radius**2
        return -2 * self.pressure * b2 / (b2 - a2)

    @property
    def bore_displacement(self) -> float:
        """Radial displacement of the bore, length, negative."""
        strain = (1 - self.nu_inner**2) / self.young_inner * self.bore_hoop_stress
        return self.bore * strain

    @property
    def rim_displacement(self) -> float:
        """Radial displacement of the rim, length, positive."""
        b2, c2 = self.radius**2, self.rim**2
        hoop = 2 * self.pressure * b2 / (c2 - b2)
        return self.rim * (1 - self.nu_outer**2) / self.young_outer * hoop
