# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of boxes, stacks and face slabs; what they refuse: tests/fast/input/test_meshes.py."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from dolfinx.mesh import CellType

from meshes import FACE_SLABS, Tag, block_tag, blocks, face_slab, stack

FACES_2D = {11, 12, 13, 15, 21, 22, 23, 25}
FACES_3D = FACES_2D | {14, 16, 24, 26}


@pytest.mark.parametrize(
    ("cell_type", "gap"), [(CellType.triangle, -0.1), (CellType.quadrilateral, 0.25)]
)
def test_2d(measures, cell_type, gap):
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
def test_3d(measures, cell_type):
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
def test_matching_grids_share_no_node(measures, cell_type):
    """Coincident nodes of the two bodies stay apart."""
    n = (2,) * (2 if cell_type == CellType.triangle else 3)
    data = blocks(cell_type, n, n)
    measured = measures(data)
    measured.check_topology()
    assert measures(data).nodes() == 2 * 3 ** len(n)


def test_flat_box_keeps_its_sides_apart(measures):
    """A side is found by its own axis, also if the box is thin."""
    data = blocks(CellType.quadrilateral, (2, 1), (2, 1), size_upper=(1, 1e-3), size_lower=(1, 1))
    faces = measures(data).faces()
    assert faces[Tag.UPPER_CONTACT] == pytest.approx(1)
    assert faces[Tag.UPPER_X0] == pytest.approx(1e-3)


@pytest.mark.parametrize("cell_type", [CellType.triangle, CellType.hexahedron])
def test_round_bottom(measures, cell_type):
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


SIDES_OF = {2: ("bottom", "top", "x0", "x1"), 3: ("bottom", "top", "x0", "x1", "y0", "y1")}


@pytest.mark.parametrize("cell_type", [CellType.triangle, CellType.quadrilateral])
def test_stack_in_2d(measures, cell_type):
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
    assert set(faces) == {block_tag(i, side) for i, side in product(range(3), SIDES_OF[2])}
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
def test_stack_in_3d(measures, cell_type):
    """Counts, volumes and faces of unit boxes."""
    data = stack(cell_type, [(3, 2, 1), (2, 2, 2)])
    measured = measures(data)
    assert data.mesh.topology.cell_type == cell_type
    assert measured.nodes() == 4 * 3 * 2 + 27
    assert measured.bodies() == pytest.approx({block_tag(0): 1, block_tag(1): 1})
    faces = measured.faces()
    tags = {block_tag(i, side) for i, side in product(range(2), SIDES_OF[3])}
    assert faces == pytest.approx(dict.fromkeys(tags, 1.0))
    for k, side in product(range(2), "xy"):
        points = measured.facet_points(block_tag(1, f"{side}{k}"))
        assert np.allclose(points[..., "xy".index(side)], k)
    assert np.allclose(measured.facet_points(block_tag(1, "top"))[..., 2], 2)


@pytest.mark.parametrize("cell_type", [CellType.quadrilateral, CellType.tetrahedron])
def test_matching_grids_of_a_stack_share_no_node(cell_type):
    """Coincident nodes of neighbours stay apart, and each block has all of its own."""
    dim = 2 if cell_type == CellType.quadrilateral else 3
    data = stack(cell_type, [(2,) * dim] * 5)
    cells = data.mesh.geometry.dofmaps[0]
    nodes = [np.unique(cells[data.cell_tags.find(block_tag(i))]) for i in range(5)]
    assert [len(own) for own in nodes] == [3**dim] * 5
    assert len(np.unique(np.concatenate(nodes))) == 5 * 3**dim


def test_tags_are_all_different():
    """Of bodies and faces, also from those of models of two bodies."""
    tags = [block_tag(i, side) for i, side in product(range(12), (None, *SIDES_OF[3]))]
    assert len(set(tags)) == len(tags)
    assert not set(tags) & set(Tag)


def test_groups_have_names():
    """The names that gmsh and dolfinx show."""
    groups = stack(CellType.triangle, [(1, 1), (1, 1)]).physical_groups
    assert groups["block_1"].tag == block_tag(1)
    assert groups["block_1_bottom"].tag == block_tag(1, "bottom")


SIDES = ("bottom", "top", "x0", "x1", "y0", "y1")
SLICE = FACE_SLABS["slice"]


def _nodes(data, body):
    return np.unique(data.mesh.geometry.dofmaps[0][data.cell_tags.find(block_tag(body))])


