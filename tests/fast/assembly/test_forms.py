# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact forms and the whole Jacobian against dense assembly by hand and central differences."""

from petsc4py import PETSc

import numpy as np
import pytest

from contactx import cpp as core
from dolfinx import cpp, fem

from meshes import Tag
from scenes import CELLS, Blocks


class ByHand:
    """Gaps, normals and weights of all slave nodes from the plane reference facets."""

    def __init__(self, scene, contact):
        V = scene.u.function_space
        X = V.tabulate_dof_coordinates()
        gdim = V.mesh.geometry.dim
        slaves = contact.slave_nodes
        facets = master_facets(scene, X)
        self.n = len(slaves)
        self.normal = np.zeros(gdim)
        self.normal[-1] = 1
        # B maps all displacements to the slave nodes' relative displacements
        self.B = np.zeros((self.n * gdim, X.shape[0] * gdim))
        for k, slave in enumerate(slaves):
            nodes, weights = find(facets, X, X[slave])
            for i in range(gdim):
                self.B[k * gdim + i, slave * gdim + i] += 1
                self.B[k * gdim + i, nodes * gdim + i] -= weights
        rows = np.arange(self.n) * gdim + gdim - 1
        self.D = self.B[rows]
        self.gap = self.D @ X[:, :gdim].ravel()


def master_facets(scene, X):
    """Nodes of the lower block's contact facets, from the mesh alone."""
    mesh = scene.u.function_space.mesh
    fdim = mesh.topology.dim - 1
    entities = scene.tags.find(Tag.LOWER_CONTACT)
    mesh.topology.create_connectivity(fdim, mesh.topology.dim)
    geometry = cpp.mesh.entities_to_geometry(mesh._cpp_object, fdim, entities, False)
    x = mesh.geometry.x
    return [
        np.array([np.argmin(np.linalg.norm(X - x[g], axis=1)) for g in facet]) for facet in geometry
    ]


def find(facets, X, p):
    """Facet below a point and its shape functions there; every facet is plane and axis-aligned."""
    for nodes in facets:
        x = X[nodes]
        if len(nodes) == 2:
            s = (p[0] - x[0, 0]) / (x[1, 0] - x[0, 0])
            weights = np.array([1 - s, s])
        elif len(nodes) == 3:
            A = np.vstack([x[:, :2].T, np.ones(3)])
            weights = np.linalg.solve(A, [p[0], p[1], 1])
        else:
            lower, upper = x[:, :2].min(axis=0), x[:, :2].max(axis=0)
            at = np.where(np.isclose(x[:, :2], upper), 1, 0)
            s = (p[:2] - lower) / (upper - lower)
            weights = np.prod(np.where(at, s, 1 - s), axis=1)
        if weights.min() > -1e-12:
            return nodes, weights
    raise AssertionError(f"no facet below {p}")


def assembled(form, shape):
    A = cpp.fem.petsc.create_matrix(form._cpp_object, None)
    none = np.array([], dtype=np.int8)
    cpp.fem.petsc.assemble_matrix(
        A, form._cpp_object, fem.pack_constants(form), fem.pack_coefficients(form), none, none
    )
    A.assemble()
    dense = A.convert("dense").getDenseArray()
    assert dense.shape == shape
    return dense


@pytest.fixture(params=CELLS, ids=lambda c: c.name)
def case(request):
    scene = Blocks(request.param, gap=0.1)
    contact = scene.contact("small")
    scene.problem(contact)
    rng = np.random.default_rng(5)
    scene.u.x.array[:] = 0.1 * rng.standard_normal(len(scene.u.x.array))
    contact.multiplier[:] = rng.standard_normal(len(contact.multiplier))
    contact.discrete.nodes.by_gap[:] = rng.standard_normal(len(contact.multiplier))
    return scene, contact, ByHand(scene, contact)


def close(computed, reference):
    return np.abs(computed - reference).max() <= 1e-13 * max(1, np.abs(reference).max())


def test_gap(case):
    scene, contact, hand = case
    contact.discrete.update_gap()
    assert close(contact.discrete.nodes.gap, hand.gap + hand.D @ scene.u.x.array)


def test_residual(case):
    scene, contact, hand = case
    b = np.zeros(len(scene.u.x.array))
    contact.discrete.add_residual(b)
    assert close(b, -hand.D.T @ (contact.area * contact.multiplier))


def test_traction_block(case):
    scene, contact, hand = case
    n = len(scene.u.x.array)
    block = sum(assembled(form, (n, hand.n)) for form in contact.forms().B)
    assert close(block, -hand.D.T * contact.area)


def test_constraint_block(case):
    scene, contact, hand = case
    n = len(scene.u.x.array)
    block = sum(assembled(form, (hand.n, n)) for form in contact.forms().C)
    factor = contact.discrete.nodes.by_gap
    assert close(block, factor[:, None] * hand.D)


def test_small_sliding_has_no_stiffness(case):
    _, contact, _ = case
    assert contact.forms().K == []


def test_petsc_is_real_double():
    assert np.dtype(PETSc.ScalarType) == np.float64


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
def test_forms_are_the_blocks_of_the_core(cell, friction):
    """What DOLFINx assembles from the forms is what the core assembles from the same pairs."""
    scene = Blocks(cell, gap=0.02)
    contact = scene.contact(friction=friction)
    scene.problem(contact)
    discrete, rng = contact.discrete, np.random.default_rng(7)
    nodes, n = discrete.nodes, len(scene.u.x.array)
    scene.u.x.array[:] = 0.01 * rng.standard_normal(n)
    discrete.search()
    discrete.update_gap()
    nodes.multiplier[:] = rng.uniform(0.5, 1, len(nodes.multiplier))
    nodes.c[:] = rng.uniform(1, 2, len(nodes.c))
    nodes.status[:] = np.arange(len(nodes.status)) % 3
    discrete.law.evaluate(nodes)
    m = len(nodes.multiplier)
    forms, dense = contact.forms(), np.zeros((n + m, n + m))
    u, w = slice(n), slice(n, n + m)
    for part, row, column in (("K", u, u), ("B", u, w), ("C", w, u), ("D", w, w)):
        block = dense[row, column]
        for form in getattr(forms, part):
            block += assembled(form, block.shape)
        assert np.abs(block).max() > 0
    block = core.ContactBlock([discrete])
    found = np.stack([block.multiply(unit) for unit in np.eye(n + m)], axis=1)
    assert close(found, dense)
    b, forces = np.zeros(n), np.zeros(n)
    discrete.add_residual(b)
    for form in forms.F_u:
        fem.assemble_vector(forces, form)
    assert close(forces, b)
    values = np.zeros(m)
    for form in forms.F_lambda:
        fem.assemble_vector(values, form)
    assert close(values, nodes.value)
