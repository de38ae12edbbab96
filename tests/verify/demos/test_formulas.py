# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Closed formulas that demos and tests compare with; for what they refuse see tests/fast/input."""

import math
from dataclasses import replace

import numpy as np
import pytest

from reference import CattaneoMindlin, HertzCylinder, HertzSphere, PressFit, contact_modulus


def test_equal_bodies_are_half_as_stiff_as_one_on_a_rigid_body():
    """Two springs in series."""
    rigid = contact_modulus(200.0, 0.3, math.inf, 0.0)
    assert rigid == pytest.approx(200.0 / (1 - 0.3**2))
    assert contact_modulus(200.0, 0.3, 200.0, 0.3) == pytest.approx(rigid / 2)


def test_order_does_not_matter():
    """The modulus is symmetric in the bodies."""
    assert contact_modulus(1.0, 0.2, 5.0, 0.4) == contact_modulus(5.0, 0.4, 1.0, 0.2)


SPHERE = HertzSphere(force=3.0, radius=2.0, modulus=50.0)


def test_pressure_of_spheres_integrates_to_the_force():
    """Gauss quadrature in r = a sin(t), where the integrand is smooth."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    t, weights = (nodes + 1) * math.pi / 4, weights * math.pi / 4
    a = SPHERE.contact_radius
    r = a * np.sin(t)
    force = np.sum(weights * SPHERE.pressure(r) * 2 * math.pi * r * a * np.cos(t))
    assert force == pytest.approx(SPHERE.force, rel=1e-10)


def test_values_of_a_bearing_ball():
    """A steel ball of 10 mm on a steel plate under 100 N, worked out by hand, in mm and MPa."""
    modulus = contact_modulus(210e3, 0.3, 210e3, 0.3)
    hertz = HertzSphere(force=100.0, radius=5.0, modulus=modulus)
    assert modulus == pytest.approx(1.5e6 / 13)
    assert hertz.contact_radius == pytest.approx(0.00325 ** (1 / 3))
    assert hertz.approach == pytest.approx(0.0043882, rel=1e-4)
    assert hertz.peak_pressure == pytest.approx(2176.2, rel=1e-4)


def test_peak_pressure_follows_from_the_strain_of_the_sphere():
    """An independent form: p_0 = 2 E* a / (pi R)."""
    expected = 2 * SPHERE.modulus * SPHERE.contact_radius / (math.pi * SPHERE.radius)
    assert SPHERE.peak_pressure == pytest.approx(expected)


def test_work_of_the_force_is_the_elastic_energy():
    """The force is the derivative of the energy: F = 4/3 E* sqrt(R) approach^(3/2)."""
    expected = 4 / 3 * SPHERE.modulus * math.sqrt(SPHERE.radius) * SPHERE.approach**1.5
    assert SPHERE.force == pytest.approx(expected)


def test_units_of_spheres():
    """Metres and newtons turn into millimetres and newtons."""
    si = HertzSphere(force=100.0, radius=5e-3, modulus=1e11)
    mm = HertzSphere(force=100.0, radius=5.0, modulus=1e5)
    assert mm.contact_radius == pytest.approx(1e3 * si.contact_radius)
    assert mm.approach == pytest.approx(1e3 * si.approach)
    assert mm.peak_pressure == pytest.approx(1e-6 * si.peak_pressure)


CYLINDER = HertzCylinder(force=3.0, radius=2.0, modulus=50.0)


def test_pressure_of_cylinders_integrates_to_the_force():
    """Gauss quadrature in x = b sin(t), where the integrand is smooth."""
    nodes, weights = np.polynomial.legendre.leggauss(30)
    t, weights = nodes * math.pi / 2, weights * math.pi / 2
    b = CYLINDER.half_width
    force = np.sum(weights * CYLINDER.pressure(b * np.sin(t)) * b * np.cos(t))
    assert force == pytest.approx(CYLINDER.force, rel=1e-10)


def test_peak_pressure_without_the_half_width():
    """Two independent forms: p_0 = sqrt(F E* / (pi R)) and p_0 = E* b / (2 R)."""
    expected = math.sqrt(CYLINDER.force * CYLINDER.modulus / (math.pi * CYLINDER.radius))
    assert CYLINDER.peak_pressure == pytest.approx(expected)
    expected = CYLINDER.modulus * CYLINDER.half_width / (2 * CYLINDER.radius)
    assert CYLINDER.peak_pressure == pytest.approx(expected)


@pytest.mark.parametrize(
    ("hertz", "edge"), [(SPHERE, SPHERE.contact_radius), (CYLINDER, CYLINDER.half_width)]
)
def test_limits_of_the_pressure(hertz, edge):
    """The peak in the middle, zero at the edge and beyond, even, any shape."""
    assert hertz.pressure(0.0) == pytest.approx(hertz.peak_pressure)
    x = np.array([[0.0, 0.5 * edge], [edge * (1 + 1e-12), 7 * edge]])
    assert hertz.pressure(x).shape == (2, 2)
    assert np.all(hertz.pressure(x)[1] == 0)
    assert np.array_equal(hertz.pressure(-x), hertz.pressure(x))


def test_units_of_cylinders():
    """Metres turn into millimetres; the force is one per length."""
    si = HertzCylinder(force=1e5, radius=5e-3, modulus=1e11)
    mm = HertzCylinder(force=1e2, radius=5.0, modulus=1e5)
    assert mm.half_width == pytest.approx(1e3 * si.half_width)
    assert mm.peak_pressure == pytest.approx(1e-6 * si.peak_pressure)


# Two cylinders of radius 8, E = 200, nu = 0.3
PAIR = CattaneoMindlin(
    force=10.0,
    radius=4.0,
    modulus=contact_modulus(200, 0.3, 200, 0.3),
    friction=0.2,
    tangential=0.93616,
)


def strip(half_width):
    """Points and weights for integrands like sqrt(w^2 - x^2), by x = w sin(t)."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    t = nodes * math.pi / 2
    return half_width * np.sin(t), weights * math.pi / 2 * half_width * np.cos(t)