@pytest.mark.parametrize(("name", "wanted"), [("coarse", 8000), ("paper", 58000)])
def test_presets_of_slabs(measures, name, wanted):
    """Size, volumes and faces in 3D: the slabs get thicker down the slope."""
    model = FACE_SLABS[name]
    data = face_slab(model)
    measured = measures(data)
    assert data.mesh.topology.cell_type == CellType.hexahedron
    assert measured.nodes() == pytest.approx(wanted, rel=0.035)
    assert model.layers == 5
    assert model.thickness_at(0.0) == pytest.approx(0.4 + 0.0035 * 60, abs=1e-4)
    assert model.thickness_at(model.length) == pytest.approx(0.4)
    volume = 16 * 103.2 * float(model.thickness_at(51.6))
    sizes = {block_tag(0): 32 * 103.2 * 3.5, block_tag(1): volume, block_tag(2): volume}
    assert measured.bodies() == pytest.approx(sizes)
    faces = measured.faces()
    assert set(faces) == {block_tag(i, side) for i, side in product(range(3), SIDES)}
    assert faces[block_tag(1, "y0")] == pytest.approx(16 * float(model.thickness_at(0.0)))
    assert faces[block_tag(2, "x0")] == pytest.approx(volume / 16)
    assert np.allclose(measured.facet_points(block_tag(0, "top"))[..., 2], 0)


def test_slice(measures):
    """One cell along y, constant thickness, cells at the joint half as wide as a layer."""
    data = face_slab(replace(SLICE, layers=10))
    assert set(np.unique(data.mesh.geometry.x[:, 1])) == {0.0, 1.0}
    points = measures(data).facet_points(block_tag(2, "x0"))
    assert np.allclose(np.unique(points[..., 2].round(12)), np.linspace(0, 0.505, 11))
    x = np.unique(data.mesh.geometry.x[_nodes(data, 2), 0])
    assert x[1] == pytest.approx(0.0505 / 2, rel=0.05)
    assert np.all(np.diff(x) < 0.5 + 1e-12) and np.all(np.diff(x)[1:] / np.diff(x)[:-1] < 1.2001)


@pytest.mark.parametrize("slabs", range(1, 7))
def test_row_of_slabs(slabs):
    """Slabs touch at joints, share no node, and the cushion has nodes below joints and at x = 0."""
    model = replace(SLICE, slabs=slabs)
    data = face_slab(model)
    x = data.mesh.geometry.x
    nodes = [_nodes(data, i) for i in range(slabs + 1)]
    assert len(np.unique(np.concatenate(nodes))) == sum(map(len, nodes)) == len(x)
    for i in range(slabs):
        ends = model.edges[i : i + 2]
        assert np.allclose((x[nodes[i + 1], 0].min(), x[nodes[i + 1], 0].max()), ends)
    assert len(model.joints) == slabs - 1
    cushion = x[nodes[0], 0]
    for place in (0.0, *model.edges):
        assert np.abs(cushion - place).min() < 1e-12
    assert np.allclose(np.unique(cushion), -np.unique(cushion)[::-1])


def test_opening():
    """Joints gape at the bottom; top edges and the row's ends stay where they are."""
    model = replace(SLICE, slabs=3, opening=(0.0, 2e-3))
    data = face_slab(model)
    straight = face_slab(replace(model, opening=(0.0, 0.0))).mesh.geometry.x
    x = data.mesh.geometry.x
    top = np.isclose(x[:, 2], 0.505)
    assert np.allclose(x[top], straight[top])
    bottom = [x[_nodes(data, i)] for i in (1, 2, 3)]
    left, middle, right = (p[np.isclose(p[:, 2], 0), 0] for p in bottom)
    assert left.min() == -24.0 and right.max() == 24.0
    assert middle.min() - left.max() == pytest.approx(2e-3)
    assert right.min() - middle.max() == pytest.approx(2e-3)


@pytest.mark.parametrize("preset", ["slice", "coarse"])
def test_matching(preset):
    """By choice slabs and cushion have the same nodes at their contact, else hardly one."""
    for matching in (True, False):
        data = face_slab(replace(FACE_SLABS[preset], matching=matching))
        x = data.mesh.geometry.x
        cushion = {tuple(p) for p in x[_nodes(data, 0)].round(9) if p[2] == 0}
        slabs = {tuple(p) for i in (1, 2) for p in x[_nodes(data, i)].round(9) if abs(p[2]) < 1e-12}
        assert (slabs == cushion) == matching
        assert len(slabs & cushion) <= (1.0 if matching else 0.1) * len(cushion)
