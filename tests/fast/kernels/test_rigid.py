# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels of rigid obstacles against what they are given."""

import numpy as np
import pytest

from contactx import cpp as core

from kernel_calls.node_pairs import call

LAWS = ("frictional", "tied")


@pytest.fixture(params=[2, 3])
def case(request):
    gdim = request.param
    rng = np.random.default_rng(gdim)
    pair = rng.standard_normal(16)
    w = np.concatenate([rng.standard_normal(2 * gdim), pair, [1.3, 0.7, -2.5]])
    return gdim, pair, w


def tabulate(case, term, shape):
    gdim, _, w = case
    results = [
        call(core.kernel("frictionless", sliding, term, 0, gdim)[0], w, shape)
        for sliding in (("finite",) if term == "stiffness" else ("finite", "small"))
    ]
    assert all(np.array_equal(r, results[0]) for r in results)
    return results[0]


def test_gap(case):
    assert tabulate(case, "gap", (1,))[0] == case[1][0]


def test_residual_and_its_derivatives(case):
    gdim, pair, _ = case
    normal, area, pressure = pair[4 : 4 + gdim], 0.7, 1.3
    residual = tabulate(case, "residual", (gdim,))
    assert residual == pytest.approx(-area * pressure * normal, rel=1e-14)
    assert tabulate(case, "traction", (gdim,)) == pytest.approx(-area * normal, rel=1e-14)
    curvature = pair[7 : 7 + gdim * gdim].reshape(gdim, gdim)
    assert tabulate(case, "stiffness", (gdim, gdim)) == pytest.approx(
        -area * pressure * curvature, rel=1e-14
    )


def test_constraint(case):
    gdim, pair, _ = case
    gradient = pair[1 : 1 + gdim]
    assert tabulate(case, "constraint", (gdim,)) == pytest.approx(-2.5 * gradient, rel=1e-14)


def test_small_sliding_has_no_stiffness():
    with pytest.raises(ValueError, match="no kernel for small sliding, term stiffness"):
        core.kernel("frictionless", "small", "stiffness", 0, 3)


class Vector:
    """Random coefficients of a vector multiplier, laid out as the core says."""

    def __init__(self, gdim):
        rng = np.random.default_rng(10 + gdim)
        self.gdim = gdim
        self.values = {}
        for name, site, size in core.coefficients("frictional", 0, gdim):
            assert site != "nodes" or size == gdim  # the slave node alone
            self.values[name] = rng.standard_normal(size)
        self.w = np.concatenate(list(self.values.values()))

    def part(self, name, layout, key, *shape):
        first = layout[key]
        return self.values[name][first : first + np.prod(shape, dtype=int)].reshape(shape)

    def tabulate(self, term, *shape):
        """The same for both laws and both kinds of sliding."""
        results = [
            call(core.kernel(law, sliding, term, 0, self.gdim)[0], self.w, shape)
            for law in LAWS
            for sliding in ("finite", "small")
        ]
        assert all(np.array_equal(r, results[0]) for r in results)
        return results[0]


@pytest.fixture(params=[2, 3])
def vector(request):
    return Vector(request.param)


def test_gap_normal_and_slip_of_a_vector_multiplier(vector):
    d = vector.gdim
    gap = vector.part("pair", core.rigid_layout, "gap", 1)
    normal = vector.part("pair", core.rigid_layout, "normal", d)
    slip = vector.part("slip", core.rigid_slip_layout, "slip", d)
    assert np.array_equal(vector.tabulate("gap", 1), gap)
    assert np.array_equal(vector.tabulate("normal", d), normal)
    assert np.array_equal(vector.tabulate("slip", d), slip)


def test_residual_of_a_vector_multiplier_and_its_derivative(vector):
    d, (area,) = vector.gdim, vector.values["area"]
    multiplier = vector.values["multiplier"]
    assert vector.tabulate("residual", d) == pytest.approx(-area * multiplier, rel=1e-14)
    assert np.array_equal(vector.tabulate("traction", d, d), -area * np.eye(d))


def test_constraint_of_a_vector_multiplier(vector):
    d = vector.gdim
    gradient = vector.part("pair", core.rigid_layout, "gradient", d)
    curvature = vector.part("pair", core.rigid_layout, "curvature", d, d)
    slip = vector.part("slip", core.rigid_slip_layout, "derivative", d, d)
    by_slip, by_normal = (
        vector.values[name].reshape(d, d) for name in ("slip_derivative", "normal_derivative")
    )
    expected = (
        np.outer(vector.values["gap_derivative"], gradient) + by_slip @ slip + by_normal @ curvature
    )
    assert vector.tabulate("constraint", d, d) == pytest.approx(expected, rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("law", LAWS)
def test_a_vector_multiplier_has_no_stiffness(law):
    with pytest.raises(ValueError, match="no kernel for finite sliding, term stiffness"):
        core.kernel(law, "finite", "stiffness", 0, 3)
