# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pairs of facets and the integrals over what they share."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, rotations, sheets, shuffles, wild_surfaces


def _integrals(s, reach=np.inf):
    search = core.FacetSearch(*s.lists, s.gdim)
    pairs = search.find(s.x, reach, 0.0)
    return pairs, search.integrals(pairs, s.x, s.x)


@given(wild_surfaces())
def test_integrals_are_finite_and_of_facets_that_exist(s):
    pairs, found = _integrals(s)
    for facets, (offsets, _) in ((pairs.slave, s.slave), (pairs.master, s.master)):
        assert (facets >= 0).all()
        assert (facets < len(offsets) - 1).all()
    for values in found.values():
        assert np.isfinite(values).all()
    assert (found["area"] >= 0).all()


@given(sheets())
def test_weights_sum_to_what_is_covered(s):
    pairs, found = _integrals(s)
    sums = np.zeros_like(found["area"])
    np.add.at(sums, pairs.slave, found["weight"].sum(axis=2))
    largest = 1 + np.abs(found["dual"]).max(initial=0)
    np.testing.assert_allclose(sums, found["area"], atol=1e-12 * largest)


@given(sheets((2,)))
def test_no_more_is_covered_than_is_there(s):
    _, found = _integrals(s)
    ends = s.x[s.slave[1].reshape(-1, 2)]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    assert (found["area"].sum(axis=1) <= (1 + 1e-5) * length).all()


@given(sheets(), powers)
def test_integrals_do_not_depend_on_the_unit_of_length(s, scale):
    pairs, found = _integrals(s)
    others, large = _integrals(s.placed(scale * s.x))
    assert np.array_equal(others.master, pairs.master)
    area = scale ** (s.gdim - 1)
    for name, unit in (("weight", area), ("area", area), ("gap", scale * area), ("normal", 1)):
        assert np.array_equal(large[name], unit * found[name])


@given(st.data(), sheets())
def test_areas_do_not_change_in_a_motion(data, s):
    rotation = data.draw(rotations(s.gdim))
    shift = data.draw(st.lists(fractions, min_size=s.gdim, max_size=s.gdim))
    _, found = _integrals(s)
    _, moved = _integrals(s.placed(s.x @ rotation.T + shift))
    np.testing.assert_allclose(moved["area"], found["area"], atol=1e-9)


@given(st.data(), sheets())
def test_numbers_of_nodes_do_not_matter(data, s):
    pairs, found = _integrals(s)
    others, same = _integrals(s.renumbered(data.draw(shuffles(len(s.x)))))
    assert np.array_equal(others.master, pairs.master)
    for name in found:
        assert np.array_equal(same[name], found[name])
