# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faces of a crack, which share the nodes of its tip."""

import numpy as np
import pytest

import ufl
from dolfinx import fem

from scenes.cracked import BOTTOM, TOP, Cracked
from story import elasticity


def uncracked(gdim):
    """The same block without the crack, solved without contact."""
    body = Cracked(gdim, crack=False)
    u = body.u
    V = u.function_space
    F = elasticity(u, 1.0, 0.3)
    J = ufl.derivative(F, u)
    moved = np.zeros(gdim)
    moved[-1] = -0.01
    bcs = []
    for tag, value in ((BOTTOM, np.zeros(gdim)), (TOP, moved)):
        dofs = fem.locate_dofs_topological(V, gdim - 1, body.tags.find(tag))
        bcs.append(fem.dirichletbc(value, dofs, V))
    b = fem.assemble_vector(fem.form(-F))
    K = fem.assemble_matrix(fem.form(J), bcs).to_dense()
    fem.apply_lifting(b.array, [fem.form(J)], [bcs])
    for bc in bcs:
        bc.set(b.array)
    u.x.array[:] = np.linalg.solve(K, b.array)
    return {tuple(row[:gdim]): row[gdim:] for row in body.at_nodes()}


OPTIONS = [
    {},
    {"friction": 0.3},
    {"tied": True},
    {"sliding": "small"},
]


@pytest.mark.usefixtures("method")
@pytest.mark.parametrize("gdim", [2, 3])
def test_a_crack_under_compression_is_as_if_it_were_not(gdim):
    expected = uncracked(gdim)
    for options in OPTIONS:
        body = Cracked(gdim)
        contact = body.contact(**options)
        problem = body.problem([contact])
        problem.solve()
        rows = body.at_nodes()
        off = [np.abs(row[gdim:] - expected[tuple(row[:gdim])]).max() for row in rows]
        assert max(off) <= 1e-12, options
        # The tip is never closed: it has no gap
        tip = np.isclose(np.abs(rows_of(contact)[:, :-1] - 0.5).max(axis=1), 0.25)
        status = contact.discrete.nodes.status
        assert (status[tip] == 0).all()
        assert (status[~tip] > 0).all()
        assert np.isnan(contact.discrete.nodes.gap[tip]).all()


def rows_of(contact):
    """Positions of the slave nodes, shape (n, gdim)."""
    return contact.discrete.halo.x[contact.slave_nodes]


@pytest.mark.usefixtures("method")
def test_both_solvers():
    forces = []
    for pc in ("lu", "condensed"):
        body = Cracked(2)
        contact = body.contact()
        body.problem([contact], petsc_options={"pc_type": pc}).solve()
        forces.append(contact.force)
    assert forces[1] == pytest.approx(forces[0], rel=1e-9, abs=1e-12)
    assert forces[0][1] > 0
