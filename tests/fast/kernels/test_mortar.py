# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Kernels of surface-to-surface pairs: derivatives, balance, rigid motions."""

from dataclasses import replace

import numpy as np
import pytest

from kernel_calls.facet_pairs import KINDS, FacetPair, random_facet_pair
from kernel_calls.node_pairs import assert_close, difference

STATES = 2
LAWS = ["frictionless", "frictional"]
every = pytest.mark.parametrize(("slaves", "masters"), KINDS)
both_laws = pytest.mark.parametrize("law", LAWS)
all_laws = pytest.mark.parametrize("law", [*LAWS, "tied"])
both_slidings = pytest.mark.parametrize("sliding", ["finite", "small"])


def pairs(law: str, slaves: int, masters: int, *, inside: bool = True) -> list[FacetPair]:
    rng = np.random.default_rng(100 * slaves + 10 * masters + len(law))
    return [random_facet_pair(law, slaves, masters, rng, inside=inside) for _ in range(STATES)]


def frozen(pair: FacetPair) -> FacetPair:
    """The pair with its integrals frozen."""
    return replace(pair, integrated=pair.current)


@every
@both_laws
def test_stiffness_is_the_derivative_of_the_residual(law, slaves, masters):
    for pair in pairs(law, slaves, masters):
        computed = pair.tabulate("finite", "stiffness")
        assert_close(computed, difference(pair, "finite", "residual"), 1e-7)


@every
@both_laws
@both_slidings
def test_constraint_is_the_derivative_through_gap_and_normal(law, slaves, masters, sliding):
    for pair in pairs(law, slaves, masters):
        pair = frozen(pair) if sliding == "small" else pair
        dg = difference(pair, sliding, "gap")
        if sliding == "finite":
            # The forces are along the normal: it is the whole facet's gap that is consistent
            dg = dg - _turned(pair)
        m = pair.multiplier.shape[1]
        expected = np.einsum("si,sj->sij", pair.gap_derivative, dg)
        if law == "frictional":
            dn = difference(pair, sliding, "normal").reshape(slaves, m, -1)
            expected += np.einsum("sij,sjk->sik", pair.normal_derivative, dn)
        assert_close(pair.tabulate(sliding, "constraint"), expected.reshape(slaves * m, -1), 1e-7)


def _turned(pair: FacetPair) -> np.ndarray:
    """What the turning normal adds to the gap of one pair alone."""
    n, m = pair.slaves, pair.masters
    weight = pair.integrals["weight"][0, :n, :m]
    x = pair.current
    d = weight.sum(axis=1)[:, None] * x[:n] - weight @ x[n:]
    area = replace(pair, law="frictional", area=weight.sum(axis=1))
    dn = difference(replace(area, multiplier=np.zeros((n, pair.gdim))), "finite", "normal")
    return np.einsum("si,sij->sj", d / pair.area[:, None], dn.reshape(n, pair.gdim, -1))


@every
@all_laws
@both_slidings
def test_traction_is_the_derivative_by_the_multiplier(law, slaves, masters, sliding):
    for pair in pairs(law, slaves, masters):
        pair = frozen(pair)
        columns = []
        for i in range(pair.multiplier.size):
            step = np.zeros(pair.multiplier.size)
            step[i] = 0.01
            step = step.reshape(pair.multiplier.shape)
            plus = replace(pair, multiplier=pair.multiplier + step).tabulate(sliding, "residual")
            minus = replace(pair, multiplier=pair.multiplier - step).tabulate(sliding, "residual")
            columns.append((plus - minus) / 0.02)
        assert_close(pair.tabulate(sliding, "traction"), np.column_stack(columns), 1e-11)


@every
@both_slidings
def test_a_tie_is_linearised(slaves, masters, sliding):
    for pair in pairs("tied", slaves, masters):
        pair = frozen(pair)
        dw = difference(pair, sliding, "slip").reshape(slaves, pair.gdim, -1)
        expected = np.einsum("sij,sjk->sik", pair.slip_derivative, dw)
        computed = pair.tabulate(sliding, "constraint")
        assert_close(computed, expected.reshape(computed.shape), 1e-7)
        if sliding == "finite":
            computed = pair.tabulate("finite", "stiffness")
            expected = difference(pair, "finite", "residual")
            assert np.abs(computed - expected).max() <= 1e-7 * np.abs(pair.multiplier).max()


