# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Areas and normals of nodes, shape functions."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from contactx import cpp as core

from inputs.core import fractions, powers, rotations, sheets, shuffles, wild_surfaces


def _areas(s):
    return core.nodal_areas(*s.slave, s.x, s.gdim)


def _normals(s):
    return core.nodal_normals(*s.slave, s.x, s.gdim)


@given(wild_surfaces())
def test_any_surface_has_finite_areas_and_normals(s):
    area, normal = _areas(s), _normals(s)
    assert np.isfinite(area).all()
    assert (area >= 0).all()
    length = np.linalg.norm(normal, axis=1)
    assert ((length == 0) | (np.abs(length - 1) < 1e-12)).all()


@given(sheets(), powers)
def test_areas_scale_and_normals_do_not(s, scale):
    large = s.placed(scale * s.x)
    assert np.array_equal(_areas(large), scale ** (s.gdim - 1) * _areas(s))
    assert np.array_equal(_normals(large), _normals(s))


@given(st.data(), sheets())
def test_areas_and_normals_follow_a_motion(data, s):
    rotation = data.draw(rotations(s.gdim))
    shift = data.draw(st.lists(fractions, min_size=s.gdim, max_size=s.gdim))
    moved = s.placed(s.x @ rotation.T + shift)
    np.testing.assert_allclose(_areas(moved), _areas(s), atol=1e-13)
    np.testing.assert_allclose(_normals(moved), _normals(s) @ rotation.T, atol=1e-12)


@given(st.data(), sheets())
def test_areas_and_normals_follow_their_nodes(data, s):
    new = data.draw(shuffles(len(s.x)))
    other = s.renumbered(new)
    assert np.array_equal(_areas(other)[new], _areas(s))
    assert np.array_equal(_normals(other)[new], _normals(s))


@given(st.integers(2, 4), st.lists(st.tuples(fractions, fractions)))
def test_shape_functions_sum_to_one(num_nodes, points):
    values = core.shape_functions(num_nodes, np.reshape(points, (-1, 2)))
    assert values.shape == (len(points), num_nodes)
    np.testing.assert_allclose(values.sum(axis=1), 1, atol=1e-14)
