# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forms with terms of different quadrature, as those who cure locking write them."""

import numpy as np
import pytest

import ufl
from contactx._host.blocks import by_rule
from contactx._host.bulk import Bulk
from contactx._host.unknowns import Unknowns
from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from scenes.materials import neo_hookean
from story import elasticity

MU, LAME = 0.4, 200.0


def bulk_of(F, u, bcs):
    return Bulk([F], None, Unknowns([u], 0, is_mixed=False), bcs)


def terms(u, kind):
    """Shear of full, volume change of reduced integration; a load on the facets of both."""
    v = ufl.TestFunction(u.function_space)
    x = ufl.SpatialCoordinate(u.function_space.mesh)
    if kind == "linear":
        shear, volume = 2 * MU * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)), ufl.div(u)
        volume *= LAME * ufl.div(v)
    else:
        F = ufl.variable(ufl.Identity(len(u)) + ufl.grad(u))
        P = ufl.diff(MU / 2 * ufl.tr(F.T * F) - MU * ufl.ln(ufl.det(F)), F)
        Q = ufl.diff(LAME / 2 * (ufl.det(F) - 1) ** 2, F)
        shear, volume = ufl.inner(P, ufl.grad(v)), ufl.inner(Q, ufl.grad(v))
    spring = ufl.inner(u, u) * ufl.inner(u, v)
    return [
        shear * ufl.dx(degree=3),
        volume * ufl.dx(degree=0),
        ufl.cos(x[0]) * v[0] * ufl.dx,
        spring * ufl.ds(degree=4),
        spring * ufl.ds(degree=0),
    ]


@pytest.mark.parametrize("kind", ["linear", "not linear"])
@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.hexahedron])
def test_terms_of_different_quadrature(cell, kind):
    """Residual, Jacobian and lifted values are the sums of those of each term alone."""
    scene = Blocks(cell)
    u = scene.u
    u.x.array[:] = 0.05 * np.random.default_rng(1).standard_normal(len(u.x.array))
    parts = terms(u, kind)
    whole = bulk_of(sum(parts[1:], parts[0]), u, scene.bcs)
    alone = [bulk_of(part, u, scene.bcs) for part in parts if depends(part, u)]
    load = fem.assemble_vector(fem.form(parts[2])).array
    assert len(whole.blocks.F[0]) == 3
    assert len(whole.blocks.J[0][0]) == 2
    expected = sum(bulk.residual() for bulk in alone) + load
    assert np.abs(whole.residual() - expected).max() <= 1e-13 * np.abs(expected).max()
    expected = sum(bulk.lifted() for bulk in alone)
    assert np.abs(whole.lifted() - expected).max() <= 1e-13 * np.abs(expected).max()
    K = whole.stiffness()
    sums = alone[0].stiffness().copy()
    for bulk in alone[1:]:
        sums.axpy(1.0, bulk.stiffness())
    prescribed = np.flatnonzero(whole.markers)
    diagonal = K.getDiagonal().array
    assert (diagonal[prescribed] == 1).all()
    difference = K.copy()
    difference.axpy(-1.0, sums)
    difference.zeroRowsColumns(prescribed.astype(np.int32), diag=0.0)
    assert difference.norm() <= 1e-13 * K.norm()
    assert whole.is_linear is False


def depends(form, u):
    return u in ufl.algorithms.extract_coefficients(form)


def test_a_load_that_changes_does_not_hide_a_constant_of_one_part():
    scene = Blocks(CellType.quadrilateral)
    u = scene.u
    factor = fem.Constant(u.function_space.mesh, 1.0)
    v = ufl.TestFunction(u.function_space)
    F = elasticity(u, 1.0, 0.3) + factor * ufl.div(u) * ufl.div(v) * ufl.dx(degree=0)
    bulk = bulk_of(F, u, scene.bcs)
    assert bulk.is_linear
    first = bulk.stiffness().norm()
    factor.value = 2.0
    assert bulk.stiffness().norm() > 1.1 * first
    bulk.update()
    assert bulk.skipped == 1


def test_one_form_where_one_will_do():
    """Rules of different subdomains and kinds of integrals need no forms of their own."""
    scene = Blocks(CellType.quadrilateral)
    u = scene.u
    v = ufl.TestFunction(u.function_space)
    ds = ufl.Measure("ds", u.function_space.mesh, subdomain_data=scene.tags)
    F = neo_hookean(u, 1.0, 0.3, degree=3) + v[0] * ds(int(Tag.UPPER_TOP), degree=2)
    F += v[1] * ds(int(Tag.UPPER_X0)) + v[0] * ufl.dx(degree=3)
    assert len(by_rule(F)) == 1
    pair = v[0] * ds((1, 2), degree=0) + v[1] * ds((2, 3), degree=1) + v[1] * ds(3, degree=0)
    assert [len(part.integrals()) for part in by_rule(pair)] == [3, 2]


@pytest.mark.usefixtures("method")
def test_selective_reduced_integration_in_contact():
    """Blocks that hardly change their volume are as soft as twice finer ones, and do not lock."""
    forces = {}
    for degree in (0, 3):
        scene = Blocks(CellType.quadrilateral, n_upper=4, n_lower=6)
        u, v = scene.u, ufl.TestFunction(scene.u.function_space)
        shear = 2 * MU * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)) * ufl.dx(degree=3)
        scene.F = shear + LAME * ufl.div(u) * ufl.div(v) * ufl.dx(degree=degree)
        contact = scene.contact()
        problem = scene.problem(contact)
        problem.solve()
        assert problem.report.iterations <= 6
        forces[degree] = contact.force[1]
    assert 0 < forces[0] < 0.7 * forces[3]
