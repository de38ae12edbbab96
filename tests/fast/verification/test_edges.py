# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edges and corners that something smooth touches."""

import functools

import numpy as np
import pytest

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
