# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later

import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import CELLS, Blocks


@pytest.fixture(scope="module")
def scene():
    return Blocks(CellType.tetrahedron)


def test_several_tags_as_arguments_or_as_a_list(scene):
    one = cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0)
    other = cx.Surface(scene.tags, [Tag.UPPER_X0, Tag.UPPER_CONTACT])
    assert np.array_equal(one.facets, other.facets)
    assert len(one.facets) == 2 * len(scene.tags.find(Tag.UPPER_CONTACT))
    assert repr(one) == f"Surface(tags=(11, 13), {len(one.facets)} facets)"


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
@pytest.mark.parametrize("tag", [Tag.UPPER_CONTACT, Tag.LOWER_CONTACT, Tag.LOWER_X0])
def test_normals_point_outward(cell, tag):
    scene = Blocks(cell)
    V = scene.u.function_space
    facets = cx.Surface(scene.tags, tag).facet_nodes(V)
    x = V.tabulate_dof_coordinates()
    outward = {Tag.UPPER_CONTACT: -1, Tag.LOWER_CONTACT: 1, Tag.LOWER_X0: -1}[tag]
    axis = 0 if tag == Tag.LOWER_X0 else V.mesh.geometry.dim - 1
    for first, last in zip(facets.offsets, facets.offsets[1:], strict=False):
        p = x[facets.nodes[first:last]]
        t = p[1] - p[0]
        n = np.array([t[1], -t[0], 0]) if len(p) == 2 else np.cross(t, p[2] - p[0])
        assert np.allclose(n / np.linalg.norm(n), outward * np.eye(3)[axis])
