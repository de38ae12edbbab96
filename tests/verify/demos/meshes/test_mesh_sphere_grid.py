# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the hexahedral mesh of a sphere's part on a block."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from meshes import Tag, hertz_grid


def test_geometry(measures: Any) -> None:
    """Volumes and areas are those of the bodies, bodies and faces are apart."""
    data = hertz_grid(0.04)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_name() == "hexahedron"
    bodies, faces = measured.bodies(), measured.faces()
    # Height 1 less the rise of the sphere above the square, by the midpoint rule
    x = 0.6 * (np.arange(500) + 0.5) / 500
    depth = np.sqrt(1 - x[:, None] ** 2 - x**2).mean()
    assert bodies[Tag.UPPER] == pytest.approx(0.36 * depth, rel=2e-3)
    assert bodies[Tag.LOWER] == pytest.approx(1)
    assert set(faces) == {11, 12, 13, 14, 21, 22, 23, 24}
    assert faces[Tag.UPPER_TOP] == pytest.approx(0.36)
    for tag in (Tag.LOWER_CONTACT, Tag.LOWER_BOTTOM, Tag.LOWER_X0, Tag.LOWER_Y0):
        assert faces[tag] == pytest.approx(1)


def test_sphere(measures: Any) -> None:
    """The contact face lies on the unit sphere that touches the origin."""
    x = measures(hertz_grid(0.1)).facet_points(Tag.UPPER_CONTACT)
    assert np.allclose(np.linalg.norm(x - [0, 0, 1], axis=2), 1, rtol=0, atol=1e-12)
    assert x.min() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(("h_master", "expected"), [(None, 0.06), (0.04, 0.04)])
def test_sizes(measures: Any, h_master: float | None, expected: float) -> None:
    """Cells are of one size in the zone and grow beyond, by a quarter at most."""
    measured = measures(hertz_grid(0.04, h_master))
    for tag, size in ((Tag.UPPER, 0.04), (Tag.LOWER, expected)):
        across = np.unique(measured.points(tag)[:, 0].round(9))
        lengths = np.diff(across)
        zone = across[1:] < 0.2 + 1e-6
        assert lengths[zone] == pytest.approx(size, rel=0.15)
        assert np.ptp(lengths[zone]) < 1e-6
        assert np.all(lengths[1:] / lengths[:-1] < 1.26)
    depth = -np.unique(measured.points(Tag.LOWER)[:, 2].round(9))[::-1]
    assert 0.5 * expected < depth[1] <= expected + 1e-9


@pytest.mark.parametrize(("name", "value"), [("h", 0.0), ("h_master", -0.1), ("h", np.nan)])
def test_bad_size(name: str, value: float) -> None:
    """The message names the argument and its value."""
    with pytest.raises(ValueError, match=f"{name} is {value}; give a positive number"):
        hertz_grid(**{"h": 0.1, name: value})


def test_larger_than_the_zone() -> None:
    """The message names the limit."""
    with pytest.raises(ValueError, match=r"h is 0\.3; give at most .* 0\.2"):
        hertz_grid(0.3)
