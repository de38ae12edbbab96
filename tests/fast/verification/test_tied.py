# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tied surfaces of linear elastic bodies."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh

from scenes import CELLS, dimension
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.tower import Tower, lift, one_body

pytestmark = pytest.mark.usefixtures("method")

every_cell = pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
HEXAHEDRON = mesh.CellType.hexahedron
QUADRILATERAL = mesh.CellType.quadrilateral


def constant(value):
    """On a mesh of its own: the bodies' one is made later."""
    return fem.Constant(mesh.create_unit_interval(MPI.COMM_SELF, 1), value)


@covering(cell=CELLS, sliding=SLIDINGS, height=(0.1, -0.1), method=METHODS)
def test_uniaxial_tension_and_compression(cell, sliding, height):
    """Exact where the slave's nodes refine the master's: force E A d / L."""
    tower = Tower(cell, 4, 2, tied=True, sliding=sliding)
    gdim = tower.gdim
    tower.solve(*lift(gdim, height))
    contact = tower.contact
    assert contact.force == pytest.approx(lift(gdim, -height / 2), abs=1e-12)
    traction = np.tile(lift(gdim, -height / 2), (len(contact.area), 1))
    assert contact.multiplier.shape == (len(contact.area), gdim)
    assert np.abs(contact.multiplier - traction).max() <= 1e-11
    nodes = contact.discrete.nodes
    assert np.all(nodes.status == 1)
    assert np.abs(nodes.gap).max() <= 1e-13
    assert np.abs(tower.problem.report.imbalance).max() <= 1e-13
    assert tower.problem.report.iterations == 1
    on_slave = contact.status.x.array >= 0
    assert np.all(contact.status.x.array[on_slave] == 1)
    assert contact.pressure.x.array[on_slave] == pytest.approx(-height / 2, abs=1e-11)


@covering(
    cell=CELLS, **{"n,tolerance": [((2, 3), 0.035), ((3, 2), 5e-3), ((4, 3), 2e-3)]}, method=METHODS
)
def test_uniaxial_tension_where_no_nodes_meet(cell, n, tolerance):
    """Nodal forces are not those of a uniform traction; better where the slave is the finer."""
    tower = Tower(cell, *n, tied=True)
    tower.solve(*lift(tower.gdim, 0.1))
    print(f"{cell.name} {n}: {tower.contact.force[-1] / -0.05 - 1:+.1e}")
    assert tower.contact.force[-1] == pytest.approx(-0.05, rel=tolerance)


@covering(cell=CELLS, sliding=SLIDINGS, method=METHODS)
def test_matching_boxes_are_one_body(cell, sliding):
    tower = Tower(cell, 3, 3, tied=True, nu=0.3, sliding=sliding)
    top = lift(tower.gdim, 0.07, 0.05)
    tower.solve(*top)
    force = one_body(tower, top, 0.3)
    assert np.linalg.norm(force) > 0.01
    assert tower.contact.force == pytest.approx(-force, abs=1e-13)


@covering(cell=CELLS, n=[(4, 6), (6, 4), (3, 4)], method=METHODS)
def test_boxes_that_do_not_match_are_nearly_one_body(cell, n):
    tower = Tower(cell, *n, tied=True, nu=0.3)
    top = lift(tower.gdim, 0.07, 0.05)
    tower.solve(*top)
    force = -one_body(Tower(cell, 5, 5, nu=0.3), top, 0.3)
    error = np.linalg.norm(tower.contact.force - force) / np.linalg.norm(force)
    print(f"{cell.name} {n}: {error:.1e}")
    assert error <= 0.02


@covering(cell=CELLS, sliding=SLIDINGS, method=METHODS)
def test_much_friction_under_pressure_is_a_tie(cell, sliding, method):
    tied = Tower(cell, 4, 3, tied=True, nu=0.3, sliding=sliding)
    rough = Tower(cell, 4, 3, friction=1e6, nu=0.3, sliding=sliding)
    for tower in (tied, rough):
        tower.solve(*lift(tower.gdim, -0.1, 0.01))
    assert np.all(rough.contact.discrete.nodes.status == 1)
    size = np.abs(tied.contact.multiplier).max()
    difference = np.abs(rough.contact.multiplier - tied.contact.multiplier).max()
    print(f"{difference / size:.1e}")
    # Means over facets follow the deformation in finite sliding, a tie keeps those of the reference
    follows = (method, sliding) == ("surface-to-surface", "finite")
    least = 1e-4 if follows else 1e-6
    assert difference <= least * size
    assert np.abs(rough.u.x.array - tied.u.x.array).max() <= least * 0.1


@covering(cell=(QUADRILATERAL, HEXAHEDRON), rigid=(False, True), **{"sliding,method": BOTH})
def test_offset_makes_a_tie_longer(cell, sliding, rigid):
    """Between ends that stand still: pressure E offset / L, and tension where it is negative."""
    gdim = 2 if cell == QUADRILATERAL else 3
    plane = cx.Plane(np.zeros(gdim), lift(gdim, 1)) if rigid else None
    offset = constant(0.0)
    tower = Tower(cell, 4, 2, master=plane, tied=True, sliding=sliding, offset=offset)
    length = 1 if rigid else 2
    for value in (0.0, 0.02, 0.05, -0.03, -0.03, 0.0):
        offset.value = value
        tower.problem.solve()
        assert tower.contact.force == pytest.approx(lift(gdim, value / length), abs=1e-12)
        assert np.abs(tower.contact.discrete.nodes.gap).max() <= 1e-13
        assert tower.problem.report.iterations <= 1


@covering(cell=CELLS, sliding=SLIDINGS, method=METHODS)
def test_ties_to_a_plane_follow_it(cell, sliding):
    """A body that nothing else holds moves with the plane; linear, so in one iteration."""
    gdim = dimension(cell)
    point = constant(np.zeros(gdim))
    plane = cx.Plane(point, lift(gdim, 1))
    tower = Tower(cell, 2, 2, master=plane, tied=True, sliding=sliding, nu=0.3, free_top=True)
    for k in (1, 2, 3):
        point.value[:] = k * np.linspace(0.3, -0.2, gdim)
        tower.problem.solve()
        u = tower.u.x.array.reshape(-1, gdim)[tower.upper]
        assert np.abs(u - point.value).max() <= 1e-12
        assert np.abs(tower.contact.multiplier).max() <= 1e-12
        assert tower.problem.report.iterations == 1


@every_cell
def test_slave_nodes_beyond_the_outer_edge_are_not_tied(cell, method):
    tower = Tower(cell, 4, 3, tied=True, nu=0.3, shift=0.4)
    gdim = tower.gdim
    tower.solve(*lift(gdim, 0.1))
    contact, nodes = tower.contact, tower.contact.discrete.nodes
    x = tower.X[contact.slave_nodes]
    # By surface-to-surface one whose facets reach over the edge, 0.25 wide, may be tied
    beyond = (x[:, :-1] > 1.0 + 0.1).any(axis=1)
    if method == "surface-to-surface":
        assert np.all(nodes.status[~beyond] == 1)
        assert np.all(nodes.status[(x[:, :-1] > 1.0 + 0.3).any(axis=1)] == 0)
        beyond = nodes.status == 0
    assert 0 < beyond.sum() < len(beyond)
    assert np.all(np.isnan(nodes.gap[beyond]))
    assert np.array_equal(nodes.status, np.where(beyond, 0, 1))
    assert not contact.multiplier[beyond].any()
    assert contact.force[-1] < -1e-3
    assert np.abs(tower.problem.report.imbalance).max() <= 1e-13
