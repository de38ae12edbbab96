# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of a sphere on a block."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from meshes import Tag, hertz_sphere


@pytest.mark.parametrize(("h", "nodes"), [(0.04, 907), (0.02, 2441), (0.01, 9567)])
def test_node_count(measures: Any, h: float, nodes: int) -> None:
    """The numbers on which published comparisons were run."""
    data = hertz_sphere(h)
    assert measures(data).nodes() == nodes
    assert data.mesh.topology.cell_name() == "tetrahedron"


def test_geometry(measures: Any) -> None:
    """Volumes and areas are those of the ball and the block, bodies and faces are apart."""
    data = hertz_sphere(0.04)
    measured = measures(data)
    measured.check_topology()
    bodies, faces = measured.bodies(), measured.faces()
    assert set(bodies) == {Tag.UPPER, Tag.LOWER}
    assert bodies[Tag.UPPER] == pytest.approx(np.pi / 6, rel=0.02)
    assert bodies[Tag.LOWER] == pytest.approx(1)
    assert set(faces) == {11, 12, 13, 14, 21, 22, 23, 24}
    assert faces[Tag.UPPER_CONTACT] == pytest.approx(np.pi / 2, rel=0.01)
    for tag in (Tag.UPPER_TOP, Tag.UPPER_X0, Tag.UPPER_Y0):
        assert faces[tag] == pytest.approx(np.pi / 4, rel=0.01)
    for tag in (Tag.LOWER_CONTACT, Tag.LOWER_BOTTOM, Tag.LOWER_X0, Tag.LOWER_Y0):
        assert faces[tag] == pytest.approx(1)


def test_bodies_touch_in_the_origin(measures: Any) -> None:
    """Each body has its own node there."""
    data = hertz_sphere(0.04)
    for body in (Tag.UPPER, Tag.LOWER):
        x = measures(data).points(body)
        assert np.linalg.norm(x, axis=1).min() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("h", [-0.1, np.inf])
def test_bad_size(h: float) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=f"h is {h}; give a positive number"):
        hertz_sphere(h)
