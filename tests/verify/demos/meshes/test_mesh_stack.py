# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of any number of boxes on each other."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

from dolfinx.mesh import CellType

from meshes import Tag, block_tag, stack

SIDES = {2: ("bottom", "top", "x0", "x1"), 3: ("bottom", "top", "x0", "x1", "y0", "y1")}


@pytest.mark.parametrize("cell_type", [CellType.triangle, CellType.quadrilateral])
def test_2d(measures: Any, cell_type: CellType) -> None:
    """Counts, areas, lengths and the position of three boxes."""
    sizes = [(2.0, 0.5), (2.0, 1.0), (1.0, 0.25)]
    data = stack(cell_type, [(3, 2), (4, 5), (2, 1)], sizes=sizes)
    measured = measures(data)
    assert data.mesh.geometry.dim == 2
    assert data.mesh.topology.cell_type == cell_type
    assert measured.nodes() == 4 * 3 + 5 * 6 + 3 * 2
    areas = {block_tag(i): w * h for i, (w, h) in enumerate(sizes)}
    assert measured.bodies() == pytest.approx(areas)
    faces = measured.faces()
    assert set(faces) == {block_tag(i, side) for i, side in product(range(3), SIDES[2])}
    height = 0.0
    for i, (width, rise) in enumerate(sizes):
        assert faces[block_tag(i, "bottom")] == pytest.approx(width)
        assert faces[block_tag(i, "x1")] == pytest.approx(rise)
        assert np.allclose(measured.facet_points(block_tag(i, "bottom"))[..., 1], height)
        height += rise
        assert np.allclose(measured.facet_points(block_tag(i, "top"))[..., 1], height)
        assert np.allclose(measured.facet_points(block_tag(i, "x0"))[..., 0], 0)
        assert np.allclose(measured.facet_points(block_tag(i, "x1"))[..., 0], width)


@pytest.mark.parametrize("cell_type", [CellType.tetrahedron, CellType.hexahedron])
def test_3d(measures: Any, cell_type: CellType) -> None:
    """Counts, volumes and faces of unit boxes."""
    data = stack(cell_type, [(3, 2, 1), (2, 2, 2)])
    measured = measures(data)
    assert data.mesh.topology.cell_type == cell_type
    assert measured.nodes() == 4 * 3 * 2 + 27
    assert measured.bodies() == pytest.approx({block_tag(0): 1, block_tag(1): 1})
    faces = measured.faces()
    tags = {block_tag(i, side) for i, side in product(range(2), SIDES[3])}
    assert faces == pytest.approx(dict.fromkeys(tags, 1.0))
    for k, side in product(range(2), "xy"):
        points = measured.facet_points(block_tag(1, f"{side}{k}"))
        assert np.allclose(points[..., "xy".index(side)], k)
    assert np.allclose(measured.facet_points(block_tag(1, "top"))[..., 2], 2)


@pytest.mark.parametrize("cell_type", [CellType.quadrilateral, CellType.tetrahedron])
def test_matching_grids_share_no_node(cell_type: CellType) -> None:
    """Coincident nodes of neighbours stay apart, and each block has all of its own."""
    dim = 2 if cell_type == CellType.quadrilateral else 3
    data = stack(cell_type, [(2,) * dim] * 5)
    cells = data.mesh.geometry.dofmaps[0]
    nodes = [np.unique(cells[data.cell_tags.find(block_tag(i))]) for i in range(5)]
    assert [len(own) for own in nodes] == [3**dim] * 5
    assert len(np.unique(np.concatenate(nodes))) == 5 * 3**dim


def test_tags_are_all_different() -> None:
    """Of bodies and faces, also from those of models of two bodies."""
    tags = [block_tag(i, side) for i, side in product(range(12), (None, *SIDES[3]))]
    assert len(set(tags)) == len(tags)
    assert not set(tags) & set(Tag)


def test_groups_have_names() -> None:
    """The names that gmsh and dolfinx show."""
    groups = stack(CellType.triangle, [(1, 1), (1, 1)]).physical_groups
    assert groups["block_1"].tag == block_tag(1)
    assert groups["block_1_bottom"].tag == block_tag(1, "bottom")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"index": -1}, "index is -1; give the number of a block"),
        ({"index": 0.5}, r"index is 0\.5; give the number of a block"),
        ({"index": 0, "side": "z0"}, "side is 'z0'; give one of bottom, top, x0, y0, x1, y1"),
    ],
)
def test_bad_tag(arguments: dict[str, Any], message: str) -> None:
    """The messages name the argument, its value and what to do."""
    with pytest.raises(ValueError, match=message):
        block_tag(**arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"cell_type": CellType.prism}, "cell_type is prism; give one of triangle"),
        ({"divisions": []}, "divisions is empty; give the numbers"),
        ({"divisions": [(1, 1), (1, 1, 1)]}, r"divisions\[1\] is \(1, 1, 1\); give 2 finite"),
        ({"divisions": [(1, 0), (1, 1)]}, r"divisions\[0\]\[1\] is 0; give a whole number"),
        ({"sizes": [(1, 1)]}, "sizes has 1 entries and divisions 2; give one for each box"),
        ({"sizes": [(1, 1), (1,)]}, r"sizes\[1\] is \(1,\); give 2 finite numbers"),
        ({"sizes": [(1, 1), (-1, 1)]}, r"sizes\[1\]\[0\] is -1; give a positive number"),
    ],
)
def test_bad_input(arguments: dict[str, Any], message: str) -> None:
    """The messages name the argument, its value and what to do."""
    complete = {"cell_type": CellType.triangle, "divisions": [(1, 1), (1, 1)], **arguments}
    with pytest.raises(ValueError, match=message):
        stack(**complete)
