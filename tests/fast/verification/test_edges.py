# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edges and corners that something smooth touches."""

import functools
import warnings

import numpy as np
import pytest

from scenes import ball_at_edge
from scenes.ball_at_edge import BallAtEdge
from scenes.punched_block import PunchedBlock
from scenes.tip_on_arm import TipOnArm

METHODS = ["node-to-surface", "surface-to-surface"]


@functools.cache
def pushed(n, method, swapped=False):
    """Force on the head, and the part of its work that the bodies have not stored."""
    scene = TipOnArm(n, method=method, swapped=swapped)
    force, work = scene.pushed()
    return force, work / scene.energy() - 1


@pytest.mark.parametrize("method", METHODS)
def test_the_work_of_a_corner_without_friction_is_stored(method):
    _, lost = pushed(20, method)
    assert abs(lost) < 0.002


def test_a_corner_feels_the_normal_of_what_it_touches_by_both_methods():
    right, _ = pushed(20, "node-to-surface")
    force, _ = pushed(20, "surface-to-surface")
    np.testing.assert_allclose(force, right, rtol=0, atol=0.005 * np.linalg.norm(right))
    # The arm bends, and pushes the corner aside: along the normals of the corner's two faces in
    # the mean it would not
    assert force[0] < 0.5 * force[1] < 0


def test_what_a_corner_is_pressed_into_feels_it_too():
    """The arm as the slave: its work is less exact, as its facets' normals differ."""
    right, _ = pushed(20, "node-to-surface")
    force, lost = pushed(20, "surface-to-surface", swapped=True)
    np.testing.assert_allclose(force, right, rtol=0, atol=0.03 * np.linalg.norm(right))
    assert abs(lost) < 0.04


def test_an_edge_between_slave_nodes_is_warned_of_once_with_how_far_the_force_is_off():
    ball = BallAtEdge(0.28)
    words = r"edges of the master take .* Swap .*errors/edges"
    with pytest.warns(UserWarning, match=words) as told:
        ball.push()
    assert len(told) == 1
    off = np.arctan(ball_at_edge.RIGHT) - np.arctan(ball.force[0] / ball.force[2])
    assert ball.problem.report.audit.edges == pytest.approx(off, abs=np.radians(4))
    assert "off by edges of the master: 0.18 of the force" in str(ball.problem.report.audit)


def test_an_edge_that_no_slave_node_sees_is_warned_of(monkeypatch):
    """The ball's normal is at 44 degrees to the plate; the force is zero."""
    monkeypatch.setattr(ball_at_edge, "MIDDLE", (2.7, 0.1, np.sqrt(1 - 0.7**2) + 1e-4))
    monkeypatch.setattr(ball_at_edge, "DOWN", 0.05)
    monkeypatch.setattr(ball_at_edge, "STEPS", 1)
    ball = BallAtEdge(0.28)
    words = r"is 0\.0\d+ deep in a slave facet of size 0\.\d+ at .*errors/edges"
    with pytest.warns(UserWarning, match=words):
        ball.push()
    assert not ball.force.any()
    assert ball.problem.report.audit.edges == np.inf


@pytest.mark.parametrize("options", [{"swapped": True}, {"method": "surface-to-surface"}])
def test_what_is_advised_at_an_edge_helps(options):
    ball = BallAtEdge(0.28, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ball.push()
    assert ball.force[0] / ball.force[2] == pytest.approx(ball_at_edge.RIGHT, abs=0.07)
    assert ball.problem.report.audit.edges == 0


@pytest.mark.parametrize(("n", "down"), [(4, 0.02), (16, 0.02), (16, 0.2), (32, 0.02)])
def test_edges_of_a_punch_press_along_its_foot(n, down, recwarn):
    """Most of the force is in front of the foot, at its edges as well."""
    block = PunchedBlock(2, n=n, punch=8, width=0.8, down=down, around=True)
    block.problem.solve()
    assert block.contact.force[1] < 0
    assert block.problem.report.audit.edges < 0.03
    assert not recwarn.list
