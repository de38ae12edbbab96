# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of Lame's press fit."""

from __future__ import annotations

import math
from dataclasses import asdict, replace

import numpy as np
import pytest

from reference import PressFit

FIT = PressFit(
    interference=0.02,
    bore=1.0,
    radius=1.5,
    rim=2.2,
    young_inner=3.0,
    nu_inner=0.2,
    young_outer=7.0,
    nu_outer=0.4,
)


def radial_field(
    a: float, b: float, young: float, nu: float, stress_a: float, stress_b: float
) -> tuple[float, float, float]:
    """Solve u = A r + B/r for radial stresses on both faces; displacements and inner hoop stress.

    Plane strain by the three-dimensional law, without the constants of plane stress.
    """
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    matrix = [[2 * (mu + lmbda), -2 * mu / r**2] for r in (a, b)]
    A, B = np.linalg.solve(matrix, [stress_a, stress_b])
    hoop = 2 * (mu + lmbda) * A + 2 * mu * B / a**2
    return float(A * a + B / a), float(A * b + B / b), float(hoop)


def test_displacements_differ_by_the_interference() -> None:
    """The inner ring's outer face meets the outer ring's inner face."""
    assert FIT.inner_displacement < 0 < FIT.outer_displacement
    difference = FIT.outer_displacement - FIT.inner_displacement
    assert difference == pytest.approx(FIT.interference, rel=1e-14)


def test_each_ring_solves_its_boundary_value_problem() -> None:
    """An independent solution, from the general one of plane strain."""
    p = FIT.pressure
    bore, interface, hoop = radial_field(1.0, 1.5, 3.0, 0.2, 0.0, -p)
    assert FIT.bore_displacement == pytest.approx(bore)
    assert FIT.inner_displacement == pytest.approx(interface)
    assert FIT.bore_hoop_stress == pytest.approx(hoop)
    interface, rim, _ = radial_field(1.5, 2.2, 7.0, 0.4, -p, 0.0)
    assert FIT.outer_displacement == pytest.approx(interface)
    assert FIT.rim_displacement == pytest.approx(rim)


def test_rings_of_one_material() -> None:
    """Poisson's ratio drops out but for E': the formula of textbooks on machine parts."""
    fit = replace(FIT, young_outer=3.0, nu_outer=0.2)
    a2, b2, c2 = fit.bore**2, fit.radius**2, fit.rim**2
    modulus = 3.0 / (1 - 0.2**2)
    expected = modulus * fit.interference / fit.radius
    expected *= (c2 - b2) * (b2 - a2) / (2 * b2 * (c2 - a2))
    assert fit.pressure == pytest.approx(expected)


def test_thin_rings() -> None:
    """Two equally thin rings share the interference, with hoop stresses p R / t."""
    t, radius = 1e-4, 1.0
    fit = PressFit(1e-6, radius - t, radius, radius + t, 2.0, 0.3, 2.0, 0.3)
    assert -fit.inner_displacement == pytest.approx(fit.outer_displacement, rel=1e-3)
    assert fit.bore_hoop_stress == pytest.approx(-fit.pressure * radius / t, rel=1e-3)
    assert fit.pressure == pytest.approx(2.0 / (1 - 0.3**2) * t * 0.5e-6, rel=1e-3)


def test_stiff_outer_ring_does_not_move() -> None:
    """The inner ring takes all of the interference, and the other way round."""
    fit = replace(FIT, young_outer=1e12)
    assert fit.inner_displacement == pytest.approx(-FIT.interference)
    fit = replace(FIT, young_inner=1e12)
    assert fit.outer_displacement == pytest.approx(FIT.interference)


def test_solid_shaft_in_a_wide_plate() -> None:
    """A tiny bore and an endless plate, of one incompressible material: c_1 = 0, c_2 = 2 b/E'."""
    fit = PressFit(0.01, 1e-6, 1.0, 1e6, 1.0, 0.5, 1.0, 0.5)
    assert fit.inner_displacement == pytest.approx(0, abs=1e-12)
    assert fit.pressure == pytest.approx(0.01 / (2 * (1 - 0.5**2)))


def test_linear_in_the_interference() -> None:
    """Twice as tight, twice the pressure."""
    assert replace(FIT, interference=0.04).pressure == pytest.approx(2 * FIT.pressure)


def test_units() -> None:
    """Metres turn into millimetres."""
    si = PressFit(1e-5, 0.01, 0.02, 0.03, 2e11, 0.3, 1e11, 0.25)
    mm = PressFit(1e-2, 10.0, 20.0, 30.0, 2e5, 0.3, 1e5, 0.25)
    assert mm.pressure == pytest.approx(1e-6 * si.pressure)
    assert mm.bore_hoop_stress == pytest.approx(1e-6 * si.bore_hoop_stress)
    for name in ("inner", "outer", "bore", "rim"):
        lengths = (getattr(fit, f"{name}_displacement") for fit in (mm, si))
        assert next(lengths) == pytest.approx(1e3 * next(lengths))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("interference", 0.0),
        ("bore", -1.0),
        ("radius", math.nan),
        ("rim", math.inf),
        ("young_inner", 0.0),
        ("young_outer", -1.0),
    ],
)
def test_bad_input(name: str, value: float) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        PressFit(**{**asdict(FIT), name: value})


@pytest.mark.parametrize(
    ("name", "value"), [("nu_inner", -1.0), ("nu_outer", 0.6), ("nu_inner", math.nan)]
)
def test_bad_ratio(name: str, value: float) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=rf"{name} is {value}; give a Poisson's ratio"):
        PressFit(**{**asdict(FIT), name: value})


@pytest.mark.parametrize(("bore", "rim"), [(1.5, 2.0), (1.6, 2.0), (1.0, 1.5), (1.0, 1.4)])
def test_bad_order(bore: float, rim: float) -> None:
    """The radii have to increase."""
    with pytest.raises(ValueError, match=f"bore, radius and rim are {bore}, 1.5 and {rim}"):
        replace(FIT, bore=bore, rim=rim)
