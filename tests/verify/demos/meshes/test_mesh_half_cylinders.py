# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of two half cylinders."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from meshes import Tag, half_cylinders

RADIUS = 8.0
CONTACTS = (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)


def test_geometry(measures: Any) -> None:
    """Areas and lengths are those of the discs, bodies and faces are apart."""
    data = half_cylinders(RADIUS, 0.1, zone=1.0)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.geometry.dim == 2
    assert data.mesh.topology.cell_name() == "triangle"
    bodies, faces = measured.bodies(), measured.faces()
    assert set(bodies) == {Tag.UPPER, Tag.LOWER}
    assert list(bodies.values()) == pytest.approx([math.pi / 2 * RADIUS**2] * 2, rel=2e-3)
    assert set(faces) == {*CONTACTS, Tag.UPPER_TOP, Tag.LOWER_BOTTOM}
    for arc in CONTACTS:
        assert faces[arc] == pytest.approx(math.pi * RADIUS, rel=1e-3)
    assert [faces[Tag.UPPER_TOP], faces[Tag.LOWER_BOTTOM]] == pytest.approx([2 * RADIUS] * 2)


def test_faces_lie_where_they_should(measures: Any) -> None:
    """Nodes of arcs are on their circle, those of flat faces on their plane."""
    measured = measures(half_cylinders(RADIUS, 0.1, zone=1.0))
    for arc, flat, y in zip(
        CONTACTS, (Tag.UPPER_TOP, Tag.LOWER_BOTTOM), (RADIUS, -RADIUS), strict=True
    ):
        r = np.linalg.norm(measured.facet_points(arc) - [0, y, 0], axis=2)
        assert np.allclose(r, RADIUS, rtol=0, atol=1e-12)
        assert np.allclose(measured.facet_points(flat)[..., 1], y, atol=1e-12)
    upper, lower = measured.points(Tag.UPPER), measured.points(Tag.LOWER)
    assert upper[:, 1].min() == lower[:, 1].max() == 0


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.075), (0.04, 0.04)])
def test_each_body_has_its_own_size(measures: Any, h_master: float | None, expected: float) -> None:
    """The sizes hold in the zone, and the cells are much larger far away."""
    measured = measures(half_cylinders(RADIUS, 0.05, h_master, zone=1.0))
    for tag, size in zip(CONTACTS, (0.05, expected), strict=True):
        edges = measured.facet_points(tag)
        lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1)
        near = np.linalg.norm(edges, axis=2).max(axis=1) < 0.8
        assert near.sum() > 15
        assert np.allclose(lengths[near], size, rtol=0.15)
        assert 0.5 < lengths.max() < 1.0


def test_nodes_do_not_match(measures: Any) -> None:
    """But for the origin, no node of one arc is above one of the other."""
    measured = measures(half_cylinders(RADIUS, 0.05, zone=1.0))
    upper, lower = (np.unique(measured.facet_points(tag)[..., 0]) for tag in CONTACTS)
    upper, lower = (x[np.abs(x) < 0.5] for x in (upper, lower))
    close = np.abs(upper[:, None] - lower).min(axis=1) < 1e-3
    assert close.sum() < len(upper) / 2


def test_radius_scales_the_mesh() -> None:
    """The same mesh in another unit of length."""
    small, large = (half_cylinders(R, R / 8, zone=R / 4) for R in (1.0, 1024.0))
    a, b = (np.sort(np.linalg.norm(d.mesh.geometry.x, axis=1)) for d in (small, large))
    assert np.allclose(1024 * a, b)


@pytest.mark.parametrize(
    ("name", "value"), [("radius", 0.0), ("h", -0.5), ("h_master", math.nan), ("zone", 0.0)]
)
def test_bad_size(name: str, value: float) -> None:
    """The message names the argument and its value."""
    arguments = {"radius": 1.0, "h": 0.1, "zone": 0.2, name: value}
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        half_cylinders(**arguments)


def test_zone_beyond_the_body() -> None:
    """The message names the limit."""
    with pytest.raises(ValueError, match=r"zone is 1\.5; give at most the radius, 1\.0"):
        half_cylinders(1.0, 0.1, zone=1.5)
