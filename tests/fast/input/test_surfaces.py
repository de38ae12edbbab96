# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces and tags."""

from mpi4py import MPI

import numpy as np

import contactx as cx
from dolfinx import mesh
from dolfinx.mesh import CellType

import meshes
from inputs.rows import refused, scene, solved, table
from meshes import Tag
from scenes import Blocks
from scenes.cracked import Cracked
from story import displacement


def surface(*tags):
    return cx.Surface(scene().tags, *tags)


def wedges():
    """Facets of a mesh of wedges."""
    domain = mesh.create_box(MPI.COMM_WORLD, [[0, 0, 0], [1, 1, 1]], [1, 1, 1], CellType.prism)
    facets = np.arange(5, dtype=np.int32)
    cx.Surface(mesh.meshtags(domain, 2, facets, np.full(5, 1, dtype=np.int32)), 1)


def tagged(dim, entities, value=5):
    """Tags of entities of new blocks."""
    blocks = scene()
    entities = np.array(entities, dtype=np.int32)
    tags = mesh.meshtags(
        blocks.u.function_space.mesh, dim, entities, np.full(len(entities), value, dtype=np.int32)
    )
    return blocks, tags


def inner(role):
    """Some facets between cells."""
    blocks = scene()
    domain = blocks.u.function_space.mesh
    domain.topology.create_connectivity(1, 2)
    outer = mesh.exterior_facet_indices(domain.topology)
    every = np.arange(domain.topology.index_map(1).size_local, dtype=np.int32)
    which = np.setdiff1d(every, outer)[:2]
    inside = cx.Surface(mesh.meshtags(domain, 1, which, np.full(2, 5, dtype=np.int32)), 5)
    outside = cx.Surface(blocks.tags, Tag.LOWER_CONTACT)
    sides = (inside, outside) if role == "slave" else (outside, inside)
    solved(blocks, cx.Contact(*sides))


def foreign(role):
    """A surface of another mesh."""
    blocks, other = scene(), scene()
    tags = (other.tags, blocks.tags) if role == "slave" else (blocks.tags, other.tags)
    solved(
        blocks,
        cx.Contact(cx.Surface(tags[0], Tag.UPPER_CONTACT), cx.Surface(tags[1], Tag.LOWER_CONTACT)),
    )


def touching_nodes():
    blocks = scene()
    sides = (cx.Surface(blocks.tags, tag) for tag in (Tag.UPPER_CONTACT, Tag.UPPER_X0))
    solved(blocks, cx.Contact(*sides))


def stitched(gdim):
    """A crack whose faces have a node in common beside its tip."""
    body = Cracked(gdim, stitch=True)
    body.problem([body.contact()])


def nodes_of_a_facet():
    blocks = Blocks(CellType.quadrilateral, n_upper=1)
    master = cx.Surface(blocks.tags, Tag.UPPER_X0, Tag.UPPER_X1)
    solved(blocks, cx.Contact(cx.Surface(blocks.tags, Tag.UPPER_CONTACT), master))


def same_facets():
    blocks = scene()
    both = cx.Surface(blocks.tags, Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
    cx.Contact(both, cx.Surface(blocks.tags, Tag.LOWER_CONTACT))


def away():
    blocks = scene()
    sides = (cx.Surface(blocks.tags, tag) for tag in (Tag.UPPER_TOP, Tag.LOWER_CONTACT))
    solved(blocks, cx.Contact(*sides, search_distance=5.0))


def cells_as_facets():
    data = meshes.blocks(CellType.tetrahedron, (1, 1, 1), (1, 1, 1))
    cx.Surface(data.cell_tags, Tag.UPPER)


INSIDE = (
    r"Surface\(tags=\(5,\).* facets inside a body.*must be part of the boundary. "
    "Two bodies that share .* in gmsh do not fragment the bodies"
)
OTHER = r"facet tags of Surface\(tags=\({},\).* belong to another mesh than the displacement"
ROWS = {
    ValueError: [
        (wedges, "cells of the kind prism, .* triangles, quadrilaterals"),
        (lambda: surface(), "at least one tag: its surface is empty"),
        (lambda: surface([]), "at least one tag: its surface is empty"),
        (lambda: surface(99), "tag 99 is not in the facet tags; there are: 11, 12"),
        (lambda: surface(11, 98), "tag 98 is not in the facet tags; there are: 11, 12"),
        (lambda: surface(2**40), "tag 1099511627776 is not in"),
        (
            cells_as_facets,
            "facet_tags are tags of entities of dimension 3, but the facets of this mesh .* 2: ",
        ),
        (
            lambda: cx.Surface(tagged(0, [0, 1])[1], 5),
            "facet_tags are tags of entities of dimension 0",
        ),
        (
            lambda: cx.Surface(tagged(1, [])[1], 5),
            "tag 5 is not in the facet tags; there are: none",
        ),
        (
            lambda: cx.Surface(tagged(1, [10**6])[1], 5),
            "facet_tags have the facet 1000000, but the mesh has the facets 0 to 48 .* take their",
        ),
        (
            lambda: cx.Surface(tagged(1, [-3])[1], 5),
            "facet_tags have the facet -3, but the mesh has the facets 0 to 48",
        ),
        (lambda: inner("slave"), INSIDE),
        (lambda: inner("master"), INSIDE),
        (lambda: foreign("slave"), OTHER.format(11)),
        (lambda: foreign("master"), OTHER.format(21)),
        (same_facets, "slave and master overlap: .* facets in common"),
        (touching_nodes, "slave surface .* faces away .* Check the"),
        (
            nodes_of_a_facet,
            (
                "slave and master overlap: .* share 2 nodes. .* do not fragment the bodies. Faces "
                "of a crack may share"
            ),
        ),
        (lambda: stitched(2), "slave and master overlap: .* share 3 nodes"),
        (lambda: stitched(3), "slave and master overlap: .* share 17 nodes"),
        (away, "slave surface .* faces away .* Check the tags"),
        (
            lambda: surface(11).facet_nodes(
                displacement(scene().u.function_space.mesh).function_space
            ),
            OTHER.format(11),
        ),
    ],
    TypeError: [
        (lambda: surface(11.0), r"a tag is an integer, not 11\.0: write"),
        (lambda: surface(float("nan")), "a tag is an integer, not nan"),
        (lambda: surface("11"), "a tag is an integer, not '1'"),
        (lambda: surface(None), "a tag is an integer, not None"),
        (lambda: surface(np.array([[11]])), "a tag is an integer, not array"),
        (
            lambda: cx.Surface(11, scene().tags),
            r"facet_tags must be dolfinx MeshTags, not int: write Surface\(facet_tags, tag\)",
        ),
        (lambda: cx.Surface(None, 1), "facet_tags must be .*, not None"),
        (
            lambda: cx.Contact(11, surface(21)),
            r"slave must be a contactx.Surface, not int: write Surface\(facet_tags, tag\)",
        ),
        (
            lambda: cx.Contact(cx.Plane((0, 0), (0, 1)), surface(21)),
            "slave must be a contactx.Surface, not Plane",
        ),
        (
            lambda: cx.Contact(surface(11), 21),
            "master must be a contactx.Surface or a rigid obstacle, not int",
        ),
        (
            lambda: cx.Contact(surface(11), [surface(21)]),
            "master must be a contactx.Surface or a rigid obstacle, not list",
        ),
        (
            lambda: cx.Contact(surface(11), cx.Plane),
            "master must be a contactx.Surface or a rigid obstacle, not the class Plane",
        ),
    ],
}


@table(ROWS)
def test_refused(row):
    refused(row)
