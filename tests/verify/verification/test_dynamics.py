# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Impact of bars on fine meshes, and a block that bounces for long."""

import bench_dynamics
import impact_bars
import pytest


@pytest.mark.parametrize(
    ("scene", "courant", "method"),
    [
        ("bar on a wall", 0.5, "node-to-surface"),
        ("bar on a wall", 1.0, "surface-to-surface"),
        ("bar on a wall", 2.0, "node-to-surface"),
        ("two bars", 1.0, "node-to-surface"),
    ],
)
def test_bars_of_200_cells(scene, courant, method):
    bars = impact_bars.Bars(scene, 200, courant, method)
    bars.run()
    assert abs(bars.steady.mean() - 1) <= 1e-3
    assert bars.swing <= 0.01
    assert bars.growth <= 1e-12
    assert 0 <= bars.loss <= 0.01
    assert bars.velocity == pytest.approx(impact_bars.VELOCITY, rel=0.02)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_bouncing_block(friction):
    found = bench_dynamics.bounce(1000, friction=friction)
    assert found["bounces"] > 5
    assert found["growth"] <= 1e-12