def moment(x: np.ndarray, forces: np.ndarray) -> tuple[np.ndarray, float]:
    pad = ((0, 0), (0, 3 - x.shape[1]))
    arms = np.cross(np.pad(x, pad), np.pad(forces, pad))
    return arms.sum(axis=0), np.abs(arms).max()


@every
@all_laws
@both_slidings
@pytest.mark.parametrize("inside", [True, False])
def test_forces_sum_to_zero(law, slaves, masters, sliding, inside):
    for pair in pairs(law, slaves, masters, inside=inside):
        forces = pair.tabulate(sliding, "residual").reshape(-1, pair.gdim)
        assert np.abs(forces.sum(axis=0)).max() <= 1e-12 * np.abs(forces).max()


@every
@pytest.mark.parametrize("inside", [True, False])
def test_a_slave_facet_that_lies_in_one_pair_has_no_moment(slaves, masters, inside):
    """The slave side is diagonal then, and the gap is along the normal."""
    for pair in pairs("frictionless", slaves, masters, inside=inside):
        forces = pair.tabulate("finite", "residual").reshape(-1, pair.gdim)
        total, size = moment(pair.current, forces)
        assert np.abs(total).max() <= 1e-9 * size


@every
def test_a_tie_has_no_moment_over_an_open_gap(slaves, masters):
    for pair in pairs("tied", slaves, masters):
        pair = frozen(pair)
        assert np.abs(pair.tabulate("finite", "slip")).max() <= 1e-9
        forces = pair.tabulate("finite", "residual").reshape(-1, pair.gdim)
        total, size = moment(pair.current, forces)
        assert np.abs(total).max() <= 1e-9 * size


@every
@both_laws
def test_rigid_motion_turns_everything_and_changes_nothing(law, slaves, masters):
    rng = np.random.default_rng(7)
    for pair in pairs(law, slaves, masters, inside=False):
        g = pair.gdim
        rotation = np.linalg.qr(rng.standard_normal((g, g)))[0]
        rotation[:, 0] *= np.sign(np.linalg.det(rotation))
        x = pair.current @ rotation.T + rng.standard_normal(g)
        turned = replace(pair, displacement=x - pair.position)
        m = pair.multiplier.shape[1]
        if m > 1:
            turned = replace(turned, multiplier=pair.multiplier @ rotation.T)
        assert turned.tabulate("finite", "gap") == pytest.approx(
            pair.tabulate("finite", "gap"), abs=1e-11
        )
        forces = pair.tabulate("finite", "residual").reshape(-1, g) @ rotation.T
        assert_close(turned.tabulate("finite", "residual").reshape(-1, g), forces, 1e-10)


@every
def test_weights_of_a_covered_facet_reproduce_linear_fields(slaves, masters):
    """Biorthogonality: the master's shape functions interpolate at the slave nodes."""
    for pair in pairs("frictionless", slaves, masters, inside=False):
        found = pair.integrals
        n, m = pair.slaves, pair.masters
        area = found["area"][0, :n]
        weight = found["weight"][0, :n, :m]
        assert weight.sum(axis=1) == pytest.approx(area, rel=1e-11)
        # Where both facets are flat and parallel
        if (n, m) not in ((2, 2), (3, 3)):
            continue
        normal = found["normal"][0, : pair.gdim]
        x = pair.current
        heights = (x[n:] - x[0]) @ normal
        level = x.copy()
        level[n:] -= heights[:, None] * normal
        aligned = replace(pair, displacement=level - pair.position)
        found = aligned.integrals
        interpolated = found["weight"][0, :n, :m] @ level[n:] / found["area"][0, :n, None]
        assert interpolated == pytest.approx(level[:n], abs=1e-9)
