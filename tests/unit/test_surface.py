# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
from mpi4py import MPI

import numpy as np
import pytest
from scenes import Blocks
from story import displacement

import contactx as cx
from contactx import meshes
from contactx.meshes import Tag
from dolfinx import mesh
from dolfinx.mesh import CellType

CELLS = [CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron]


@pytest.fixture(scope="module")
def scene():
    return Blocks(CellType.tetrahedron)


def test_several_tags_as_arguments_or_as_a_list(scene):
    one = cx.Surface(scene.tags, Tag.UPPER_CONTACT, Tag.UPPER_X0)
    other = cx.Surface(scene.tags, [Tag.UPPER_X0, Tag.UPPER_CONTACT])
    assert np.array_equal(one.facets, other.facets)
    assert len(one.facets) == 2 * len(scene.tags.find(Tag.UPPER_CONTACT))
    assert repr(one) == f"Surface(tags=(11, 13), {len(one.facets)} facets)"


def test_a_tag_that_is_not_there(scene):
    with pytest.raises(ValueError, match=r"tag 99 is not in the facet tags; there are: 11, 12"):
        cx.Surface(scene.tags, 99)


@pytest.mark.parametrize("tags", [(), ([],)])
def test_an_empty_surface(scene, tags):
    with pytest.raises(ValueError, match="at least one tag: its surface is empty"):
        cx.Surface(scene.tags, *tags)


@pytest.mark.parametrize("tag", [11.0, "11", None])
def test_a_tag_that_is_no_integer(scene, tag):
    with pytest.raises(TypeError, match="a tag is an integer"):
        cx.Surface(scene.tags, tag)


def test_arguments_in_the_wrong_order(scene):
    with pytest.raises(TypeError, match="facet_tags must be dolfinx MeshTags, not int"):
        cx.Surface(11, scene.tags)


def test_tags_of_cells():
    data = meshes.blocks(CellType.tetrahedron, (1, 1, 1), (1, 1, 1))
    with pytest.raises(ValueError, match="dimension 3, but the facets of this mesh have dimension"):
        cx.Surface(data.cell_tags, Tag.UPPER)


def test_tags_of_another_mesh(scene):
    other = Blocks(CellType.tetrahedron)
    with pytest.raises(ValueError, match="belong to another mesh than the displacement"):
        cx.Surface(scene.tags, Tag.UPPER_CONTACT).facet_nodes(other.u.function_space)


def test_facets_inside_a_body():
    domain = mesh.create_unit_cube(MPI.COMM_WORLD, 2, 2, 2)
    inside = mesh.locate_entities(domain, 2, lambda x: np.isclose(x[2], 0.5))
    tags = mesh.meshtags(domain, 2, inside, np.full(len(inside), 5, dtype=np.int32))
    surface = cx.Surface(tags, 5)
    with pytest.raises(ValueError, match="has facets inside a body, with a cell on either side"):
        surface.facet_nodes(displacement(domain).function_space)


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
