# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Converged steps that have turned cells inside out."""

import pytest

import contactx as cx
from contactx import cpp as core

from scenes.full_steps import limit
from scenes.held_sheet import HeldSheet
from scenes.materials import st_venant_kirchhoff
from scenes.roller import Roller


@pytest.fixture
def full_steps(monkeypatch):
    """Steps that nothing shortens."""
    monkeypatch.setattr(core.Loop, "limit", limit)


def roller(**options):
    return Roller("svk", "surface-to-surface", 0.0, n=10, **options)


def test_one_deep_step_is_refused(full_steps):
    """It converges: a material that hardly resists is folded over the roller."""
    pressed = roller()
    with pytest.raises(cx.ConvergenceError, match=r"\d+ cells are turned inside out.*smaller load"):
        pressed.press(0.6)
    assert not pressed.u.x.array.any()
    audit = pressed.problem.report.audit
    assert audit.inverted > 0
    assert audit.smallest_det < 0


def test_load_steps_cut_until_it_is_right():
    forces = []
    for steps in (1, 4):
        pressed = HeldSheet(n=24, thickness=1.0, on_ground=True, material=st_venant_kirchhoff)
        for step in cx.LoadSteps(
            pressed.problem, steps, update=lambda t, p=pressed: p.push(0.45 * t), progress=False
        ):
            assert step.report.audit.inverted == 0
        forces.append(pressed.contact.force[1])
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_one_deep_step_is_right_where_steps_turn_no_cell_inside_out():
    forces = []
    for steps in (1, 8):
        pressed = roller()
        for k in range(steps):
            assert pressed.press(0.6 * (k + 1) / steps).audit.inverted == 0
        forces.append(pressed.contact.force[1])
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_the_audit_may_warn_instead(full_steps):
    pressed = roller(audit="warn")
    with pytest.warns(UserWarning, match="inside out"):
        pressed.press(0.6)
    assert pressed.problem.report.converged


@pytest.mark.parametrize(("sliding", "inverted"), [("finite", True), ("small", False)])
def test_linear_bodies_are_only_warned_of(sliding, inverted, recwarn):
    """A linear material does not notice; in small sliding positions do not matter."""
    pressed = HeldSheet(thickness=0.1, on_ground=True, sliding=sliding)
    pressed.solve(0.4, 4)
    audit = pressed.problem.report.audit
    assert (audit.inverted > 0) == inverted
    assert any("A linear material does not resist" in str(w.message) for w in recwarn) == inverted
