# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of Hertz's line contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference import HertzCylinder

HERTZ = HertzCylinder(force=3.0, radius=2.0, modulus=50.0)


def test_pressure_integrates_to_the_force() -> None:
    """Gauss quadrature in x = b sin(t), where the integrand is smooth."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    t, weights = nodes * math.pi / 2, weights * math.pi / 2
    b = HERTZ.half_width
    force = np.sum(weights * HERTZ.pressure(b * np.sin(t)) * b * np.cos(t))
    assert force == pytest.approx(HERTZ.force, rel=1e-10)


def test_peak_pressure_without_the_half_width() -> None:
    """Two independent forms: p_0 = sqrt(F E* / (pi R)) and p_0 = E* b / (2 R)."""
    expected = math.sqrt(HERTZ.force * HERTZ.modulus / (math.pi * HERTZ.radius))
    assert HERTZ.peak_pressure == pytest.approx(expected)
    expected = HERTZ.modulus * HERTZ.half_width / (2 * HERTZ.radius)
    assert HERTZ.peak_pressure == pytest.approx(expected)


def test_limits_of_the_pressure() -> None:
    """The peak in the middle, zero at the edge and beyond, even in x, any shape."""
    b = HERTZ.half_width
    assert HERTZ.pressure(0.0) == pytest.approx(HERTZ.peak_pressure)
    x = np.array([[0.0, 0.5 * b], [b * (1 + 1e-12), 7 * b]])
    assert HERTZ.pressure(x).shape == (2, 2)
    assert np.all(HERTZ.pressure(x)[1] == 0)
    assert np.array_equal(HERTZ.pressure(-x), HERTZ.pressure(x))


def test_units() -> None:
    """Metres turn into millimetres; the force is one per length."""
    si = HertzCylinder(force=1e5, radius=5e-3, modulus=1e11)
    mm = HertzCylinder(force=1e2, radius=5.0, modulus=1e5)
    assert mm.half_width == pytest.approx(1e3 * si.half_width)
    assert mm.peak_pressure == pytest.approx(1e-6 * si.peak_pressure)


@pytest.mark.parametrize(
    ("name", "value"),
    [("force", 0.0), ("radius", -1.0), ("modulus", math.nan), ("force", math.inf)],
)
def test_bad_input(name: str, value: float) -> None:
    """The message names the argument and its value."""
    arguments = {"force": 1.0, "radius": 1.0, "modulus": 1.0, name: value}
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        HertzCylinder(**arguments)