def integral_of_shear(exact):
    """Integrate over the stick zone and the slip zone beside it, where the shear is smooth."""
    b, c = exact.half_width, exact.stick_half_width
    x, weights = strip(c)
    inside = weights @ exact.shear(x)
    # From c to b by x = b - (b - c) s^2, which takes the root out of both ends
    nodes, weights = np.polynomial.legendre.leggauss(200)
    s, weights = (nodes + 1) / 2, weights / 2
    outside = weights @ (exact.shear(b - (b - c) * s**2) * 2 * (b - c) * s)
    return float(inside + 2 * outside)


def test_published_problem():
    """Figures of the pair of cylinders of radius 8 that codes are compared with."""
    assert PAIR.half_width == pytest.approx(0.6808, abs=5e-5)
    assert PAIR.peak_pressure == pytest.approx(9.351, abs=5e-4)
    assert PAIR.stick_half_width == pytest.approx(0.4965, abs=5e-5)


def test_pressure_is_that_of_hertz():
    """The tangential force does not change it, and it carries the normal force."""
    hertz = HertzCylinder(force=PAIR.force, radius=PAIR.radius, modulus=PAIR.modulus)
    x, weights = strip(PAIR.half_width)
    assert np.array_equal(PAIR.pressure(x), hertz.pressure(x))
    assert weights @ PAIR.pressure(x) == pytest.approx(PAIR.force, rel=1e-10)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99, 1.0])
def test_shear_integrates_to_the_tangential_force(share):
    """From no force to sliding."""
    exact = replace(PAIR, tangential=share * PAIR.friction * PAIR.force)
    assert integral_of_shear(exact) == pytest.approx(exact.tangential, rel=1e-5, abs=1e-12)


def test_coulomb_holds():
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


def test_limits():
    """Without a force all sticks and nothing shears; at mu N nothing sticks."""
    x = np.linspace(-1, 1, 101)
    resting = replace(PAIR, tangential=0.0)
    assert resting.stick_half_width == resting.half_width
    assert np.allclose(resting.shear(x), 0, atol=1e-12)
    sliding = replace(PAIR, tangential=PAIR.friction * PAIR.force)
    assert sliding.stick_half_width == 0
    assert np.allclose(sliding.shear(x), PAIR.friction * sliding.pressure(x))


def test_units_of_pairs():
    """Metres turn into millimetres; forces are per length."""
    si = CattaneoMindlin(force=1e5, radius=5e-3, modulus=1e11, friction=0.3, tangential=1e4)
    mm = CattaneoMindlin(force=1e2, radius=5.0, modulus=1e5, friction=0.3, tangential=1e1)
    assert mm.stick_half_width == pytest.approx(1e3 * si.stick_half_width)
    assert mm.shear(0.02) == pytest.approx(1e-6 * si.shear(2e-5))


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


