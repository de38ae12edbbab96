# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the partial slip of cylinders."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest

from reference import CattaneoMindlin, HertzCylinder, contact_modulus

# Two cylinders of radius 8, E = 200, nu = 0.3
PAIR = CattaneoMindlin(
    force=10.0,
    radius=4.0,
    modulus=contact_modulus(200, 0.3, 200, 0.3),
    friction=0.2,
    tangential=0.93616,
)


def strip(half_width: float) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Points and weights for integrands like sqrt(w^2 - x^2), by x = w sin(t)."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    t = nodes * math.pi / 2
    return half_width * np.sin(t), weights * math.pi / 2 * half_width * np.cos(t)


def integral_of_shear(exact: CattaneoMindlin) -> float:
    """Integrate over the stick zone and the slip zone beside it, where the shear is smooth."""
    b, c = exact.half_width, exact.stick_half_width
    x, weights = strip(c)
    inside = weights @ exact.shear(x)
    # From c to b by x = b - (b - c) s^2, which takes the root out of both ends
    nodes, weights = np.polynomial.legendre.leggauss(200)
    s, weights = (nodes + 1) / 2, weights / 2
    outside = weights @ (exact.shear(b - (b - c) * s**2) * 2 * (b - c) * s)
    return float(inside + 2 * outside)


def test_published_problem() -> None:
    """Figures of the pair of cylinders of radius 8 that codes are compared with."""
    assert PAIR.half_width == pytest.approx(0.6808, abs=5e-5)
    assert PAIR.peak_pressure == pytest.approx(9.351, abs=5e-4)
    assert PAIR.stick_half_width == pytest.approx(0.4965, abs=5e-5)


def test_pressure_is_that_of_hertz() -> None:
    """The tangential force does not change it, and it carries the normal force."""
    hertz = HertzCylinder(force=PAIR.force, radius=PAIR.radius, modulus=PAIR.modulus)
    x, weights = strip(PAIR.half_width)
    assert np.array_equal(PAIR.pressure(x), hertz.pressure(x))
    assert weights @ PAIR.pressure(x) == pytest.approx(PAIR.force, rel=1e-10)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99, 1.0])
def test_shear_integrates_to_the_tangential_force(share: float) -> None:
    """From no force to sliding."""
    exact = replace(PAIR, tangential=share * PAIR.friction * PAIR.force)
    assert integral_of_shear(exact) == pytest.approx(exact.tangential, rel=1e-5, abs=1e-12)


def test_coulomb_holds() -> None:
    """Shear of mu p in the slip zone, less inside, none outside, even in x, any shape."""
    b, c = PAIR.half_width, PAIR.stick_half_width
    slip, stick = np.linspace(c, b, 50), np.linspace(-c, c, 51)[1:-1]
    assert np.allclose(PAIR.shear(slip), PAIR.friction * PAIR.pressure(slip))
    assert np.all(PAIR.shear(stick) < PAIR.friction * PAIR.pressure(stick))
    assert np.all(PAIR.shear(stick) > 0)
    assert np.array_equal(PAIR.shear(-stick), PAIR.shear(stick))
    outside = np.array([[b * (1 + 1e-12), 7 * b]])
    assert np.array_equal(PAIR.shear(outside), [[0.0, 0.0]])
    assert PAIR.shear(0.0) == pytest.approx(PAIR.friction * PAIR.peak_pressure * (1 - c / b))


def test_limits() -> None:
    """Without a force all sticks and nothing shears; at mu N nothing sticks."""
    x = np.linspace(-1, 1, 101)
    resting = replace(PAIR, tangential=0.0)
    assert resting.stick_half_width == resting.half_width
    assert np.allclose(resting.shear(x), 0, atol=1e-12)
    sliding = replace(PAIR, tangential=PAIR.friction * PAIR.force)
    assert sliding.stick_half_width == 0
    assert np.allclose(sliding.shear(x), PAIR.friction * sliding.pressure(x))


def test_units() -> None:
    """Metres turn into millimetres; forces are per length."""
    si = CattaneoMindlin(force=1e5, radius=5e-3, modulus=1e11, friction=0.3, tangential=1e4)
    mm = CattaneoMindlin(force=1e2, radius=5.0, modulus=1e5, friction=0.3, tangential=1e1)
    assert mm.stick_half_width == pytest.approx(1e3 * si.stick_half_width)
    assert mm.shear(0.02) == pytest.approx(1e-6 * si.shear(2e-5))


@pytest.mark.parametrize(
    ("name", "value"),
    [("force", 0.0), ("radius", -1.0), ("modulus", math.nan), ("friction", math.inf)],
)
def test_bad_input(name: str, value: float) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        replace(PAIR, tangential=0.0, **{name: value})


@pytest.mark.parametrize("value", [-0.1, 2.1, math.nan, math.inf])
def test_bad_tangential_force(value: float) -> None:
    """The message names the range."""
    with pytest.raises(ValueError, match=f"tangential is {value}; give a force from 0 to 2.0"):
        replace(PAIR, tangential=value)
