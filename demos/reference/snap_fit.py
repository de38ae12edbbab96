# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A cantilever hook that is pushed over a catch, by beam theory."""

from __future__ import annotations

from dataclasses import dataclass

from reference.checks import check_positive


@dataclass(frozen=True)
class SnapFit:
    """Forces of a cantilever hook per unit of width, plane strain.

    Sources: Snap-Fit Joints for Plastics, a design guide, Bayer MaterialScience, 2013, for the
    mating force W = P (mu + tan a)/(1 - mu tan a) of a ramp of angle a; S. P. Timoshenko and
    J. M. Gere, Theory of Elastic Stability, McGraw-Hill, 1961, chapter 1, for the beam that is
    compressed by W as it is bent; S. P. Timoshenko, Strength of Materials, for shear.

    Attributes:
        young: Young's modulus, force/area.
        nu: Poisson's ratio.
        length: Of the beam, from its root to the nose.
        thickness: Of the beam.
        depth: From the beam's axis to the centre of the round nose.
        nose: Radius of the nose.
        friction: Coulomb's coefficient.

    Raises:
        ValueError: If a modulus or a length is not positive.
    """

    young: float
    nu: float
    length: float
    thickness: float
    depth: float
    nose: float
    friction: float

    def __post_init__(self) -> None:
        """Check the arguments."""
        names = ("young", "length", "thickness", "depth", "nose")
        check_positive(**{name: getattr(self, name) for name in names})

    @property
    def bending_stiffness(self) -> float:
        """E t^3 / (12 (1 - nu^2)), force times length."""
        return self.young / (1 - self.nu**2) * self.thickness**3 / 12

    def ratio(self, slope: float, way: int = 1) -> float:
        """Force along the beam over that across it, both of the catch on the hook.

        Args:
            slope: Tangent of the ramp's angle, positive where the nose climbs on the way in.
            way: 1 on the way in, -1 on the way out.
        """
        mu = way * self.friction
        return (mu + slope) / (1 - mu * slope)

    def textbook_force(self, deflection: float, slope: float, way: int = 1) -> float:
        """Force that pushes the hook with P = 3 E I y / l^3, and nothing else.

        Args:
            deflection: Of the beam at the nose, a length.
            slope: Tangent of the ramp's angle.
            way: 1 on the way in, -1 on the way out.
        """
        deflection_force = 3 * self.bending_stiffness * deflection / self.length**3
        return deflection_force * self.ratio(slope, way)

    def state(self, deflection: float, slope: float, way: int = 1) -> tuple[float, float, float]:
        """Forces of the hook, and its nose's movement along the beam.

        Beam theory of the second order: with shear, with the force along the beam, which
        acts off its axis where the nose touches.

        Args:
            deflection: Of the nose, a length.
            slope: Tangent of the ramp's angle.
            way: 1 on the way in, -1 on the way out.

        Returns:
            Force across the beam, force that pushes it, and how far the nose's centre is ahead of
            where its root has it, a length.
        """
        length, ei = self.length, self.bending_stiffness
        ratio = self.ratio(slope, way)
        cosine = (1 + slope**2) ** -0.5
        # Moment at the nose over the force across the beam
        arm = self.nose * slope * cosine - (self.depth + self.nose * cosine) * ratio
        shear_modulus = self.young / (2 * (1 + self.nu))
        shear = 6 * length / (5 * shear_modulus * self.thickness)
        force = 0.0
        for _ in range(50):
            squared = force * ratio * length**2 / ei
            # tan u and 1/cos u in series: u^2 is small, and negative where the beam is pulled
            by_force = 1 + 2 * squared / 5 + 17 * squared**2 / 105
            by_moment = 1 + 5 * squared / 12 + 61 * squared**2 / 360
            compliance = length**3 / (3 * ei) * by_force + length**2 / (2 * ei) * arm * by_moment
            force = deflection / (compliance + shear)
        turn = force * (length**2 / 2 + arm * length) / ei
        shorter = 0.6 * deflection**2 / length + force * ratio * length * (1 - self.nu**2) / (
            self.young * self.thickness
        )
        return force, force * ratio, self.depth * turn - shorter