def radial_field(a, b, young, nu, stress_a, stress_b):
    """Solve u = A r + B/r for radial stresses on both faces; displacements and inner hoop stress.

    Plane strain by the three-dimensional law, without the constants of plane stress.
    """
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    matrix = [[2 * (mu + lmbda), -2 * mu / r**2] for r in (a, b)]
    A, B = np.linalg.solve(matrix, [stress_a, stress_b])
    hoop = 2 * (mu + lmbda) * A + 2 * mu * B / a**2
    return float(A * a + B / a), float(A * b + B / b), float(hoop)


def test_displacements_differ_by_the_interference():
    """The inner ring's outer face meets the outer ring's inner face."""
    assert FIT.inner_displacement < 0 < FIT.outer_displacement
    difference = FIT.outer_displacement - FIT.inner_displacement
    assert difference == pytest.approx(FIT.interference, rel=1e-14)


def test_each_ring_solves_its_boundary_value_problem():
    """An independent solution, from the general one of plane strain."""
    p = FIT.pressure
    bore, interface, hoop = radial_field(1.0, 1.5, 3.0, 0.2, 0.0, -p)
    assert FIT.bore_displacement == pytest.approx(bore)
    assert FIT.inner_displacement == pytest.approx(interface)
    assert FIT.bore_hoop_stress == pytest.approx(hoop)
    interface, rim, _ = radial_field(1.5, 2.2, 7.0, 0.4, -p, 0.0)
    assert FIT.outer_displacement == pytest.approx(interface)
    assert FIT.rim_displacement == pytest.approx(rim)


def test_rings_of_one_material():
    """Poisson's ratio drops out but for E': the formula of textbooks on machine parts."""
    fit = replace(FIT, young_outer=3.0, nu_outer=0.2)
    a2, b2, c2 = fit.bore**2, fit.radius**2, fit.rim**2
    modulus = 3.0 / (1 - 0.2**2)
    expected = modulus * fit.interference / fit.radius
    expected *= (c2 - b2) * (b2 - a2) / (2 * b2 * (c2 - a2))
    assert fit.pressure == pytest.approx(expected)


def test_thin_rings():
    """Two equally thin rings share the interference, with hoop stresses p R / t."""
    t, radius = 1e-4, 1.0
    fit = PressFit(1e-6, radius - t, radius, radius + t, 2.0, 0.3, 2.0, 0.3)
    assert -fit.inner_displacement == pytest.approx(fit.outer_displacement, rel=1e-3)
    assert fit.bore_hoop_stress == pytest.approx(-fit.pressure * radius / t, rel=1e-3)
    assert fit.pressure == pytest.approx(2.0 / (1 - 0.3**2) * t * 0.5e-6, rel=1e-3)


def test_stiff_outer_ring_does_not_move():
    """The inner ring takes all of the interference, and the other way round."""
    fit = replace(FIT, young_outer=1e12)
    assert fit.inner_displacement == pytest.approx(-FIT.interference)
    fit = replace(FIT, young_inner=1e12)
    assert fit.outer_displacement == pytest.approx(FIT.interference)


def test_solid_shaft_in_a_wide_plate():
    """A tiny bore and an endless plate, of one incompressible material: c_1 = 0, c_2 = 2 b/E'."""
    fit = PressFit(0.01, 1e-6, 1.0, 1e6, 1.0, 0.5, 1.0, 0.5)
    assert fit.inner_displacement == pytest.approx(0, abs=1e-12)
    assert fit.pressure == pytest.approx(0.01 / (2 * (1 - 0.5**2)))


def test_linear_in_the_interference():
    """Twice as tight, twice the pressure."""
    assert replace(FIT, interference=0.04).pressure == pytest.approx(2 * FIT.pressure)


def test_units_of_fits():
    """Metres turn into millimetres."""
    si = PressFit(1e-5, 0.01, 0.02, 0.03, 2e11, 0.3, 1e11, 0.25)
    mm = PressFit(1e-2, 10.0, 20.0, 30.0, 2e5, 0.3, 1e5, 0.25)
    assert mm.pressure == pytest.approx(1e-6 * si.pressure)
    assert mm.bore_hoop_stress == pytest.approx(1e-6 * si.bore_hoop_stress)
    for name in ("inner", "outer", "bore", "rim"):
        lengths = (getattr(fit, f"{name}_displacement") for fit in (mm, si))
        assert next(lengths) == pytest.approx(1e3 * next(lengths))
