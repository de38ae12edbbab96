# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of two stacked boxes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from dolfinx.mesh import CellType

from meshes import Tag, blocks

FACES_2D = {11, 12, 13, 15, 21, 22, 23, 25}
FACES_3D = FACES_2D | {14, 16, 24, 26}


@pytest.mark.parametrize(
    ("cell_type", "gap"), [(CellType.triangle, -0.1), (CellType.quadrilateral, 0.25)]
)
def test_2d(measures: Any, cell_type: CellType, gap: float) -> None:
    """Counts, areas, lengths and the position of both boxes."""
    data = blocks(
        cell_type, (3, 2), (4, 5), size_upper=(0.5, 0.2), size_lower=(2, 3), shift=(0.7,), gap=gap
    )
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.geometry.dim == 2
    assert data.mesh.topology.cell_type == cell_type
    assert measures(data).nodes() == 4 * 3 + 5 * 6
    assert measured.bodies() == pytest.approx({Tag.UPPER: 0.1, Tag.LOWER: 6})
    faces = measured.faces()
    assert set(faces) == FACES_2D
    assert [faces[Tag.UPPER_CONTACT], faces[Tag.UPPER_TOP]] == pytest.approx([0.5] * 2)
    assert [faces[Tag.LOWER_X0], faces[Tag.LOWER_X1]] == pytest.approx([3] * 2)
    upper, lower = measured.points(Tag.UPPER), measured.points(Tag.LOWER)
    assert upper.min(axis=0)[:2] == pytest.approx([0.7, gap])
    assert lower.max(axis=0)[:2] == pytest.approx([2, 0])


@pytest.mark.parametrize("cell_type", [CellType.tetrahedron, CellType.hexahedron])
def test_3d(measures: Any, cell_type: CellType) -> None:
    """Counts, volumes and areas."""
    data = blocks(cell_type, (3, 2, 1), (4, 5, 2), size_upper=(2, 3, 1), size_lower=(2, 3, 4))
    measured = measures(data)
    measured.check_topology()
    assert data.mesh.topology.cell_type == cell_type
    assert measures(data).nodes() == 4 * 3 * 2 + 5 * 6 * 3
    assert measured.bodies() == pytest.approx({Tag.UPPER: 6, Tag.LOWER: 24})
    faces = measured.faces()
    assert set(faces) == FACES_3D
    for name, area in (("CONTACT", 6), ("X0", 12), ("X1", 12), ("Y0", 8), ("Y1", 8), ("BOTTOM", 6)):
        assert faces[Tag[f"LOWER_{name}"]] == pytest.approx(area)
    assert [faces[Tag.UPPER_CONTACT], faces[Tag.UPPER_TOP]] == pytest.approx([6] * 2)


@pytest.mark.parametrize("cell_type", [CellType.triangle, CellType.hexahedron])
def test_matching_grids_share_no_node(measures: Any, cell_type: CellType) -> None:
    """Coincident nodes of the two bodies stay apart."""
    n = (2,) * (2 if cell_type == CellType.triangle else 3)
    data = blocks(cell_type, n, n)
    measured = measures(data)
    measured.check_topology()
    assert measures(data).nodes() == 2 * 3 ** len(n)


def test_flat_box_keeps_its_sides_apart(measures: Any) -> None:
    """A side is found by its own axis, also if the box is thin."""
    data = blocks(CellType.quadrilateral, (2, 1), (2, 1), size_upper=(1, 1e-3), size_lower=(1, 1))
    faces = measures(data).faces()
    assert faces[Tag.UPPER_CONTACT] == pytest.approx(1)
    assert faces[Tag.UPPER_X0] == pytest.approx(1e-3)


@pytest.mark.parametrize("cell_type", [CellType.triangle, CellType.hexahedron])
def test_round_bottom(measures: Any, cell_type: CellType) -> None:
    """It lies on its sphere above the middle of the box, and the top stays flat."""
    dim = 2 if cell_type == CellType.triangle else 3
    n, shift = (4,) * dim, (0.3, -0.2)[: dim - 1]
    measured = measures(blocks(cell_type, n, n, shift=shift, gap=0.1, radius=2.0))
    measured.check_topology()
    centre = np.zeros(3)
    centre[:dim] = (*(s + 0.5 for s in shift), 2.1)
    bottom = measured.facet_points(Tag.UPPER_CONTACT)
    assert np.allclose(np.linalg.norm(bottom - centre, axis=2), 2, rtol=0, atol=1e-12)
    assert bottom[..., dim - 1].min() == pytest.approx(0.1)
    assert np.allclose(measured.facet_points(Tag.UPPER_TOP)[..., dim - 1], 1.1)
    assert measured.bodies()[Tag.LOWER] == pytest.approx(1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"n_upper": (1, 1, 1)}, r"n_upper is \(1, 1, 1\); give 2 finite numbers"),
        ({"n_lower": (1, 0)}, r"n_lower\[1\] is 0; give a whole number"),
        ({"n_upper": (1.5, 1)}, r"n_upper\[0\] is 1.5; give a whole number"),
        ({"size_upper": (1, -1)}, r"size_upper\[1\] is -1; give a positive number"),
        ({"size_lower": (1,)}, r"size_lower is \(1,\); give 2 finite numbers"),
        ({"shift": (1, 1)}, r"shift is \(1, 1\); give 1 finite numbers"),
        ({"radius": 0.0}, r"radius is 0\.0; give a positive number"),
        ({"radius": 0.5}, r"radius is 0\.5; give more than 0\.5, or the corners"),
        ({"radius": 0.6, "size_upper": (1, 0.25)}, r"radius is 0\.6; give more than 0\.625"),
    ],
)
def test_bad_input(arguments: dict[str, Any], message: str) -> None:
    """The messages name the argument, its value and what to do."""
    complete = {"cell_type": CellType.triangle, "n_upper": (1, 1), "n_lower": (1, 1), **arguments}
    with pytest.raises(ValueError, match=message):
        blocks(**complete)
