# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
import numpy as np
import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks


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
