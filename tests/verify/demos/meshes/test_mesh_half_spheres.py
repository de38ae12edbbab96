# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of two half spheres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from meshes import Tag, half_spheres

RADIUS = 8.0
CONTACTS = (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
BODIES = (Tag.UPPER, Tag.LOWER)


def test_geometry(measures: Any) -> None:
    """Volumes and areas are those of the balls, bodies and faces are apart."""
    data = half_spheres(RADIUS, 0.4, zone=1.0)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_name() == "tetrahedron"
    bodies, faces = measured.bodies(), measured.faces()
    assert set(bodies) == set(BODIES)
    assert list(bodies.values()) == pytest.approx([math.pi / 6 * RADIUS**3] * 2, rel=0.02)
    assert set(faces) == {11, 12, 13, 14, 21, 22, 23, 24}
    for tag, area in faces.items():
        expected = math.pi / (2 if tag in CONTACTS else 4) * RADIUS**2
        assert area == pytest.approx(expected, rel=0.01)


def test_faces_lie_where_they_should(measures: Any) -> None:
    """Nodes of spheres are on them, those of flat faces in their planes; both touch the origin."""
    measured = measures(half_spheres(RADIUS, 0.4, zone=1.0))
    flats = (Tag.UPPER_TOP, Tag.LOWER_BOTTOM)
    for ball, flat, body, z in zip(CONTACTS, flats, BODIES, (RADIUS, -RADIUS), strict=True):
        r = np.linalg.norm(measured.facet_points(ball) - [0, 0, z], axis=2)
        assert np.allclose(r, RADIUS, rtol=0, atol=1e-10)
        assert np.allclose(measured.facet_points(flat)[..., 2], z, atol=1e-10)
        assert np.linalg.norm(measured.points(body), axis=1).min() == pytest.approx(0, abs=1e-10)


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.3), (0.1, 0.1)])
def test_each_body_has_its_own_size(measures: Any, h_master: float | None, expected: float) -> None:
    """The sizes hold in the zone, and the cells are much larger far away."""
    measured = measures(half_spheres(RADIUS, 0.2, h_master, zone=1.0))
    for tag, size in zip(CONTACTS, (0.2, expected), strict=True):
        corners = measured.facet_points(tag)
        lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean(axis=1)
        near = np.linalg.norm(corners, axis=2).max(axis=1) < 0.9
        assert near.sum() > 8
        assert np.mean(lengths[near]) == pytest.approx(size, rel=0.15)
        assert 1.0 < lengths.max() < 2.0


@pytest.mark.parametrize(
    ("name", "value"), [("radius", 0.0), ("h", -0.5), ("h_master", math.nan), ("zone", 0.0)]
)
def test_bad_size(name: str, value: float) -> None:
    """The message names the argument and its value."""
    arguments = {"radius": 1.0, "h": 0.1, "zone": 0.2, name: value}
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        half_spheres(**arguments)


def test_zone_beyond_the_body() -> None:
    """The message names the limit."""
    with pytest.raises(ValueError, match=r"zone is 1\.5; give at most the radius, 1\.0"):
        half_spheres(1.0, 0.1, zone=1.5)
