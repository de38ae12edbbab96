# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of a cylinder on a block."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from meshes import Tag, hertz_cylinder


def lengths_near_origin(edges: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Measure the edges within 0.15 of the origin."""
    near = np.linalg.norm(edges, axis=2).max(axis=1) < 0.15
    return np.asarray(np.linalg.norm(edges[near, 1] - edges[near, 0], axis=1))


def test_geometry(measures: Any) -> None:
    """Areas and lengths are those of the disc and the block, bodies and faces are apart."""
    data = hertz_cylinder(0.02)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.geometry.dim == 2
    assert data.mesh.topology.cell_name() == "triangle"
    bodies, faces = measured.bodies(), measured.faces()
    assert set(bodies) == {Tag.UPPER, Tag.LOWER}
    assert bodies[Tag.UPPER] == pytest.approx(np.pi / 4, rel=0.005)
    assert bodies[Tag.LOWER] == pytest.approx(1)
    assert set(faces) == {11, 12, 13, 21, 22, 23}
    assert faces.pop(Tag.UPPER_CONTACT) == pytest.approx(np.pi / 2, rel=0.005)
    assert list(faces.values()) == pytest.approx([1.0] * 5)


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.01), (0.03, 0.03)])
def test_each_body_has_its_own_size(measures: Any, h_master: float | None, expected: float) -> None:
    """The sizes hold on the contact faces, where the bodies lie on each other."""
    measured = measures(hertz_cylinder(0.02, h_master))
    for tag, size in ((Tag.UPPER_CONTACT, 0.02), (Tag.LOWER_CONTACT, expected)):
        lengths = lengths_near_origin(measured.facet_points(tag))
        assert lengths.size >= 4
        assert np.allclose(lengths, size, rtol=0.15)


def test_wider_zone_has_more_nodes() -> None:
    """The zone keeps the fine size."""
    narrow, wide = (hertz_cylinder(0.02, zone=zone).mesh.geometry.x.shape[0] for zone in (0.1, 0.4))
    assert wide > 2 * narrow


@pytest.mark.parametrize("name", ["h", "h_master", "zone"])
def test_bad_size(name: str) -> None:
    """The message names the argument and its value."""
    arguments = {"h": 0.1, name: -0.5}
    with pytest.raises(ValueError, match=f"{name} is -0.5; give a positive number"):
        hertz_cylinder(**arguments)
