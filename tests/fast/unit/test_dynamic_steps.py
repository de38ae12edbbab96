# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Time steps that fail, are cut, are saved and are gone on from."""

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes.flying import GAP, SPEED, Flying

CELL = CellType.quadrilateral
DT, STEPS = 0.01, 8


def states(scene):
    """All that a step starts from."""
    dynamics, contact = scene.dynamics, scene.contact
    return [
        dynamics.u.x.array.copy(),
        dynamics.velocity.x.array.copy(),
        contact.multiplier.copy(),
        contact.status.x.array.copy(),
    ]


def steps(scene, **options):
    given = {"t_end": STEPS * DT, "progress": False, **options}
    return cx.LoadSteps(scene.dynamics, STEPS, lambda t: None, **given)


def test_a_step_that_fails_leaves_everything_as_it_was():
    scene = Flying(CELL, friction=0.3, petsc_options={"snes_max_it": 2})
    for k in range(STEPS):
        before = states(scene)
        try:
            scene.dynamics.solve()
        except cx.ConvergenceError:
            break
        assert not np.array_equal(before[1], scene.dynamics.velocity.x.array) or k == 0
    else:
        pytest.fail("no step has failed")
    for old, new in zip(before, states(scene), strict=True):
        np.testing.assert_array_equal(new, old)
    assert scene.dynamics.report.balance is None


def test_load_steps_count_time_and_cut_it():
    scene = Flying(CELL, friction=0.3, petsc_options={"snes_max_it": 3, "snes_rtol": 1e-9})
    taken, t = [], 0.0
    for step in steps(scene):
        assert step.report.balance.dt == pytest.approx(step.t - t)
        taken.append(step.t - t)
        t = step.t
    assert t == pytest.approx(STEPS * DT)
    assert min(taken) < 0.6 * DT
    assert max(taken) <= DT * (1 + 1e-12)


@pytest.mark.parametrize("obstacle", [None, cx.Plane((0, 0), (0, 1))], ids=["block", "plane"])
def test_steps_are_short_at_an_impact(obstacle):
    """The time of the first contact comes out by as much as the way of that step says."""
    limit, cell = 0.005, np.sqrt(2) / 3
    scene = Flying(CELL, obstacle=obstacle, impact_travel=limit)
    given = GAP / SPEED
    t, taken, hit = 0.0, [], None
    for step in cx.LoadSteps(
        scene.dynamics, 3, lambda t: None, t_end=0.12, max_cuts=8, progress=False
    ):
        taken.append(step.t - t)
        if hit is None and np.any(scene.contact.status.x.array > 0):
            hit = t, step.t
        t = step.t
    assert hit[0] <= given <= hit[1]
    assert SPEED * (given - hit[0]) <= 1.01 * limit * cell
    # They were long before it, and grow back
    assert taken[-1] > 4 * min(taken)


def test_a_step_that_arrives_too_fast_is_refused():
    scene = Flying(CELL, impact_travel=1e-3)
    before = states(scene)
    with pytest.raises(cx.ConvergenceError, match=r"impact_travel = 0\.001: take shorter steps"):
        for _ in range(STEPS):
            before = states(scene)
            scene.dynamics.solve()
    for old, new in zip(before, states(scene), strict=True):
        np.testing.assert_array_equal(new, old)
    assert not scene.dynamics.report.converged


def test_a_run_goes_on_from_its_file(tmp_path):
    file = tmp_path / "run.npz"
    obstacle = cx.Plane((0, 0), (0, 1))
    for options in ({"friction": 0.3}, {"obstacle": obstacle}):
        for step in steps(Flying(CELL, **options), checkpoint=file):
            # The file is that of the step before
            if step.index == 5:
                break
        other = Flying(CELL, **options)
        for _ in steps(other):
            pass
        again = Flying(CELL, **options)
        for _ in steps(again, restart=file):
            pass
        for old, new in zip(states(other), states(again), strict=True):
            np.testing.assert_array_equal(new, old)


def test_a_step_needs_its_length():
    scene = Flying(CELL)
    dynamics = scene.dynamics
    for dt, kind in ((0.0, ValueError), (np.inf, ValueError), ("1", TypeError)):
        with pytest.raises(kind, match="dt is"):
            dynamics.dt = dt
    assert dynamics.dt == 0.01
    dynamics._has_dt = False
    with pytest.raises(RuntimeError, match="no dt was set"):
        dynamics.solve()


def test_a_velocity_that_is_not_finite_is_refused():
    scene = Flying(CELL)
    before = scene.dynamics.u.x.array.copy()
    scene.dynamics.velocity.x.array[3] = np.nan
    with pytest.raises(ValueError, match="velocity is not finite"):
        scene.dynamics.solve()
    np.testing.assert_array_equal(scene.dynamics.u.x.array, before)
