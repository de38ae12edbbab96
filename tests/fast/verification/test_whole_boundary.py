# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave tags that go around bodies: tractions act in front of the master, up to the edges."""

from dataclasses import replace

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import default_scalar_type, fem, mesh

from meshes import FACE_SLABS
from scenes.grids import outside, tagged
from scenes.problems import make_problem
from slab_scene import Setting
from slab_schemes import scheme_1
from story import displacement, elasticity

CELLS = [
    mesh.CellType.triangle,
    mesh.CellType.quadrilateral,
    mesh.CellType.tetrahedron,
    mesh.CellType.hexahedron,
]


class PressedBlock:
    """A unit block on a plane under a uniform pressure 1, its whole boundary tagged.

    Poisson's ratio is zero: it stays a block.
    """

    def __init__(self, cell, angle=0.0, obstacle=cx.Plane, **options):
        gdim = 2 if cell in CELLS[:2] else 3
        n = [4] * gdim
        make = mesh.create_unit_square if gdim == 2 else mesh.create_unit_cube
        domain = make(MPI.COMM_SELF, *n, cell)
        turn = np.eye(3)
        c, s = np.cos(angle), np.sin(angle)
        turn[np.ix_([0, gdim - 1], [0, gdim - 1])] = [[c, -s], [s, c]]
        domain.geometry.x[:] = domain.geometry.x @ turn.T
        self.up = turn[:gdim, gdim - 1]
        self.u = u = displacement(domain)
        V, x = u.function_space, ufl.SpatialCoordinate(domain)
        tags = tagged(domain, outside(domain))
        height = sum(float(a) * x[i] for i, a in enumerate(self.up))
        on_top = ufl.conditional(ufl.gt(height, 1 - 1e-9), 1.0, 0.0)
        load = fem.Constant(domain, default_scalar_type(-self.up))
        v = ufl.TestFunction(V)
        F = elasticity(u, 10.0, 0.0) - on_top * ufl.inner(load, v) * ufl.ds
        # Weak springs keep it from sliding along the plane and do nothing else
        slide = ufl.Identity(gdim) - ufl.outer(ufl.as_vector(self.up), ufl.as_vector(self.up))
        F += 1e-6 * ufl.inner(slide * u, v) * ufl.dx
        self.contact = cx.Contact(cx.Surface(tags, 1), obstacle(np.zeros(gdim), self.up), **options)
        self.problem = make_problem(F, u, [self.contact])


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_the_pressure_is_uniform_up_to_the_edges(cell, method, sliding):
    """It was a half of that at edges, a third at corners: the area of the sides counted as well."""
    block = PressedBlock(cell, method=method, sliding=sliding)
    block.problem.solve()
    contact = block.contact
    closed = contact.discrete.nodes.closed
    assert closed.sum() == 5 ** (len(block.u) - 1)
    assert contact.multiplier[closed] == pytest.approx(1)
    assert contact.pressure.x.array[contact.slave_nodes[closed]] == pytest.approx(1)
    assert contact.area[closed].sum() == pytest.approx(1)
    assert contact.force @ block.up == pytest.approx(1)


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
def test_integrated_over_facets_it_is_the_same(cell):
    def level(point, up):
        return cx.LevelSet(lambda x: ufl.inner(x, ufl.as_vector(up.tolist())))

    block = PressedBlock(cell, 0.3, level, method="surface-to-surface")
    block.problem.solve()
    closed = block.contact.discrete.nodes.closed
    assert closed.sum() == 5 ** (len(block.u) - 1)
    assert block.contact.multiplier[closed] == pytest.approx(1)


def test_friction_and_a_tilted_plane():
    block = PressedBlock(mesh.CellType.quadrilateral, angle=0.7, friction=0.5)
    block.problem.solve()
    closed = block.contact.discrete.nodes.closed
    pressure = block.contact.multiplier @ block.up
    assert pressure[closed] == pytest.approx(1)


def test_a_round_body_that_rolls_keeps_forces():
    """The facets in front change from step to step; each step starts in equilibrium."""
    domain = mesh.create_rectangle(
        MPI.COMM_SELF, [[-1, 0], [1, 2]], [6, 6], mesh.CellType.quadrilateral
    )
    # A square made round: corners are at 45 degrees
    p = domain.geometry.x[:, :2] - [0, 1]
    size = np.abs(p).max(axis=1)
    length = np.linalg.norm(p, axis=1)
    p *= np.divide(size, length, out=np.ones_like(size), where=length > 0)[:, None]
    domain.geometry.x[:, :2] = p + np.array([0, 1])
    u = displacement(domain)
    V = u.function_space
    tags = tagged(domain, outside(domain))
    core = fem.locate_dofs_geometrical(V, lambda x: x[0] ** 2 + (x[1] - 1) ** 2 < 0.12)
    turned = fem.Function(V)
    bc = fem.dirichletbc(turned, core)
    contact = cx.Contact(cx.Surface(tags, 1), cx.Plane((0, 0), (0, 1)), friction=0.3)
    problem = make_problem(elasticity(u, 1.0, 0.3), u, [contact], [bc])
    for angle in np.linspace(0, -0.3, 4):
        c, s = np.cos(angle) - 1, np.sin(angle)
        turned.interpolate(
            lambda x, c=c, s=s, angle=angle: np.stack(
                [c * x[0] - s * (x[1] - 1) - angle, s * x[0] + c * (x[1] - 1) - 0.05]
            )
        )
        problem.solve()
        force = contact.force.copy()
        problem.solve()
        assert problem.report.iterations <= 1
        assert contact.force == pytest.approx(force, rel=1e-9)
        forces = contact.area[:, None] * contact.multiplier
        assert forces.sum(axis=0) == pytest.approx(force, rel=1e-9)


# Of the slabs beside it on 40 layers, MPa
STRESS = 18.15


@pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
def test_pressure_at_the_edge_of_a_joint(method):
    """Three rows of nodes are closed, and averages of them are a third too low."""
    setting = Setting(replace(FACE_SLABS["slice"], layers=10), method=method)
    scene = scheme_1(setting, 0.0909, 0.3, steps=1, progress=False)
    joint = scene.joints[0]
    raw, area = joint.discrete.nodes.pressure, joint.discrete.nodes.area
    p = joint.pressure.x.array[joint.slave_nodes]
    assert np.sum(joint.discrete.nodes.closed) == 2 * 3
    assert p.max() == pytest.approx(STRESS, rel=0.05)
    assert p.max() > raw.max()
    assert area @ p == pytest.approx(area @ raw, rel=1e-12)
    assert np.all(p[joint.discrete.nodes.closed] > 0)
