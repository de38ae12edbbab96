# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of two concentric rings."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from meshes import Tag, rings

FACES = {
    Tag.UPPER_CONTACT: 1.5,
    Tag.UPPER_TOP: 1.0,
    Tag.LOWER_CONTACT: 1.5,
    Tag.LOWER_BOTTOM: 2.0,
}


def test_geometry(measures: Any) -> None:
    """Areas and lengths are those of inscribed polygons, bodies and faces are apart."""
    data = rings(20, 30)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.geometry.dim == 2
    assert data.mesh.topology.cell_name() == "quadrilateral"
    bodies, faces = measured.bodies(), measured.faces()
    assert set(bodies) == {Tag.UPPER, Tag.LOWER}
    for tag, n, inner, outer in ((Tag.UPPER, 20, 1.0, 1.5), (Tag.LOWER, 30, 1.5, 2.0)):
        sector = n * math.sin(math.pi / 2 / n) / 2
        assert bodies[tag] == pytest.approx(sector * (outer**2 - inner**2))
    assert set(faces) == {11, 12, 13, 14, 21, 22, 23, 24}
    for tag, radius in FACES.items():
        n = 20 if tag < Tag.LOWER_CONTACT else 30
        assert faces.pop(tag) == pytest.approx(2 * n * radius * math.sin(math.pi / 4 / n))
    assert list(faces.values()) == pytest.approx([0.5] * 4)


def test_faces_lie_where_they_should(measures: Any) -> None:
    """Nodes of arcs are on their circle, those of planes on their plane."""
    measured = measures(rings(7))
    for tag, radius in FACES.items():
        r = np.linalg.norm(measured.facet_points(tag), axis=2)
        assert np.allclose(r, radius, rtol=0, atol=1e-12)
    for tag in (Tag.UPPER_X0, Tag.LOWER_X0):
        assert np.allclose(measured.facet_points(tag)[..., 0], 0, atol=1e-12)
    for tag in (Tag.UPPER_Y0, Tag.LOWER_Y0):
        assert np.allclose(measured.facet_points(tag)[..., 1], 0, atol=1e-12)


@pytest.mark.parametrize(
    ("n", "n_master", "expected"), [(1, None, 2), (10, None, 15), (10, 10, 10), (9, 4, 4)]
)
def test_numbers_of_cells(measures: Any, n: int, n_master: int | None, expected: int) -> None:
    """The arcs have the cells asked for; by default they do not match."""
    measured = measures(rings(n, n_master))
    for tag in FACES:
        cells = n if tag < Tag.LOWER_CONTACT else expected
        assert len(measured.facet_points(tag)) == cells


def test_cells_are_about_square(measures: Any) -> None:
    """Radial edges are as long as those at half way between the arcs, also in thin rings."""
    data = rings(40, 60, radii=(1.0, 2.0, 2.2))
    measured = measures(data)
    for plane, n, mean in ((Tag.UPPER_Y0, 40, 1.5), (Tag.LOWER_Y0, 60, 2.1)):
        edges = measured.facet_points(plane)
        lengths = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1)
        assert np.allclose(lengths, math.pi / 2 * mean / n, rtol=0.15)


def test_radii_scale_the_mesh(measures: Any) -> None:
    """The same mesh in another unit of length."""
    small, large = rings(6), rings(6, radii=(1000.0, 1500.0, 2000.0))
    a, b = (np.sort(np.linalg.norm(d.mesh.geometry.x, axis=1)) for d in (small, large))
    assert np.allclose(1000 * a, b)


@pytest.mark.parametrize(("name", "value"), [("n", 0), ("n_master", -2), ("n", 2.5)])
def test_bad_divisions(name: str, value: float) -> None:
    """The message names the argument and its value."""
    arguments: dict[str, Any] = {"n": 4, "n_master": 6, name: value}
    with pytest.raises(ValueError, match=f"{name} is {value}; give a whole number of cells"):
        rings(**arguments)


@pytest.mark.parametrize(
    "radii",
    [
        (1.0, 2.0),
        (1.0, 1.5, 2.0, 3.0),
        (0.0, 1.0, 2.0),
        (-1.0, 1.0, 2.0),
        (1.0, 1.0, 2.0),
        (1.0, 2.0, 1.5),
        (1.0, math.nan, 2.0),
        (1.0, 2.0, math.inf),
    ],
)
def test_bad_radii(radii: tuple[float, ...]) -> None:
    """The message names the argument."""
    with pytest.raises(ValueError, match=r"radii is \(.*\); give 3 positive numbers"):
        rings(4, radii=radii)
