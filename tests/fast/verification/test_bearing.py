# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rollers of a bearing that nothing but contact holds."""

import numpy as np
import pytest

import contactx as cx

from scenes.bearing import ANGLES, INNER, POISSON, ROLLER, YOUNG, Bearing
from scenes.covering import METHODS

MOST = 0.03
# Rollers at the same angle to both sides, the one in the middle beside them, of nothing but the
# rings' bending: as the same bearing has them with friction 0.1 and cells of 0.015
LOADS = (405.4, 580.3, 563.6)


def hertz_pressure(load):
    """Peak pressure of a roller on the inner ring, per thickness (Johnson 1985, 4.3)."""
    radius = 1 / (1 / INNER + 1 / ROLLER)
    return np.sqrt(load * YOUNG / (2 * (1 - POISSON**2)) / (np.pi * radius))


@pytest.mark.filterwarnings("ignore:nothing but the corners")
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_rollers_without_clearance(method, friction):
    """They stay where they are, bear what they do with friction, and as Hertz has it."""
    bearing = Bearing(method=method, friction=friction)
    solves = 0
    for step in cx.LoadSteps(
        bearing.problem, 2, update=lambda t: bearing.push(MOST * t), progress=False
    ):
        solves += step.iterations + step.report.discarded
    assert solves <= 30
    loads = np.array(bearing.loads())
    np.testing.assert_allclose(loads, [*LOADS, *LOADS[1::-1]], rtol=0.01)
    # Of the whole bearing; what holds the rollers is little
    total = loads @ np.cos(ANGLES)
    for contact, sign in zip(bearing.contacts, (-1, 1), strict=True):
        assert contact.force[1] == pytest.approx(sign * total, rel=2e-3)
        assert abs(contact.force[0]) <= 5e-3 * total
    peak = max(bearing.contacts[0].pressure.x.array)
    assert peak == pytest.approx(hertz_pressure(loads.max()), rel=0.06)
    held = bearing.problem.report.held_force
    assert held == 0 if friction else held <= 5e-3
    # No roller has left its place
    assert np.abs(bearing.u.x.array).max() <= 5 * MOST
