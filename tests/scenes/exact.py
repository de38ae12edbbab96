# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Exact solutions of two elastic bodies in frictionless contact on the face of height zero.

In both the bodies have the same pressure and no shear on the face.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import ufl

from meshes import Tag

Array = npt.NDArray[np.float64]
YOUNG, NU = {Tag.UPPER: 1.0, Tag.LOWER: 3.0}, 0.3
# Slip of each body
_SLIP = {Tag.UPPER: 0.05, Tag.LOWER: -0.08}
# Hertz: middle and half-width of the contact, peak pressure; length of the blocks
MIDDLE, HALF_WIDTH, PEAK = 1.03, 0.37, 0.1
LENGTH = 2.0


def stress(u: Any, body: Tag) -> Any:
    """Stress of linear elasticity, in plane strain where the space is plane."""
    mu, lmbda = _lame(body)
    strain = ufl.sym(ufl.grad(u))
    return 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(len(u))


def smooth(x: Any, body: Tag, *, slips: bool = True) -> Any:
    """A displacement that slips along the face and bends it.

    With the height y it is -y grad g + k along the face and g + y q + y^2 g across it, which has
    no shear at y = 0; q follows from the pressure. g and q are the same in both bodies but for
    their moduli, the slip k is not.

    Args:
        slips: Whether k is not zero; without it the displacement is continuous.
    """
    mu, lmbda = _lame(body)
    along = range(len(x) - 1)
    y = x[len(x) - 1]
    g = sum(0.1 * ufl.sin(3 * x[i] + 1 + i) for i in along)
    k = [_SLIP[body] * ufl.cos(2 * x[i]) for i in along] if slips else [0.0] * len(along)
    stretch = sum(k[i].dx(i) for i in along) if slips else 0
    q = -(smooth_pressure(x) + lmbda * stretch) / (lmbda + 2 * mu)
    return ufl.as_vector([*(k[i] - y * g.dx(i) for i in along), g + y * q + y**2 * g])


def smooth_pressure(x: Any, cos: Any = ufl.cos) -> Any:
    """Its pressure on the face, positive everywhere."""
    return 0.2 + sum(0.1 * cos(4 * x[i]) for i in range(len(x) - 1))


def hertz(x: Array, body: Tag, middle: float = MIDDLE) -> Array:
    """Displacement of a half-plane under Hertz's pressure, up to a rigid motion.

    Source: H. M. Westergaard, Bearing pressures and cracks, J. Appl. Mech. 6, 1939: for a face
    without shear an analytic function Z gives 2 mu u = (1 - 2 nu) Re W - y Im Z and
    2 mu v = 2 (1 - nu) Im W - y Re Z with W' = Z. Here Z = -(p0/b) (sqrt(b^2 - z^2) - i z) in the
    lower half-plane, whose real part is minus Hertz's pressure on its edge, and the upper one is
    its mirror image.
    """
    mu, _ = _lame(body)
    up = 1.0 if body == Tag.UPPER else -1.0
    # On the edge the values are those from within
    y = np.minimum(-up * x[1], -1e-14)
    z, b = x[0] - middle + 1j * y, HALF_WIDTH
    root = np.sqrt(b**2 - z**2)
    Z = -(PEAK / b) * (root - 1j * z)
    W = -(PEAK / b) * ((z * root + b**2 * np.arcsin(z / b)) / 2 - 1j * z**2 / 2)
    along = (1 - 2 * NU) * W.real - y * Z.imag
    across = 2 * (1 - NU) * W.imag - y * Z.real
    return np.stack([along, -up * across]) / (2 * mu)


def hertz_gap(x: Array, middle: float = MIDDLE) -> Array:
    """Gap of the undeformed bodies: a parabola that their displacements close in the contact."""
    bend = sum((1 - NU**2) / young for young in YOUNG.values())
    return np.asarray(bend * PEAK / HALF_WIDTH * (x - middle) ** 2)


def hertz_pressure(x: Array, middle: float = MIDDLE) -> Array:
    """Hertz's pressure on the face."""
    ratio = (x - middle) / HALF_WIDTH
    return np.asarray(PEAK * np.sqrt(np.maximum(1 - ratio**2, 0)))


def _lame(body: Tag) -> Sequence[float]:
    young = YOUNG[body]
    return young / (2 * (1 + NU)), young * NU / ((1 + NU) * (1 - 2 * NU))
