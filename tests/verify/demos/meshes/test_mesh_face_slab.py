# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tests of the mesh of face slabs on a cushion."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from dolfinx.mesh import CellType

from meshes import FACE_SLABS, FaceSlab, block_tag, face_slab

SIDES = ("bottom", "top", "x0", "x1", "y0", "y1")
SLICE = FACE_SLABS["slice"]


def _nodes(data: Any, body: int) -> np.ndarray:
    return np.unique(data.mesh.geometry.dofmaps[0][data.cell_tags.find(block_tag(body))])


@pytest.mark.parametrize(("name", "wanted"), [("coarse", 8000), ("paper", 58000)])
def test_presets(measures: Any, name: str, wanted: int) -> None:
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


def test_slice(measures: Any) -> None:
    """One cell along y, constant thickness, cells at the joint half as wide as a layer."""
    data = face_slab(replace(SLICE, layers=10))
    assert set(np.unique(data.mesh.geometry.x[:, 1])) == {0.0, 1.0}
    points = measures(data).facet_points(block_tag(2, "x0"))
    assert np.allclose(np.unique(points[..., 2].round(12)), np.linspace(0, 0.505, 11))
    x = np.unique(data.mesh.geometry.x[_nodes(data, 2), 0])
    assert x[1] == pytest.approx(0.0505 / 2, rel=0.05)
    assert np.all(np.diff(x) < 0.5 + 1e-12) and np.all(np.diff(x)[1:] / np.diff(x)[:-1] < 1.2001)


@pytest.mark.parametrize("slabs", range(1, 7))
def test_row(slabs: int) -> None:
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


def test_opening() -> None:
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
def test_matching(preset: str) -> None:
    """By choice slabs and cushion have the same nodes at their contact, else hardly one."""
    for matching in (True, False):
        data = face_slab(replace(FACE_SLABS[preset], matching=matching))
        x = data.mesh.geometry.x
        cushion = {tuple(p) for p in x[_nodes(data, 0)].round(9) if p[2] == 0}
        slabs = {tuple(p) for i in (1, 2) for p in x[_nodes(data, i)].round(9) if abs(p[2]) < 1e-12}
        assert (slabs == cushion) == matching
        assert len(slabs & cushion) <= (1.0 if matching else 0.1) * len(cushion)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"slabs": 0}, "slabs is 0; give a whole number"),
        ({"layers": 2.5}, r"layers is 2\.5; give a whole number"),
        ({"width": -1.0}, r"width is -1\.0; give a positive number"),
        ({"joint_size": 0.0}, r"joint_size is 0\.0; give a positive number"),
        ({"growth": 0.9}, r"growth is 0\.9; give at least 1"),
        ({"thickening": -0.1}, r"thickening is -0\.1; give a number of at least 0"),
        ({"opening": (0.0, -1e-3)}, "give two lengths, at the top and at the bottom"),
    ],
)
def test_bad_input(change: dict[str, Any], message: str) -> None:
    """The messages name the argument, its value and what to do."""
    with pytest.raises(ValueError, match=message):
        replace(FaceSlab(), **change)
