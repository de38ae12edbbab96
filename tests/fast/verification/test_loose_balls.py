# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Balls without weight that a lid pushes together: nothing resists before all of them touch."""

import numpy as np
import pytest

import contactx as cx

from scenes.balls import LooseBalls


def press(balls, steps, depth):
    """Bring the lid down; solves of each step, those of attempts that failed with them."""
    return [
        step.iterations + step.report.discarded
        for step in cx.LoadSteps(
            balls.problem, steps, update=lambda t: balls.push(depth * t), progress=False
        )
    ]


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_discs_make_room(friction):
    """Discs go out of the lid's way as rigid ones, without a solve or a force."""
    balls = LooseBalls(friction=friction)
    assert sum(press(balls, 3, 1.2)) == 0
    assert balls.largest_strain() < 1e-12
    assert balls.problem.report.free_modes == 3 * len(balls.centres)
    for contact in balls.contacts:
        assert not np.any(contact.force)
    # Upper ones go with the lid
    assert balls.u.x.array.reshape(-1, 2)[:, 1].min() == pytest.approx(-1.2, abs=0.2)
    # Chords between nodes are less than the radius
    assert balls.nearest() > 0.98


def test_many_balls_make_room():
    """As many bodies have six times the motions, and most nodes see nothing."""
    balls = LooseBalls(3, layers=4, width=4, size=2.5)
    assert sum(press(balls, 1, 1.2)) == 0
    assert balls.problem.report.free_modes == 6 * len(balls.centres) == 300
    assert balls.largest_strain() < 1e-12
    assert balls.nearest() > 0.95


@pytest.mark.parametrize(("friction", "solves"), [(0.0, 80), (0.3, 500)])
def test_discs_are_pressed(friction, solves):
    """All that presses them together balances, and no disc is left loose."""
    balls = LooseBalls(friction=friction)
    assert sum(press(balls, 7, 2.8)) <= solves
    forces = np.array([contact.force for contact in balls.contacts[1:]])
    assert forces[0, 1] > 5 and forces[1, 1] < -5
    np.testing.assert_allclose(forces.sum(axis=0), 0, atol=1e-10)
    assert balls.problem.report.free_modes == 0
    assert 0.05 < balls.largest_strain() < 0.3
