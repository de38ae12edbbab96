# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid tools that are pushed deep into a body: they act from the side that they came from."""

import numpy as np
import pytest

import contactx as cx

from scenes.held_sheet import RADIUS, HeldSheet, cylinder, disc, level_set
from scenes.materials import neo_hookean

METHODS = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
TOOLS = [(disc, 2), (level_set, 2), (cylinder, 3)]


@METHODS
@pytest.mark.parametrize(("tool", "gdim"), TOOLS, ids=lambda v: getattr(v, "__name__", v))
@pytest.mark.parametrize("deep", [1.05, 2.5])
def test_too_deep_in_one_step_is_refused(tool, gdim, deep, method):
    """It was accepted, with the force reversed and the sheet on the far side."""
    sheet = HeldSheet(tool, gdim=gdim, n=12, method=method)
    with pytest.raises(cx.ConvergenceError, match=r"far side.*smaller load steps"):
        sheet.solve(deep, 1)
    assert not sheet.u.x.array.any()


@pytest.mark.parametrize("whole", [False, True])
@METHODS
def test_in_steps_the_force_is_that_of_a_push(method, whole):
    forces = []
    for steps in (8, 16):
        sheet = HeldSheet(method=method, whole=whole)
        sheet.solve(1.05, steps)
        forces.append(sheet.contact.force[1])
        assert sheet.lowest() == pytest.approx(-1.05 * RADIUS, rel=0.01)
    # Elastic, without friction: no path matters
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_the_tag_of_the_whole_boundary_changes_nothing():
    forces = []
    for whole in (False, True):
        sheet = HeldSheet(whole=whole, thickness=0.05)
        sheet.solve(0.8, 4)
        forces.append(sheet.contact.force[1])
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)


def test_load_steps_cut_until_it_is_right():
    sheet, other = HeldSheet(), HeldSheet()
    for _ in cx.LoadSteps(sheet.problem, 1, update=lambda t: sheet.push(1.5 * t), progress=False):
        pass
    other.solve(1.5, 16)
    assert sheet.contact.force[1] == pytest.approx(other.contact.force[1], rel=1e-6)


@METHODS
def test_an_overlap_at_the_start_beyond_the_middle_is_refused(method):
    sheet = HeldSheet(deep=1.05, method=method)
    with pytest.raises(cx.ConvergenceError, match=r"inside the rigid Sphere.*face away"):
        sheet.problem.solve()


def test_a_node_in_the_centre_of_a_disc_is_refused():
    sheet = HeldSheet()
    with pytest.raises(cx.ConvergenceError, match="far side"):
        sheet.solve(1.0, 1)


def test_a_block_is_not_pushed_through():
    block = HeldSheet(thickness=1.0, on_ground=True)
    with pytest.raises(cx.ConvergenceError, match="far side"):
        block.solve(2.5, 1)
    block.solve(0.6, 4)
    assert block.contact.force[1] < 0


def test_the_audit_may_warn_instead():
    sheet = HeldSheet(audit="warn")
    with pytest.warns(UserWarning, match="far side"):
        sheet.solve(2.5, 1)
    assert sheet.problem.report.audit.passed > 0
    assert not sheet.problem.report.audit.faults or sheet.problem.report.converged


def test_a_tool_may_pass_by():
    """Over the sheet, beside it and around its end, without touching it."""
    sheet = HeldSheet(n=12)
    for x, z in [(-0.5, 0.5), (1.5, 0.5), (1.5, -1.0), (0.0, -1.0)]:
        sheet.place.value[:] = x, z
        sheet.problem.solve()
        assert not sheet.contact.force.any()


def test_a_whole_boundary_slides_and_turns_under_a_tool():
    """Sideways by more than a radius a step: legal, though chords cross the tool."""
    sheet = HeldSheet(thickness=0.2, whole=True, material=neo_hookean)
    sheet.solve(0.5, 2)
    for x in (0.35, -0.35):
        sheet.place.value[0] = x
        sheet.problem.solve()
        assert sheet.contact.force[1] < 0
    assert np.isfinite(sheet.lowest())
