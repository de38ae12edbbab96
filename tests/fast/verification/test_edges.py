# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edges and corners that something smooth touches; slaves too coarse to see what presses them."""

import functools
import warnings

import numpy as np
import pytest

import contactx as cx

from scenes import ball_at_edge
from scenes.ball_at_edge import BallAtEdge
from scenes.punched_block import PunchedBlock
from scenes.tip_on_arm import TipOnArm

METHODS = ["node-to-surface", "surface-to-surface"]


@functools.cache
def pushed(n, method, swapped=False, depth=0.3):
    """Force on the head, and the part of its work that the bodies have not stored."""
    scene = TipOnArm(n, method=method, swapped=swapped)
    force, work = scene.pushed(depth)
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
    right, _ = pushed(20, "node-to-surface", depth=0.2)
    force, lost = pushed(20, "surface-to-surface", swapped=True, depth=0.2)
    np.testing.assert_allclose(force, right, rtol=0, atol=0.045 * np.linalg.norm(right))
    assert abs(lost) < 0.04


def test_a_corner_that_slides_off_its_facet_is_not_held_from_afar():
    """Mean gaps of facets that are covered in part may be zero where nothing touches."""
    with pytest.raises(cx.ConvergenceError, match=r"press across a distance of .* Swap slave"):
        pushed(20, "surface-to-surface", swapped=True)


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


both_methods = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
COARSE = r"reaches .* deep through a slave facet .*: the slave surface is too coarse to see it"


@both_methods
@pytest.mark.parametrize("gdim", [2, 3])
def test_a_ball_between_nodes_is_refused(gdim, method):
    """No node touches it, and the force was zero."""
    block = PunchedBlock(gdim, n=4, method=method, ball=0.1, x0=0.25)
    with pytest.raises(cx.ConvergenceError, match=COARSE + ". Refine the slave"):
        block.problem.solve()


@both_methods
def test_a_ball_on_a_finer_block_is_right(method):
    forces = []
    for n in (40, 80):
        block = PunchedBlock(2, n=n, method=method, ball=0.1, x0=0.26)
        block.problem.solve()
        forces.append(block.contact.force[1])
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=0.15)


def test_a_narrow_punch_between_nodes_is_refused_and_the_swapped_pair_is_right():
    block = PunchedBlock(2, n=4, punch=8, x0=0.25)
    with pytest.raises(cx.ConvergenceError, match=COARSE + ". Swap slave and master"):
        block.problem.solve()
    swapped = PunchedBlock(2, n=4, punch=8, x0=0.25, swapped=True)
    swapped.problem.solve()
    assert swapped.contact.force[1] > 0


@pytest.mark.parametrize("sliding", ["finite", "small"])
@both_methods
def test_a_wide_punch_is_no_fault(method, sliding):
    """Coarse and fine, on nodes and between them."""
    for n in (4, 20):
        for x0 in (0.0, 0.25):
            block = PunchedBlock(2, n=n, punch=8, width=0.8, x0=x0, method=method, sliding=sliding)
            block.problem.solve()
            assert block.contact.force[1] < 0
            assert block.problem.report.audit.excess < 0.9
