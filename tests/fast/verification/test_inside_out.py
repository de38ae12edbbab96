# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Converged steps that have turned cells inside out."""

import pytest

import contactx as cx

from scenes.held_sheet import HeldSheet
from scenes.materials import st_venant_kirchhoff


def block(**options):
    return HeldSheet(n=24, thickness=1.0, on_ground=True, material=st_venant_kirchhoff, **options)


def test_one_deep_step_is_refused():
    """It converged, without any force: the surface was folded over the disc."""
    pressed = block()
    with pytest.raises(cx.ConvergenceError, match=r"8 cells are turned inside out.*smaller load"):
        pressed.solve(0.6, 1)
    assert not pressed.u.x.array.any()
    audit = pressed.problem.report.audit
    assert audit.inverted == 8
    assert audit.smallest_det < 0


def test_load_steps_cut_until_it_is_right():
    forces = []
    for steps in (1, 8):
        pressed = block()
        for step in cx.LoadSteps(
            pressed.problem, steps, update=lambda t, p=pressed: p.push(0.6 * t), progress=False
        ):
            assert step.report.audit.inverted == 0
        forces.append(pressed.contact.force[1])
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_the_audit_may_warn_instead():
    pressed = block(audit="warn")
    with pytest.warns(UserWarning, match="inside out"):
        pressed.solve(0.6, 1)
    assert pressed.problem.report.converged


@pytest.mark.parametrize(("sliding", "inverted"), [("finite", True), ("small", False)])
def test_linear_bodies_are_only_warned_of(sliding, inverted, recwarn):
    """A linear material does not notice; in small sliding positions do not matter."""
    pressed = HeldSheet(thickness=0.1, on_ground=True, sliding=sliding)
    pressed.solve(0.4, 4)
    audit = pressed.problem.report.audit
    assert (audit.inverted > 0) == inverted
    assert any("A linear material does not resist" in str(w.message) for w in recwarn) == inverted
