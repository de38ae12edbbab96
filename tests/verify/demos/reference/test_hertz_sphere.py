# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of Hertz's point contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

from reference import HertzSphere, contact_modulus

HERTZ = HertzSphere(force=3.0, radius=2.0, modulus=50.0)


def test_pressure_integrates_to_the_force() -> None:
    """Gauss quadrature in r = a sin(t), where the integrand is smooth."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    t, weights = (nodes + 1) * math.pi / 4, weights * math.pi / 4
    a = HERTZ.contact_radius
    r = a * np.sin(t)
    force = np.sum(weights * HERTZ.pressure(r) * 2 * math.pi * r * a * np.cos(t))
    assert force == pytest.approx(HERTZ.force, rel=1e-10)


def test_values_of_a_bearing_ball() -> None:
    """A steel ball of 10 mm on a steel plate under 100 N, worked out by hand, in mm and MPa."""
    modulus = contact_modulus(210e3, 0.3, 210e3, 0.3)
    hertz = HertzSphere(force=100.0, radius=5.0, modulus=modulus)
    assert modulus == pytest.approx(1.5e6 / 13)
    assert hertz.contact_radius == pytest.approx(0.00325 ** (1 / 3))
    assert hertz.approach == pytest.approx(0.0043882, rel=1e-4)
    assert hertz.peak_pressure == pytest.approx(2176.2, rel=1e-4)


def test_peak_pressure_follows_from_the_strain_of_the_sphere() -> None:
    """An independent form: p_0 = 2 E* a / (pi R)."""
    expected = 2 * HERTZ.modulus * HERTZ.contact_radius / (math.pi * HERTZ.radius)
    assert HERTZ.peak_pressure == pytest.approx(expected)


def test_work_of_the_force_is_the_elastic_energy() -> None:
    """The force is the derivative of the energy: F = 4/3 E* sqrt(R) approach^(3/2)."""
    expected = 4 / 3 * HERTZ.modulus * math.sqrt(HERTZ.radius) * HERTZ.approach**1.5
    assert HERTZ.force == pytest.approx(expected)


def test_limits_of_the_pressure() -> None:
    """The peak in the centre, zero at the edge and beyond, even in r, any shape."""
    a = HERTZ.contact_radius
    assert HERTZ.pressure(0.0) == pytest.approx(HERTZ.peak_pressure)
    r = np.array([[0.0, 0.5 * a], [a * (1 + 1e-12), 7 * a]])
    assert HERTZ.pressure(r).shape == (2, 2)
    assert np.all(HERTZ.pressure(r)[1] == 0)
    assert np.array_equal(HERTZ.pressure(-r), HERTZ.pressure(r))


def test_units() -> None:
    """Metres and newtons turn into millimetres and newtons."""
    si = HertzSphere(force=100.0, radius=5e-3, modulus=1e11)
    mm = HertzSphere(force=100.0, radius=5.0, modulus=1e5)
    assert mm.contact_radius == pytest.approx(1e3 * si.contact_radius)
    assert mm.approach == pytest.approx(1e3 * si.approach)
    assert mm.peak_pressure == pytest.approx(1e-6 * si.peak_pressure)


@pytest.mark.parametrize(
    ("name", "value"),
    [("force", 0.0), ("radius", -1.0), ("modulus", math.nan), ("force", math.inf)],
)
def test_bad_input(name: str, value: float) -> None:
    """The message names the argument and its value."""
    arguments = {"force": 1.0, "radius": 1.0, "modulus": 1.0, name: value}
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        HertzSphere(**arguments)
