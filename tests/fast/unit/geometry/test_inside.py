# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that lie wholly inside each other."""

from mpi4py import MPI

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import basix.ufl
import contactx as cx
from contactx._host.bodies import Bodies
from contactx._host.parallel.halo import Halo
from dolfinx import mesh
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import CELLS, Blocks, dimension
from scenes.transforms import rotation
from story import displacement, elasticity

every_cell = pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)


def small_in_large(cell, gap):
    """A block of size 0.4 whose bottom is at the height gap, in a large block below zero."""
    dim = dimension(cell)
    return meshes.blocks(
        cell,
        (3,) * dim,
        (4,) * dim,
        size_upper=(0.4,) * dim,
        size_lower=(1.5,) * (dim - 1) + (1.0,),
        shift=(0.53,) * (dim - 1),
        gap=gap,
    )


def problem(data, slave=Tag.UPPER_CONTACT, master=Tag.LOWER_CONTACT, others=()):
    u = displacement(data.mesh)
    contact = cx.Contact(cx.Surface(data.facet_tags, slave), cx.Surface(data.facet_tags, master))
    F = elasticity(u, 1.0, 0.3)
    return cx.ContactProblem(F, u, contacts=[*others, contact], petsc_options_prefix="inside_")


@every_cell
def test_slave_body_inside(cell):
    n = 4 ** dimension(cell)
    with pytest.raises(
        ValueError,
        match=rf"body of the slave surface Surface\(tags=\(11,\).* lies wholly inside the body of "
        rf"the master surface Surface\(tags=\(21,\).* all its {n} nodes",
    ):
        problem(small_in_large(cell, -0.7))


@every_cell
def test_master_body_inside(cell):
    with pytest.raises(ValueError, match=r"body of the master surface .*\(11,\).* wholly inside"):
        problem(small_in_large(cell, -0.7), Tag.LOWER_CONTACT, Tag.UPPER_CONTACT)


@every_cell
@pytest.mark.parametrize("gap", [-0.05, -0.3, -0.4 + 1e-4])
def test_overlap_in_part_is_legal(cell, gap):
    problem(small_in_large(cell, gap))


@pytest.mark.parametrize("length", [1e-8, 1e6])
@every_cell
def test_any_unit_and_place(cell, length):
    for gap, refused in ((-0.4 + 1e-4, False), (-0.7, True)):
        data = small_in_large(cell, gap)
        x, gdim = data.mesh.geometry.x, data.mesh.geometry.dim
        Q = rotation(np.random.default_rng(2), gdim)
        x[:, :gdim] = length * (x[:, :gdim] @ Q.T + 3)
        if refused:
            with pytest.raises(ValueError, match="wholly inside"):
                problem(data)
        else:
            problem(data)


@pytest.mark.parametrize("turns", [False, True])
@every_cell
def test_a_finer_body_in_the_same_place(cell, turns):
    """Its outer nodes are on the surface of the other, but for rounding."""
    dim = dimension(cell)
    data = meshes.blocks(cell, (5,) * dim, (3,) * dim, gap=-1.0)
    if turns:
        x = data.mesh.geometry.x
        x[:, :dim] = 1e-4 * (x[:, :dim] @ rotation(np.random.default_rng(2), dim).T + 1e3)
    with pytest.raises(ValueError, match=r"body of the slave surface .* wholly inside"):
        problem(data)


def test_a_body_that_fills_a_hole():
    """All its nodes are on cells of the other one."""
    grid = np.arange(16).reshape(4, 4)
    x = np.stack(np.meshgrid(np.arange(4.0), np.arange(4.0), indexing="ij"), axis=-1)
    cells = [grid[i : i + 2, j : j + 2].ravel() for i in range(3) for j in range(3)]
    plug = [16, 17, 18, 19]
    cells[4] = plug
    points = np.concatenate([x.reshape(-1, 2), x[1:3, 1:3].reshape(-1, 2)])
    element = basix.ufl.element("Lagrange", "quadrilateral", 1, shape=(2,))
    domain = mesh.create_mesh(MPI.COMM_WORLD, np.array(cells), element, points)
    domain.topology.create_connectivity(1, 2)
    boundary = mesh.exterior_facet_indices(domain.topology)
    nodes = domain.geometry.input_global_indices[mesh.entities_to_geometry(domain, 1, boundary)]
    low = np.isclose(points[nodes][:, :, 1], 1).all(axis=1)
    values = np.where(low, np.where((nodes >= 16).all(axis=1), 1, 2), 3).astype(np.int32)
    u = displacement(domain)
    tags = mesh.meshtags(domain, 1, boundary, values)
    contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2))
    cx.ContactProblem(elasticity(u, 1.0, 0.3), u, contacts=[contact], petsc_options_prefix="plug_")
    assert contact.discrete.master.paired.all()


