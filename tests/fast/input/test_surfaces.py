# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces, tags and meshes that are no good, and some that only look so."""

from mpi4py import MPI

import numpy as np
import pytest

import basix.ufl
import contactx as cx
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
from inputs.rows import refused, scene, solved, table
from meshes import Tag
from scenes import Blocks
from scenes.cracked import Cracked
from scenes.problems import make_problem
from story import displacement, elasticity


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
# A base, of which the contact takes the top
BASE = [[-1.0, -1.0], [3, -1], [3, -0.01], [-1, -0.01]]
BASE_CELLS = [[0, 1, 2], [0, 2, 3]]


def pressed(x, cells, kind="triangle", method="node-to-surface"):
    """Press bodies, their feet at height 0 and their tops at 1, on the base."""
    element = basix.ufl.element("Lagrange", kind, 1, shape=(2,))
    domain = mesh.create_mesh(MPI.COMM_WORLD, np.array(cells), element, np.array(x, dtype=float))
    for dims in ((1, 2), (0, 2)):
        domain.topology.create_connectivity(*dims)
    V = (u := displacement(domain)).function_space

    def at(height, dim):
        return mesh.locate_entities_boundary(domain, dim, lambda x: np.isclose(x[1], height))

    feet, top = at(0, 1), at(-0.01, 1)
    facets, order = np.unique(np.concatenate([feet, top]), return_index=True)
    values = np.repeat([1, 2], [len(feet), len(top)]).astype(np.int32)[order]
    tags = mesh.meshtags(domain, 1, facets, values)
    bcs = [
        fem.dirichletbc(np.array(value), fem.locate_dofs_topological(V, 0, at(height, 0)), V)
        for value, height in (((0.0, -0.1), 1), ((0.0, 0.0), -1))
    ]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2), method=method)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], bcs)
    problem.solve()
    return contact


def square(left, right=None):
    """A body of two triangles; its nodes come one after the other."""
    right = left + 1 if right is None else right
    return [[left, 0.0], [right, 0], [right, 1], [left, 1]]


def cells_of(first):
    return [[first + k for k in cell] for cell in BASE_CELLS]


def collapsed(corner):
    """Move a corner of the slave onto the node beside it."""

    def do():
        blocks = scene()
        contact = blocks.contact()
        x = blocks.u.function_space.mesh.geometry.x
        foot = np.flatnonzero((x[:, 1] == 0) & (x[:, 0] >= 0.22) & (x[:, 0] <= 1.24))
        foot = [k for k in foot if np.isclose((x[k, 0] - 0.23) % 0.5, 0)]
        first, second = sorted(foot, key=lambda k: x[k, 0])[:2]
        x[first] += corner * (x[second] - x[first])
        solved(blocks, contact)

    return do


PINCHED = [*BASE, [0, 0], [1, 0], [0, 1], [2, 0], [2, -0.005]]
DEGENERATE = (
    "cells of the mesh are degenerate: they have no volume, or are folded .* and is cell {} of"
)
SHAPES = {
    ValueError: [
        (
            lambda: pressed(PINCHED, [*BASE_CELLS, [4, 5, 6], [5, 7, 8]]),
            r"slave surface .* is folded at 1 nodes, .* first at \(1, 0\), node 5 of .*: take",
        ),
        (
            lambda: pressed(
                [*BASE, [0, 0], [1, 0], [0, 1], [0.5, 0.5]], [*BASE_CELLS, [4, 5, 6], [5, 7, 6]]
            ),
            DEGENERATE.format(3),
        ),
        (
            lambda: pressed([*BASE, *square(0.0)], [[0, 1, 3, 2], [4, 5, 6, 7]], "quadrilateral"),
            DEGENERATE.format(1) + ".* row by row, not round about",
        ),
        (
            collapsed(1.0),
            r"1 facets of the slave surface Surface\(tags=\(11,\).* degenerate: .* repair the mesh",
        ),
    ],
}


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_slave_nodes_twice_at_the_same_place(method):
    """A crack in the slave: nearly the answer without."""
    crack = pressed(
        [*BASE, *square(0.0), *square(1.0)],
        [*BASE_CELLS, *cells_of(4), *cells_of(8)],
        method=method,
    )
    assert len(crack.slave_nodes) == 4
    assert crack.area == pytest.approx(np.full(4, 0.5))
    assert np.all(crack.multiplier > 0)
    sound = pressed(
        [*BASE, *square(0.0), [2, 0], [2, 1]],
        [*BASE_CELLS, *cells_of(4), [5, 8, 9], [5, 9, 6]],
        method=method,
    )
    assert len(sound.slave_nodes) == 3
    # It is a little stiffer
    assert 0.95 * sound.force[1] < crack.force[1] < sound.force[1]


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_bodies_at_the_same_place_share_the_load(method):
    """All vertices twice, and each surface folded over itself: two bodies that do not touch."""
    two = pressed(
        [*BASE, *square(0.0), *square(0.0)],
        [*BASE_CELLS, *cells_of(4), *cells_of(8)],
        method=method,
    )
    pressure = two.multiplier.reshape(2, -1)
    assert np.sort(pressure[0]) == pytest.approx(np.sort(pressure[1]), rel=1e-9)
    assert np.all(pressure > 0)


@pytest.mark.parametrize("kind", ["triangle", "quadrilateral"])
def test_cells_that_are_numbered_either_way(kind):
    """Negative Jacobians beside positive ones are no fault, and change nothing."""
    x = [*BASE, *square(0.0)]
    if kind == "triangle":
        one, other = [*BASE_CELLS, [4, 5, 6], [4, 6, 7]], [*BASE_CELLS, [5, 4, 6], [4, 6, 7]]
    else:
        one, other = [[0, 1, 3, 2], [4, 5, 7, 6]], [[0, 1, 3, 2], [5, 4, 6, 7]]
    corners = (np.array(x)[np.array(cells)[:, :3]] for cells in (one, other))
    signs = [np.linalg.det(c[:, 1:] - c[:, :1]) for c in corners]
    assert np.all(signs[0] > 0) and np.ptp(np.sign(signs[1])) == 2
    answers = [pressed(x, cells, kind) for cells in (one, other)]
    assert answers[1].force == pytest.approx(answers[0].force, rel=1e-12, abs=1e-15)


@table(ROWS, SHAPES)
def test_refused(row):
    refused(row)
