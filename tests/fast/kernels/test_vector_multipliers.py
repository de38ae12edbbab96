# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels of frictional and tied pairs: derivatives, balance, rigid motions."""

from dataclasses import replace

import numpy as np
import pytest

from kernel_calls.node_pairs import (
    CASES,
    assert_close,
    difference,
    random_vector_pair,
    shape,
    states,
)

LAWS = ["frictional", "tied"]
every = pytest.mark.parametrize(("num_nodes", "kind"), CASES)
both_laws = pytest.mark.parametrize("law", LAWS)
both_slidings = pytest.mark.parametrize("sliding", ["finite", "small"])


def pairs(law: str, num_nodes: int, kind: str):
    rng = np.random.default_rng(1000 * num_nodes + len(kind) + 17 * len(law))
    return [
        random_vector_pair(law, num_nodes, kind, rng, which) for which in states(num_nodes, kind)
    ]


@every
@both_laws
def test_stiffness_is_the_derivative_of_the_residual(law, num_nodes, kind):
    for pair in pairs(law, num_nodes, kind):
        computed = pair.tabulate("finite", "stiffness")
        assert_close(computed, difference(pair, "finite", "residual"), 1e-7)


@every
@both_slidings
def test_constraint_is_the_derivative_through_gap_slip_and_normal(num_nodes, kind, sliding):
    for pair in pairs("frictional", num_nodes, kind):
        by_slip, by_normal = (
            matrix.reshape(pair.gdim, pair.gdim)
            for matrix in (pair.slip_derivative, pair.normal_derivative)
        )
        expected = (
            np.outer(pair.gap_derivative, difference(pair, sliding, "gap")[0])
            + by_slip @ difference(pair, sliding, "slip")
            + by_normal @ difference(pair, sliding, "normal")
        )
        assert_close(pair.tabulate(sliding, "constraint"), expected, 1e-7)


@every
@both_slidings
def test_constraint_of_a_tie_is_the_derivative_through_its_movement(num_nodes, kind, sliding):
    for pair in pairs("tied", num_nodes, kind):
        by_slip = pair.slip_derivative.reshape(pair.gdim, pair.gdim)
        expected = by_slip @ difference(pair, sliding, "slip")
        assert_close(pair.tabulate(sliding, "constraint"), expected, 1e-7)


@every
@both_laws
@both_slidings
def test_traction_is_the_derivative_by_the_multiplier(law, num_nodes, kind, sliding):
    for pair in pairs(law, num_nodes, kind):
        columns = []
        for step in 0.01 * np.eye(pair.gdim):
            plus = replace(pair, multiplier=pair.multiplier + step).tabulate(sliding, "residual")
            minus = replace(pair, multiplier=pair.multiplier - step).tabulate(sliding, "residual")
            columns.append((plus - minus) / 0.02)
        assert_close(pair.tabulate(sliding, "traction"), np.column_stack(columns), 1e-12)


@every
@both_laws
@both_slidings
def test_forces_sum_to_zero_and_the_slave_gets_its_traction(law, num_nodes, kind, sliding):
    for pair in pairs(law, num_nodes, kind):
        forces = pair.tabulate(sliding, "residual").reshape(-1, pair.gdim)
        assert np.abs(forces.sum(axis=0)).max() <= 1e-13 * np.abs(forces).max()
        assert forces[0] == pytest.approx(-0.7 * pair.multiplier, rel=1e-13)


def moment(x: np.ndarray, forces: np.ndarray) -> tuple[np.ndarray, float]:
    pad = ((0, 0), (0, 3 - x.shape[1]))
    arms = np.cross(np.pad(x, pad), np.pad(forces, pad))
    return arms.sum(axis=0), np.abs(arms).max()


@pytest.mark.parametrize("num_nodes", [2, 3, 4])
def test_friction_has_no_moment_where_the_bodies_touch(num_nodes):
    for pair in pairs("frictional", num_nodes, "interior"):
        gap, normal = pair.tabulate("finite", "gap")[0], pair.tabulate("finite", "normal")
        du = np.zeros_like(pair.position)
        du[0] = -gap * normal
        pair = pair.moved(du)
        assert abs(pair.tabulate("finite", "gap")[0]) <= 1e-14
        forces = pair.tabulate("finite", "residual").reshape(-1, pair.gdim)
        total, size = moment(pair.current, forces)
        assert np.abs(total).max() <= 1e-13 * size


@every
def test_a_tie_has_no_moment_over_an_open_gap(num_nodes, kind):
    """Its forces balance where the constraint holds: the slave node at its place."""
    for pair in pairs("tied", num_nodes, kind):
        du = np.zeros_like(pair.position)
        du[0] = -pair.tabulate("finite", "slip")
        pair = pair.moved(du)
        assert np.abs(pair.tabulate("finite", "slip")).max() <= 1e-14
        forces = pair.tabulate("finite", "residual").reshape(-1, pair.gdim)
        total, size = moment(pair.current, forces)
        assert np.abs(total).max() <= 1e-13 * size


@every
@both_laws
def test_rigid_motion_turns_everything_and_changes_nothing(law, num_nodes, kind):
    rng = np.random.default_rng(7)
    for pair in pairs(law, num_nodes, kind):
        gdim = pair.gdim
        Q = np.linalg.qr(rng.standard_normal((gdim, gdim)))[0]
        Q[:, 0] *= np.sign(np.linalg.det(Q))
        target = pair.current @ Q.T + rng.standard_normal(gdim)
        moved = replace(pair, displacement=target - pair.position, multiplier=Q @ pair.multiplier)
        for term in ("slip", "normal"):
            before, after = pair.tabulate("finite", term), moved.tabulate("finite", term)
            assert np.abs(after - Q @ before).max() <= 1e-13
        assert moved.tabulate("finite", "gap") == pytest.approx(
            pair.tabulate("finite", "gap"), abs=2e-14
        )
        forces = pair.tabulate("finite", "residual").reshape(-1, gdim)
        turned = moved.tabulate("finite", "residual").reshape(-1, gdim)
        assert np.abs(turned - forces @ Q.T).max() <= 1e-13


@every
def test_slip_lies_across_the_normal(num_nodes, kind):
    for pair in pairs("frictional", num_nodes, kind):
        for sliding in ("finite", "small"):
            normal = pair.tabulate(sliding, "normal")
            assert abs(pair.tabulate(sliding, "slip") @ normal) <= 1e-14


@pytest.mark.parametrize("num_nodes", [2, 3, 4])
def test_slip_on_a_facet_is_the_way_between_two_points_of_it(num_nodes):
    """From the point that the slave node was over to the one that it is over."""
    for pair in pairs("frictional", num_nodes, "interior"):
        pair = replace(pair, slip=np.array([*pair.slip[:2], 0.0, 0.0, 0.0, 0.0]))
        normal = pair.tabulate("finite", "normal")
        foot = pair.current[0] - pair.tabulate("finite", "gap")[0] * normal
        start = shape(num_nodes, pair.slip[: pair.gdim - 1]) @ pair.current[1:]
        tangential = np.eye(pair.gdim) - np.outer(normal, normal)
        assert np.abs(tangential @ (foot - start) - pair.tabulate("finite", "slip")).max() <= 1e-13
