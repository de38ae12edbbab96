# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A contact: its results, its frozen kinematics, the mesh of its forms, and forces of cells."""

import gc
import weakref

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from contactx._host import contact_mesh
from contactx._host.bulk_host import CellForces
from dolfinx import cpp, mesh
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.materials import neo_hookean
from story import displacement, elasticity


@pytest.fixture(scope="module")
def scene():
    return Blocks(CellType.tetrahedron)


def surface(scene, *tags):
    return cx.Surface(scene.tags, *tags)


@pytest.mark.parametrize("name", ["pressure", "force", "multiplier", "gap"])
def test_results_before_there_are_any(scene, name):
    with pytest.raises(RuntimeError, match="has no results yet: pass it to a ContactProblem first"):
        getattr(scene.contact(), name)


@pytest.mark.parametrize("cell", [CellType.triangle, CellType.hexahedron], ids=lambda c: c.name)
def test_fields(cell):
    scene = Blocks(cell)
    contact = scene.contact()
    problem = scene.problem(contact)
    assert problem.solve() is scene.u
    V = scene.u.function_space
    gdim = V.mesh.geometry.dim
    X = V.tabulate_dof_coordinates()
    Q = contact.pressure.function_space
    nodes = [
        np.argmin(np.linalg.norm(Q.tabulate_dof_coordinates() - X[s], axis=1))
        for s in contact.slave_nodes
    ]
    # Two nodes of different bodies may be at one place: tell them apart by the status
    on_slave = np.flatnonzero(contact.status.x.array >= 0)
    assert len(on_slave) == len(nodes)
    assert np.allclose(
        np.sort(Q.tabulate_dof_coordinates()[on_slave, 0]), np.sort(X[contact.slave_nodes, 0])
    )
    off = np.setdiff1d(np.arange(len(Q.tabulate_dof_coordinates())), on_slave)
    assert not contact.pressure.x.array[off].any()
    assert np.all(np.isnan(contact.gap.x.array[off]))
    pressure = contact.pressure.x.array[nodes]
    assert contact.area @ pressure == pytest.approx(contact.area @ contact.multiplier, rel=1e-13)
    # Recovered: other than the multipliers, and near them
    change = np.abs(pressure - contact.multiplier).max() / contact.multiplier.max()
    assert 0.01 < change < 0.2
    closed = contact.status.x.array == 2
    assert np.all((contact.pressure.x.array > 0) == closed)
    assert np.abs(contact.gap.x.array[closed]).max() <= 1e-12
    traction = contact.traction.x.array.reshape(-1, gdim)
    assert np.linalg.norm(traction[contact.slave_nodes], axis=1) == pytest.approx(
        pressure, abs=1e-15
    )
    total = (traction[contact.slave_nodes] * contact.area[:, None]).sum(axis=0)
    # The deformed faces are not quite plane
    change = np.linalg.norm(contact.force - total)
    size = np.linalg.norm(contact.multiplier * contact.area, ord=1)
    assert problem.report.recovery == pytest.approx([change / size], rel=1e-6)
    assert change <= 1e-3 * size
    assert contact.force[-1] > 0
    assert contact.area.sum() == pytest.approx(1, rel=1e-13)


def test_repr(scene):
    assert repr(scene.contact()) == (
        "Contact(slave=Surface(tags=(11,), 8 facets), master=Surface(tags=(21,), 18 facets), "
        "sliding='finite')"
    )


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.hexahedron])
def test_slip_is_the_same_when_it_is_frozen(cell):
    """Above a ridge, where a step begins with a gap."""
    scene = Blocks(cell, gap=0.6, n_upper=9, n_lower=2)
    domain = scene.u.function_space.mesh
    x, gdim = domain.geometry.x, domain.geometry.dim
    top = np.isclose(x[:, gdim - 1], 0.0)
    # A roof
    x[top, gdim - 1] -= 0.4 * np.abs(x[top, 0] - 0.75)
    contact = scene.contact(friction=0.3)
    scene.problem(contact)
    discrete, nodes = contact.discrete, contact.discrete.nodes
    discrete.begin_step()
    scene.u.x.array[:] += 0.02 * np.random.default_rng(1).standard_normal(len(scene.u.x.array))
    discrete.halo.update_ghosts()
    discrete.search()
    discrete.update_gap()
    slip, gap = nodes.slip.copy(), nodes.gap.copy()
    assert (discrete.save()["master_feature"] != 0).sum() >= 2
    discrete.freeze(True)
    discrete.update_gap()
    assert np.abs(nodes.gap - gap).max() <= 1e-14
    assert np.abs(slip).max() > 1e-2
    assert np.abs(nodes.slip - slip).max() <= 1e-13


@pytest.mark.parametrize(("width", "block_size"), [(1, 1), (3, 6), (4, 1), (5, 3), (7, 2), (9, 3)])
def test_widths_of_borrowed_spaces(width, block_size):
    comm = MPI.COMM_WORLD
    dofs = np.arange(4 * width, dtype=np.int32).reshape(4, width)
    mesh = contact_mesh.carrier(comm, 4)
    index_map = cpp.common.IndexMap(comm, 4 * width)
    V = contact_mesh.borrow(mesh, index_map, dofs, block_size)
    assert np.array_equal(V.dofmap.map(), dofs)
    assert V.element.space_dimension == width * block_size
    assert V.dofmap.index_map_bs == block_size


def test_a_carrier_without_pairs():
    mesh = contact_mesh.carrier(MPI.COMM_WORLD, 0)
    assert mesh.topology.index_map(3).size_local == 0


def test_a_dofmap_that_disagrees_is_refused(monkeypatch):
    """A DOLFINx whose dofmap ignored its width would compute wrong numbers."""
    dofs = np.zeros((2, 5), dtype=np.int32)
    mesh = contact_mesh.carrier(MPI.COMM_WORLD, 2)
    element = contact_mesh._element(3, 1)
    monkeypatch.setattr(contact_mesh, "_element", lambda width, block_size: element)
    with pytest.raises(RuntimeError, match="came out with widths"):
        contact_mesh.borrow(mesh, cpp.common.IndexMap(MPI.COMM_WORLD, 5), dofs, 1)


def test_bodies_are_let_go():
    """A mesh that stayed would keep nine communicators, of which MPI has 2,000."""
    for material in (elasticity, neo_hookean):
        domain = mesh.create_unit_square(MPI.COMM_SELF, 2, 2)
        u = displacement(domain)
        forces = CellForces(material(u, 1.0, 0.3), u, None, {})
        assert forces._compiled()
        alive = weakref.ref(u)
        del forces, u, domain
        gc.collect()
        assert alive() is None
