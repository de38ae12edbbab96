# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that stay apart."""

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks
from story import elasticity


@pytest.fixture
def scene():
    return Blocks(CellType.tetrahedron)


def test_out_of_reach_warns_with_the_distance():
    scene = Blocks(CellType.tetrahedron, gap=5.0)
    problem = scene.problem(scene.contact())
    with pytest.warns(UserWarning, match=r"no slave node within reach.* 4\.95 away.* 2\.12"):
        problem.solve()
    assert problem.report.pairs == 0
    assert problem.report.iterations == 1


def test_small_sliding_out_of_reach_says_where_it_pairs():
    scene = Blocks(CellType.triangle, gap=0.2, down=0.1)
    problem = scene.problem(scene.contact("small", search_distance=0.1))
    said = (
        r"no slave node within reach.* 0\.2 away in the reference configuration.* reaches 0\.1\. "
        r'sliding="small" pairs nodes .* larger search_distance, or take sliding="finite"'
    )
    with pytest.warns(UserWarning, match=said):
        problem.solve()


def test_small_sliding_out_of_reach_must_not_pass_through():
    """The bodies are pressed into each other, and nothing resists."""
    scene = Blocks(CellType.triangle, gap=0.2, down=0.3)
    problem = scene.problem(scene.contact("small", search_distance=0.1))
    said = (
        r"slave nodes are inside the master, and have no pair with it, .*: "
        r'sliding="small" pairs nodes .* larger search_distance, or take sliding="finite"'
    )
    with pytest.raises(cx.ConvergenceError, match=said):
        problem.solve()


def test_elasticity_without_contact_force_is_plain_elasticity():
    """Bodies that stay apart: contact changes nothing."""
    scene = Blocks(CellType.tetrahedron, gap=0.2)
    contact = scene.contact()
    scene.problem(contact).solve()
    assert not contact.multiplier.any()
    assert not contact.force.any()
    assert np.nanmin(contact.gap.x.array) == pytest.approx(0.15)
    residual = fem.assemble_vector(fem.form(elasticity(scene.u, 1.0, 0.3))).array
    assert np.abs(residual).max() <= 1e-15
