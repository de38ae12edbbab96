# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Thin bodies whose tips are moved past each other."""

import pytest

import contactx as cx

from scenes.two_tips import TwoTips

METHODS = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
DOWN = 12.0


def moved(steps, **options):
    tips = TwoTips(**options)
    for k in range(steps):
        tips.push(DOWN * (k + 1) / steps)
        tips.problem.solve()
    return tips


@METHODS
@pytest.mark.parametrize("overlap", [0.05, 0.2])
def test_facing_surfaces_stop_each_other_in_one_step(method, overlap):
    one, many = (moved(steps, method=method, overlap=overlap) for steps in (1, 12))
    assert one.contact.force[1] < 0
    assert one.contact.force == pytest.approx(many.contact.force, rel=1e-6)


@METHODS
@pytest.mark.parametrize("overlap", [0.05, 0.2])
def test_whole_boundaries_are_the_same_in_steps(method, overlap):
    """A face is not pressed from behind through a body that is thinner than the reach."""
    face = moved(12, method=method, overlap=overlap)
    whole = TwoTips(method=method, overlap=overlap, whole=True)
    for _ in cx.LoadSteps(whole.problem, 24, update=lambda t: whole.push(DOWN * t), progress=False):
        pass
    # By surface-to-surface facets at the ends of a face have an edge beside them in the whole
    near = 1e-6 if method == "node-to-surface" else 3e-4
    assert whole.contact.force == pytest.approx(face.contact.force, rel=near)


@METHODS
def test_whole_boundaries_do_not_pass_through_in_one_step(method):
    """They did, with no more than a warning that nothing was in reach."""
    tips = TwoTips(method=method, whole=True)
    tips.push(DOWN)
    with pytest.raises(cx.ConvergenceError, match="smaller load steps"):
        tips.problem.solve()
    assert not tips.u.x.array.any()


@METHODS
def test_whole_boundaries_out_of_contact_are_free(method):
    tips = TwoTips(method=method, whole=True)
    tips.push(-1.0)
    tips.problem.solve()
    assert not tips.contact.force.any()
