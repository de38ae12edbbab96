# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the hexahedral mesh of a spherical cap on a block."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from meshes import Tag, hertz_cap


def test_geometry(measures: Any) -> None:
    """Counts, volumes and areas are those of the bodies, bodies and faces are apart."""
    data = hertz_cap(8)
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_name() == "hexahedron"
    assert measures(data).nodes() == 9**3 + 13**3
    bodies, faces = measured.bodies(), measured.faces()
    # The cap takes about r^2 / (2 R) off each column; its mean over the square is 1/24 L.
    assert bodies[Tag.UPPER] == pytest.approx(1 - 1 / 24, rel=0.002)
    assert bodies[Tag.LOWER] == pytest.approx(1)
    assert set(faces) == {11, 12, 13, 14, 21, 22, 23, 24}
    assert faces[Tag.UPPER_TOP] == pytest.approx(1)
    for tag in (Tag.LOWER_CONTACT, Tag.LOWER_BOTTOM, Tag.LOWER_X0, Tag.LOWER_Y0):
        assert faces[tag] == pytest.approx(1)


def test_cap_lies_on_its_sphere(measures: Any) -> None:
    """In another unit and with another radius."""
    data = hertz_cap(4, 3, length=10.0, radius=50.0)
    facets = measures(data).facet_points(Tag.UPPER_CONTACT)
    x = np.unique(facets.reshape(-1, 3).round(9), axis=0)
    assert x.shape == (25, 3)
    assert np.allclose(np.linalg.norm(x - [0, 0, 50.0], axis=1), 50.0)
    assert x.min(axis=0) == pytest.approx(0, abs=1e-12)


def test_cells_grow_away_from_the_contact(measures: Any) -> None:
    """The longest edge is four times as long as the shortest, in both bodies."""
    data = hertz_cap(6)
    for body, coordinate in ((Tag.UPPER, 0), (Tag.LOWER, 0), (Tag.LOWER, 2)):
        lengths = np.diff(np.unique(np.abs(measures(data).points(body)[:, coordinate]).round(9)))
        assert np.all(np.diff(lengths) > 0)
        assert lengths[-1] / lengths[0] == pytest.approx(4, rel=1e-6)


def test_one_cell(measures: Any) -> None:
    """The smallest mesh works."""
    assert measures(hertz_cap(1, 1)).nodes() == 16


def test_bad_input() -> None:
    """The messages name the argument, its value and what to do."""
    with pytest.raises(ValueError, match="n is 0; give a whole number"):
        hertz_cap(0)
    with pytest.raises(ValueError, match="n_master is -2; give a whole number"):
        hertz_cap(2, -2)
    with pytest.raises(ValueError, match=r"length is 0\.0; give a positive number"):
        hertz_cap(2, length=0.0)
    with pytest.raises(ValueError, match=r"radius is 1\.5; give at least twice the length"):
        hertz_cap(2, radius=1.5)
