# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A slave too coarse to see what presses it between its nodes."""

import warnings

import numpy as np
import pytest

import contactx as cx

from scenes.punched_block import PunchedBlock

METHODS = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
COARSE = r"reaches .* deep through a slave facet .*: the slave surface is too coarse to see it"


@METHODS
@pytest.mark.parametrize("gdim", [2, 3])
def test_a_ball_between_nodes_is_refused(gdim, method):
    """No node touches it, and the force was zero."""
    block = PunchedBlock(gdim, n=4, method=method, ball=0.1, x0=0.25)
    with pytest.raises(cx.ConvergenceError, match=COARSE + ". Refine the slave"):
        block.problem.solve()


@METHODS
def test_a_ball_on_a_finer_block_is_right(method):
    forces = []
    for n in (40, 80):
        block = PunchedBlock(2, n=n, method=method, ball=0.1, x0=0.26)
        block.problem.solve()
        forces.append(block.contact.force[1])
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=0.15)


@METHODS
def test_a_ball_much_larger_than_the_facets_is_no_fault(method):
    """What it reaches between nodes is the chord of its curvature."""
    block = PunchedBlock(3, n=4, method=method, ball=2.0, x0=0.25, down=0.01)
    block.problem.solve()
    assert 0 < block.problem.report.audit.excess < 0.5


def test_a_narrow_punch_between_nodes_is_refused_and_the_swapped_pair_is_right():
    block = PunchedBlock(2, n=4, punch=8, x0=0.25)
    with pytest.raises(cx.ConvergenceError, match=COARSE + ". Swap slave and master"):
        block.problem.solve()
    swapped = PunchedBlock(2, n=4, punch=8, x0=0.25, swapped=True)
    swapped.problem.solve()
    assert swapped.contact.force[1] > 0


@pytest.mark.parametrize("sliding", ["finite", "small"])
@METHODS
def test_a_wide_punch_is_no_fault(method, sliding):
    """Coarse and fine, on nodes and between them."""
    for n in (4, 20):
        for x0 in (0.0, 0.25):
            block = PunchedBlock(2, n=n, punch=8, width=0.8, x0=x0, method=method, sliding=sliding)
            block.problem.solve()
            assert block.contact.force[1] < 0
            assert block.problem.report.audit.excess < 0.9


def test_small_sliding_sees_a_narrow_punch_too():
    block = PunchedBlock(2, n=4, punch=8, x0=0.25, sliding="small")
    with pytest.raises(cx.ConvergenceError, match=COARSE):
        block.problem.solve()


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_units_do_not_matter(unit):
    excess = []
    for factor in (1.0, unit):
        block = PunchedBlock(2, n=4, punch=8, x0=0.25, unit=factor, audit="warn")
        with pytest.warns(UserWarning, match="too coarse"):
            block.problem.solve()
        excess.append(block.problem.report.audit.excess)
    assert np.isclose(*excess, rtol=1e-6)


@pytest.mark.parametrize("gdim", [2, 3])
def test_no_verdict_hangs_on_where_a_step_ends(gdim):
    """A ball that touches first between nodes: the force is the same in any number of steps."""
    forces = []
    for steps in (1, 2, 9, 10, 11, 20):
        block = PunchedBlock(gdim, n=4, ball=0.8, x0=0.25, down=0.0)
        for k in range(steps):
            block.centre.value[-1] = 0.8 - 0.12 * (k + 1) / steps
            block.problem.solve()
        forces.append(block.contact.force[-1])
    assert forces[0] < 0
    assert forces == pytest.approx([forces[0]] * len(forces), rel=1e-8)


def test_few_facets_a_radius_are_warned_of_once():
    block = PunchedBlock(2, n=40, ball=0.15, x0=0.0, down=0.01)
    with pytest.warns(UserWarning, match=r"radius of curvature, 0.15, is 3 slave facets long"):
        block.problem.solve()
    assert block.problem.report.audit.radius_in_facets == pytest.approx(3, rel=0.05)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        block.problem.solve()
        fine = PunchedBlock(2, n=40, ball=0.5, x0=0.0, down=0.01)
        fine.problem.solve()
    assert fine.problem.report.audit.radius_in_facets == pytest.approx(10, rel=0.05)
