# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Closest points of a surface and the projections that contact is measured with."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, rotations, sheets, shuffles, wild_surfaces


def _find(s, points, normals=None, reach=np.inf):
    normals = np.zeros_like(points) if normals is None else normals
    finder = core.Finder(*s.master, s.gdim)
    return finder.find(s.x, points, normals, np.full(len(points), reach))


@st.composite
def scenes(draw, surfaces):
    """Surfaces and three points."""
    s = draw(surfaces)
    values = draw(st.lists(fractions, min_size=3 * s.gdim, max_size=3 * s.gdim))
    return s, np.reshape(values, (3, s.gdim))


@given(scenes(wild_surfaces()))
def test_what_is_found_is_finite(scene):
    s, points = scene
    found = _find(s, points)
    has = found["facet"] >= 0
    assert (found["facet"] < len(s.master[0]) - 1).all()
    assert np.isfinite(found["distance"][found["nearest"] >= 0]).all()
    for name in ("gap", "xi", "normal"):
        assert np.isfinite(found[name]).all()
    np.testing.assert_allclose(np.linalg.norm(found["normal"][has], axis=1), 1, atol=1e-12)


@given(scenes(sheets()))
def test_no_node_is_closer_than_the_closest_point(scene):
    s, points = scene
    found = _find(s, points)
    nodes = s.x[np.unique(s.master[1])]
    to_nodes = np.linalg.norm(points[:, None] - nodes, axis=2).min(axis=1)
    assert (found["distance"] <= to_nodes + 1e-13).all()


@given(scenes(sheets()), st.floats(0.01, 3))
def test_reach_only_leaves_out(scene, reach):
    s, points = scene
    all_, near = _find(s, points), _find(s, points, reach=reach)
    inside = all_["distance"] < reach * (1 - 1e-9)
    outside = all_["distance"] > reach * (1 + 1e-9)
    assert np.array_equal(near["nearest"][inside], all_["nearest"][inside])
    assert (near["nearest"][outside] == -1).all()


@given(scenes(sheets()), powers)
def test_nothing_depends_on_the_unit_of_length(scene, scale):
    s, points = scene
    found, large = _find(s, points), _find(s.placed(scale * s.x), scale * points)
    for name in ("nearest", "facet", "feature", "xi", "normal"):
        assert np.array_equal(large[name], found[name])
    for name in ("distance", "size", "gap"):
        assert np.array_equal(large[name], scale * found[name])


@given(st.data(), scenes(sheets()))
def test_distances_do_not_change_in_a_motion(data, scene):
    s, points = scene
    rotation = data.draw(rotations(s.gdim))
    shift = np.array(data.draw(st.lists(fractions, min_size=s.gdim, max_size=s.gdim)))
    moved = _find(s.placed(s.x @ rotation.T + shift), points @ rotation.T + shift)
    np.testing.assert_allclose(moved["distance"], _find(s, points)["distance"], atol=1e-12)


@given(st.data(), scenes(sheets()))
def test_numbers_of_nodes_do_not_matter(data, scene):
    s, points = scene
    found, other = _find(s, points), _find(s.renumbered(data.draw(shuffles(len(s.x)))), points)
    for name in found:
        assert np.array_equal(other[name], found[name])