def test_a_refused_problem_frees_its_contacts():
    data = small_in_large(CellType.triangle, -0.7)
    tags = data.facet_tags
    floor = cx.Contact(cx.Surface(tags, Tag.LOWER_BOTTOM), cx.Plane((0, -1), (0, 1)))
    with pytest.raises(ValueError, match="wholly inside"):
        problem(data, others=[floor])
    u = displacement(data.mesh)
    cx.ContactProblem(elasticity(u, 1.0, 0.3), u, contacts=[floor], petsc_options_prefix="floor_")
    assert len(floor.multiplier) == 5


@every_cell
def test_bodies_are_the_connected_parts(cell):
    """Against SciPy, with nodes and cells in any order; named as the mesh was made."""
    scene = Blocks(cell, n_upper=4, n_lower=5)
    V = scene.u.function_space
    x = V.tabulate_dof_coordinates()
    cells = V.dofmap.list
    edges = np.repeat(cells[:, :1], cells.shape[1], axis=1).ravel(), cells.ravel()
    graph = coo_array((np.ones(cells.size), edges), shape=(len(x), len(x)))
    number, label = connected_components(graph, directed=False)
    gdim = V.mesh.geometry.dim
    halo = Halo(scene.u, x[:, :gdim])
    bodies = Bodies(V, halo)
    x = bodies.x
    assert number == 2
    names = np.array([halo.original[label == i].min() for i in range(number)])
    np.testing.assert_array_equal(bodies.names, np.sort(names))
    np.testing.assert_array_equal(bodies.of_node, names[label])
    for name in names:
        low, high = bodies.boxes_of(np.array([name]), x, gdim)
        np.testing.assert_array_equal(low[0], x[bodies.nodes(name)].min(axis=0))
        np.testing.assert_array_equal(high[0], x[bodies.nodes(name)].max(axis=0))
        assert set(cells[bodies.cells(name)].ravel()) == set(bodies.nodes(name))


class Slave:
    """A block of size 1 on the height zero whose bottom is the slave surface."""

    def __init__(self):
        self.scene = Blocks(CellType.hexahedron)

    def on(self, obstacle):
        contact = cx.Contact(cx.Surface(self.scene.tags, Tag.UPPER_CONTACT), obstacle)
        self.scene.problem(contact)


CENTRE = (0.73, 0.73, 0.5)  # where the block has a node


@pytest.mark.parametrize(
    ("obstacle", "hint"),
    [
        (cx.Plane((0, 0, 0), (0, 0, -1)), "Plane. Its normal probably points the wrong way"),
        (cx.Plane((0, 0, -3), (0, 0, -1)), "Plane. Its normal probably points the wrong way"),
        (cx.Sphere(CENTRE, 2.0), "Sphere. Perhaps hollow is the wrong way round"),
        (cx.Sphere((0, 0, -4), 2.0, hollow=True), "Sphere. Perhaps hollow is the wrong way"),
        (cx.Cylinder(CENTRE, (0, 1, 0), 2.0), "Cylinder. Perhaps hollow is the wrong way"),
        (
            cx.Cylinder((0, 0, -4), (0, 1, 0), 2.0, hollow=True),
            "Cylinder. Perhaps hollow is the wrong way",
        ),
        (cx.LevelSet(lambda x: -x[2]), "LevelSet. Perhaps the sign of its function is wrong"),
        (
            cx.LevelSet(lambda x: -x[2], lambda x: np.stack([0 * x[0], 0 * x[0], -1 + 0 * x[0]])),
            "LevelSet. Perhaps the sign of its function is wrong",
        ),
    ],
)
def test_inside_an_obstacle(obstacle, hint):
    with pytest.raises(ValueError, match=rf"all its 27 nodes are inside the {hint}"):
        Slave().on(obstacle)


@pytest.mark.parametrize(
    "obstacle",
    [
        cx.Plane((0, 0, 0.99), (0, 0, 1)),
        cx.Sphere(CENTRE, 0.8),
        cx.Sphere(CENTRE, 0.8, hollow=True),
        cx.Cylinder(CENTRE, (0, 1, 0), 0.6),
        cx.LevelSet(lambda x: x[2] - 0.99),
    ],
)
def test_deep_in_an_obstacle_is_legal(obstacle):
    Slave().on(obstacle)
    # What a function's differences are scaled with
    assert obstacle.extent == pytest.approx(1)
