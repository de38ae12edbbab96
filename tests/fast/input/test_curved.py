# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes of a higher order, whose cells may be curved."""

import importlib

import numpy as np
import press_fit
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from meshes import build
from scenes import CELLS, Blocks, dimension
from scenes.covering import METHODS, covering

# DOLFINx reads no hexahedra of order 3 from gmsh
ORDERS = [(cell, order) for cell in CELLS for order in (2, 3)][:-1]
STACKED = "meshes.stacked"
GAP = 0.1
# Heights of the faces, and where vertices are along the first axis
UPPER_CONTACT, UPPER_TOP = (GAP, 0.23), (1 + GAP, 0.23)
LOWER_CONTACT = (0.0, 0.0)


def bulge(face, by=0.01):
    """Moves the nodes of a face of the blocks upwards, but for the vertices."""
    height, first = face

    def move(x):
        at = np.isclose(x[:, -1], height)
        x[at, -1] += by * (1 - np.cos(4 * np.pi * (x[at, 0] - first))) / 2

    return move


@pytest.fixture
def of_order(monkeypatch):
    """Make the meshes of a module of another order, and move their nodes by a function."""

    def change(module, order, move=None):
        def build_mesh(name, dim, recipe, comm, options=None):
            def changed(gmsh):
                recipe(gmsh)
                gmsh.model.mesh.setOrder(order)
                tags, x, _ = gmsh.model.mesh.getNodes()
                x = x.reshape(-1, 3)
                if move is not None:
                    move(x[:, :dim])
                    for tag, place in zip(tags, x, strict=True):
                        gmsh.model.mesh.setNode(tag, place, [])

            return build.build_mesh(name, dim, changed, comm, options)

        monkeypatch.setattr(importlib.import_module(module), "build_mesh", build_mesh)

    return change


def solved(cell, master=None, method=METHODS[0]):
    """Forces and pressures of the blocks, slave nodes in the order of their places."""
    scene = Blocks(cell, gap=GAP, down=0.15)
    contact = scene.contact(master=master, method=method)
    scene.problem(contact).solve()
    x = scene.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    return contact.force, contact.multiplier[np.lexsort(np.round(x, 9).T)]


def assert_same(one, other):
    for a, b in zip(one, other, strict=True):
        assert np.abs(a).max() > 0
        assert a == pytest.approx(b, rel=1e-9, abs=1e-9 * np.abs(b).max())


@covering(**{"cell,order": ORDERS}, scheme=METHODS)
def test_straight_cells_are_as_those_of_order_one(cell, order, scheme, of_order):
    expected = solved(cell, method=scheme)
    of_order(STACKED, order)
    assert_same(solved(cell, method=scheme), expected)


@covering(cell=CELLS, scheme=METHODS)
def test_the_bulk_may_be_curved_where_nothing_touches(cell, scheme, of_order):
    of_order(STACKED, 2, bulge(UPPER_TOP))
    force, pressure = solved(cell, method=scheme)
    assert force[-1] > 0 and pressure.max() > 0


@covering(
    **{"face,name": [(UPPER_CONTACT, "slave"), (LOWER_CONTACT, "master")], "cell,order": ORDERS},
    by=(0.01, 1e-4, -1e-4),
)
def test_a_curved_contact_surface_is_refused(face, name, cell, order, by, of_order):
    of_order(STACKED, order, bulge(face, by))
    message = (
        rf"^{name} Surface\(.*\) is curved: the mesh is of order {order}, and "
        r"\d+ of these facets have nodes up to .* away from .* first at \(.*\)\. .* "
        r"make the mesh of order 1, in gmsh by gmsh\.model\.mesh\.setOrder\(1\)"
    )
    with pytest.raises(ValueError, match=message):
        solved(cell)


@pytest.mark.parametrize("cell", (CellType.triangle, CellType.hexahedron), ids=lambda c: c.name)
def test_against_an_obstacle_only_the_slave_counts(cell, of_order):
    dim = dimension(cell)
    floor = cx.Plane(np.zeros(dim), np.eye(dim)[-1])
    of_order(STACKED, 2)
    expected = solved(cell, floor)
    of_order(STACKED, 2, bulge(LOWER_CONTACT))
    assert_same(solved(cell, floor), expected)
    of_order(STACKED, 2, bulge(UPPER_CONTACT))
    with pytest.raises(ValueError, match=r"slave Surface.* is curved"):
        solved(cell, floor)


def test_round_meshes_of_gmsh(of_order):
    """Their nodes between the vertices are on the circle."""
    of_order("meshes.rings", 2)
    with pytest.raises(ValueError, match=r"slave Surface.* nodes up to 0\.000\d* away"):
        press_fit.create(0.1, "finite")
    # What the message says
    of_order("meshes.rings", 1)
    press_fit.create(0.1, "finite")
