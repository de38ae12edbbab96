# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels of rigid obstacles against what they are given."""

import numpy as np
import pytest
from kernel_calls import call

from contactx import cpp as core


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
