# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The mesh of a dam's face: slabs on the plane of the rockfill's face, in their valley."""

import numpy as np
import pytest

import ufl
from dolfinx import fem

from meshes import DamFace, block_tag, dam_face

MODEL = DamFace(slabs=3, rows=6, layers=2, rockfill_rows=5, joint_size=1.0)


@pytest.fixture(scope="module")
def data():
    return dam_face(MODEL)


def nodes_on(data, tag):
    facets = data.facet_tags.find(tag)
    V = fem.functionspace(data.mesh, ("Lagrange", 1))
    return V.tabulate_dof_coordinates()[fem.locate_dofs_topological(V, 2, facets)]


def test_slabs_lie_on_the_face_and_meet_at_joints(data):
    assert np.allclose(nodes_on(data, block_tag(0, "top"))[:, 2], 0, atol=1e-9)
    for i in range(1, 4):
        assert np.allclose(nodes_on(data, block_tag(i, "bottom"))[:, 2], 0, atol=1e-9)
        left, right = (nodes_on(data, block_tag(i, side))[:, 0] for side in ("x0", "x1"))
        assert np.allclose(left, MODEL.edges[i - 1]) and np.allclose(right, MODEL.edges[i])
    faces = [nodes_on(data, block_tag(1, "x1")), nodes_on(data, block_tag(2, "x0"))]
    assert np.allclose(*(face[np.lexsort(face.T.round(6))] for face in faces))


def test_slabs_cover_the_face(data, measures):
    faces = measures(data).faces()
    areas = [faces[block_tag(i, "bottom")] for i in range(1, 4)]
    assert sum(areas) == pytest.approx(faces[block_tag(0, "top")], rel=0.02)
    # Up to the crest, from a level bed between two banks
    length = (MODEL.height - MODEL.ground(np.linspace(-24, 24, 10_001)).mean()) / MODEL.up[1]
    assert sum(areas) == pytest.approx(MODEL.length * length, rel=0.02)


def test_slabs_get_thicker_downwards(data):
    top = nodes_on(data, block_tag(2, "top"))
    elevation = top[:, 1] * MODEL.up[1]
    assert np.allclose(top[:, 2], MODEL.thickness_at(elevation))
    assert MODEL.thickness_at(0.0) == pytest.approx(0.4 + 0.0035 * 178)


def test_the_dam_is_a_trapezium_in_its_section(data):
    """In the direction of the valley both slopes are 1:1.4, the crest is level."""
    nodes = nodes_on(data, block_tag(0, "bottom"))
    up, level = np.array([0, *MODEL.up[1:]]), np.array([0, MODEL.up[2], -MODEL.up[1]])
    elevation, along = nodes @ up, nodes @ level
    expected = MODEL.slope * MODEL.height + MODEL.crest + MODEL.slope * (MODEL.height - elevation)
    assert np.allclose(along, expected)
    assert elevation.max() == pytest.approx(MODEL.height)
    assert elevation.min() == pytest.approx(0, abs=1e-9)


def test_all_cells_have_a_volume(data, measures):
    assert all(volume > 0 for volume in measures(data).bodies().values())
    J = ufl.JacobianDeterminant(data.mesh)
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    values = fem.Expression(J, points).eval(data.mesh, np.arange(len(data.cell_tags.indices)))
    assert np.all(values > 0) or np.all(values < 0)
