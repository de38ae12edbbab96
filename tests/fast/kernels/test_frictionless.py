# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
from dataclasses import replace

import numpy as np
import pytest

from contactx import cpp as core

from kernel_calls.node_pairs import CASES, assert_close, difference, random_pair, shape, states


def pairs(num_nodes: int, kind: str):
    rng = np.random.default_rng(1000 * num_nodes + len(kind))
    return [random_pair(num_nodes, kind, rng, which) for which in states(num_nodes, kind)]


@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_stiffness_is_the_derivative_of_the_residual(num_nodes, kind):
    for pair in pairs(num_nodes, kind):
        computed = pair.tabulate("finite", "stiffness")
        assert_close(computed, difference(pair, "finite", "residual"), 1e-7)


@pytest.mark.parametrize("sliding", ["finite", "small"])
@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_constraint_is_the_derivative_of_the_gap(num_nodes, kind, sliding):
    for pair in pairs(num_nodes, kind):
        factor = np.array([-2.5])
        computed = replace(pair, gap_derivative=factor).tabulate(sliding, "constraint")
        assert_close(computed, factor * difference(pair, sliding, "gap")[0], 1e-7)


@pytest.mark.parametrize("sliding", ["finite", "small"])
@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_traction_is_the_derivative_by_the_multiplier(num_nodes, kind, sliding):
    for pair in pairs(num_nodes, kind):
        h = 1e-2
        plus = replace(pair, multiplier=pair.multiplier + h).tabulate(sliding, "residual")
        minus = replace(pair, multiplier=pair.multiplier - h).tabulate(sliding, "residual")
        assert_close(pair.tabulate(sliding, "traction"), (plus - minus) / (2 * h), 1e-12)


@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_small_sliding_residual_does_not_depend_on_the_displacement(num_nodes, kind):
    rng = np.random.default_rng(0)
    for pair in pairs(num_nodes, kind):
        moved = pair.moved(rng.standard_normal(pair.position.size))
        assert np.array_equal(
            moved.tabulate("small", "residual"), pair.tabulate("small", "residual")
        )


@pytest.mark.parametrize("sliding", ["finite", "small"])
@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_forces_sum_to_zero(num_nodes, kind, sliding):
    for pair in pairs(num_nodes, kind):
        forces = pair.tabulate(sliding, "residual").reshape(-1, pair.gdim)
        assert np.abs(forces.sum(axis=0)).max() <= 1e-13 * np.abs(forces).max()
        # The slave's force is the pressure times the area along a unit normal
        assert np.linalg.norm(forces[0]) == pytest.approx(1.3 * 0.7, rel=1e-13)


@pytest.mark.parametrize("num_nodes", [2, 3, 4])
def test_moments_sum_to_zero_where_the_projection_is_interior(num_nodes):
    for pair in pairs(num_nodes, "interior"):
        forces = pair.tabulate("finite", "residual").reshape(-1, pair.gdim)
        x = pair.current
        pad = ((0, 0), (0, 3 - pair.gdim))
        arms = np.cross(np.pad(x, pad), np.pad(forces, pad))
        assert np.abs(arms.sum(axis=0)).max() <= 1e-13 * np.abs(arms).max()


@pytest.mark.parametrize(("num_nodes", "kind"), CASES)
def test_rigid_motion_changes_nothing(num_nodes, kind):
    rng = np.random.default_rng(7)
    for pair in pairs(num_nodes, kind):
        gdim = pair.gdim
        Q = np.linalg.qr(rng.standard_normal((gdim, gdim)))[0]
        Q[:, 0] *= np.sign(np.linalg.det(Q))
        target = pair.current @ Q.T + rng.standard_normal(gdim)
        moved = replace(pair, displacement=target - pair.position)
        gap = pair.tabulate("finite", "gap")[0]
        assert moved.tabulate("finite", "gap")[0] == pytest.approx(gap, abs=2e-14)
        forces = pair.tabulate("finite", "residual").reshape(-1, gdim)
        turned = moved.tabulate("finite", "residual").reshape(-1, gdim)
        assert np.abs(turned - forces @ Q.T).max() <= 1e-13
        # An infinitesimal rigid motion changes the force as a rotation does, and not the gap
        spin = rng.standard_normal((gdim, gdim))
        spin -= spin.T
        rate = (pair.current @ spin.T + rng.standard_normal(gdim)).ravel()
        assert abs(pair.tabulate("finite", "constraint") @ rate) <= 1e-12
        change = (pair.tabulate("finite", "stiffness") @ rate).reshape(-1, gdim)
        assert np.abs(change - forces @ spin.T).max() <= 1e-12


@pytest.mark.parametrize("num_nodes", [2, 3, 4])
def test_gap_is_the_signed_distance_along_the_outward_normal(num_nodes):
    for pair in pairs(num_nodes, "interior"):
        x = pair.current
        # The derivative of the gap by the slave's position is the unit normal
        normal = pair.tabulate("finite", "constraint")[: pair.gdim]
        foot = x[0] - pair.tabulate("finite", "gap")[0] * normal
        master = x[1:]
        weights = -pair.tabulate("finite", "constraint").reshape(-1, pair.gdim)[1:] @ normal
        assert weights.sum() == pytest.approx(1, rel=1e-13)
        assert np.abs(weights @ master - foot).max() <= 1e-13
        if num_nodes == 2:
            t = master[1] - master[0]
            outward = np.array([t[1], -t[0]])
        else:
            outward = np.cross(master[1] - master[0], master[2] - master[0])
        assert outward @ normal > 0


def test_shape_functions_of_the_reference_agree_with_the_kernels():
    rng = np.random.default_rng(3)
    for num_nodes in (2, 3, 4):
        pair = random_pair(num_nodes, "interior", rng)
        xi = pair.pair[1 : 1 + pair.gdim - 1]
        forces = pair.tabulate("small", "residual").reshape(-1, pair.gdim)
        weights = -forces[1:] @ forces[0] / (forces[0] @ forces[0])
        assert np.abs(weights - shape(num_nodes, xi)).max() <= 1e-14


def test_open_constraint_is_zero():
    rng = np.random.default_rng(4)
    pair = replace(random_pair(3, "interior", rng), gap_derivative=np.zeros(1))
    assert not pair.tabulate("finite", "constraint").any()


@pytest.mark.parametrize(
    ("sliding", "term", "num_nodes"),
    [("finite", "gap", 5), ("small", "stiffness", 3), ("medium", "gap", 3), ("finite", "x", 3)],
)
def test_unknown_kernel(sliding, term, num_nodes):
    with pytest.raises(ValueError, match=f"no kernel for {sliding} sliding, term {term}"):
        core.kernel("frictionless", sliding, term, num_nodes, 3)
