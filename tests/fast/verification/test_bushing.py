# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rubber that hardly changes its volume is pushed through a sleeve with much friction."""

import pytest

import contactx as cx

from scenes.bushing import LENGTH, Bushing


def push(friction, n=6):
    bushing = Bushing(n, friction=friction)
    solves = 0
    for step in cx.LoadSteps(
        bushing.problem, 40, update=lambda t: bushing.push(2 * LENGTH * t), progress=False
    ):
        solves += step.iterations + step.report.discarded
    return bushing, solves


def test_a_bushing_is_pushed_through():
    """Inside all of it slips, so that forces are in the ratio of friction; no volume is lost."""
    bushing, solves = push(0.3)
    assert solves <= 180
    radial, axial = bushing.contact.force
    assert axial == pytest.approx(-0.3 * radial, rel=2e-3)
    assert abs(bushing.change_of_volume()) < 2e-3
    assert bushing.problem.report.slipping == (bushing.contact.status.x.array > 0).sum()
    smooth, _ = push(0.0)
    assert smooth.contact.force[0] == pytest.approx(radial, rel=0.03)
    assert smooth.contact.force[1] == pytest.approx(0, abs=1e-3 * axial)
