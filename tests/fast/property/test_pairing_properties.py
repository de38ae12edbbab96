# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pairs of slave nodes and master facets."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, sheets, wild_surfaces

_NAMES = ("facet", "feature", "xi", "cone", "normal")


def _pairs(pairing):
    return {name: getattr(pairing, name) for name in _NAMES}


def _paired(s, *, reach=np.inf, moves=()):
    """Pairs after a search, and one after each move."""
    pairing = core.Pairing(*s.lists, s.gdim)
    closed = np.ones(len(pairing.slaves), dtype=np.int8)
    pairing.update(s.x, reach, closed)
    for move in moves:
        pairing.update(s.x + move, reach, closed)
    return pairing


@st.composite
def moved_sheets(draw):
    """Surfaces and moves of all their nodes, of shape (2, num_nodes, gdim)."""
    s = draw(sheets())
    values = draw(st.lists(fractions, min_size=2 * s.x.size, max_size=2 * s.x.size))
    return s, np.reshape(values, (2, *s.x.shape)) / 8


@given(wild_surfaces())
def test_pairs_are_finite_and_with_facets_that_exist(s):
    pairing = _paired(s)
    assert (pairing.facet >= -1).all()
    assert (pairing.facet < len(s.master[0]) - 1).all()
    for name in ("xi", "cone", "normal"):
        assert np.isfinite(getattr(pairing, name)).all()


@given(moved_sheets())
def test_a_second_search_changes_nothing(scene):
    s, moves = scene
    pairing = _paired(s, moves=moves)
    before = _pairs(pairing)
    again = pairing.update(s.x + moves[-1], np.inf, np.ones(len(pairing.slaves), dtype=np.int8))
    assert again == 0
    assert np.array_equal(pairing.facet, before["facet"])


@given(moved_sheets(), powers)
def test_pairs_do_not_depend_on_the_unit_of_length(scene, scale):
    s, moves = scene
    pairs = _pairs(_paired(s, moves=moves))
    large = _pairs(_paired(s.placed(scale * s.x), moves=scale * moves))
    for name in _NAMES:
        assert np.array_equal(large[name], pairs[name])


@given(sheets())
def test_points_of_pairs_are_on_their_normal(s):
    pairing = _paired(s)
    inner = (pairing.facet >= 0) & (pairing.feature == 0)
    x = s.x[pairing.slaves]
    xi, gap = pairing.feet(s.x, x)
    place, normal = pairing.places(s.x, xi)
    back = place + gap[:, None] * normal
    np.testing.assert_allclose(back[inner], x[inner], atol=1e-9)
