# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hexahedra of the face slabs: they bend as a beam does, and no deformation is free of energy."""

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest
from hexahedra import NodalStress, elasticity, stress

import ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import assemble_matrix

from story import displacement
from story import elasticity as plain

E, NU = 30_000.0, 0.2
LENGTH, HEIGHT = 16.0, 0.5


def _box(size, n):
    corners = [np.zeros(3), np.asarray(size)]
    return mesh.create_box(MPI.COMM_WORLD, corners, n, mesh.CellType.hexahedron)


def _matrix(form, u, bcs=()):
    A = assemble_matrix(fem.form(ufl.derivative(form, u)), bcs=list(bcs))
    A.assemble()
    return A


def _tip(bulk, axes):
    """Deflection of a cantilever in plane strain under its weight over that of a beam."""
    size, n = np.empty(3), np.empty(3, dtype=int)
    size[axes], n[axes] = (LENGTH, 1.0, HEIGHT), (16, 1, 5)
    u = displacement(_box(size, n.tolist()))
    V = u.function_space
    weight = 1e-3
    form = bulk(u, E, NU)
    load = fem.form(weight * ufl.TestFunction(V)[axes[2]] * ufl.dx)
    held = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[axes[0]], 0))
    across = 3 * np.arange(len(u.x.array) // 3, dtype=np.int32) + axes[1]
    zero = fem.Constant(V.mesh, 0.0)
    bcs = [
        fem.dirichletbc(np.zeros(3), held, V),
        fem.dirichletbc(zero, across, V.sub(axes[1])),
    ]
    A = _matrix(form, u, bcs)
    b = fem.assemble_vector(load)
    for bc in bcs:
        bc.set(b.array)
    solver = PETSc.KSP().create(A.comm)
    solver.setOperators(A)
    solver.setType("preonly")
    solver.getPC().setType("cholesky")
    solver.solve(PETSc.Vec().createWithArray(b.array), PETSc.Vec().createWithArray(u.x.array))
    end = np.isclose(V.tabulate_dof_coordinates()[:, axes[0]], LENGTH)
    deflection = u.x.array.reshape(-1, 3)[end, axes[2]].mean()
    q, inertia, G = weight * HEIGHT, HEIGHT**3 / 12, E / (2 * (1 + NU))
    bending = q * LENGTH**4 / (8 * E / (1 - NU**2) * inertia)
    return deflection / (bending + q * LENGTH**2 / (2 * 5 / 6 * G * HEIGHT))


@pytest.mark.parametrize("axes", [[0, 1, 2], [2, 0, 1], [1, 0, 2]])
def test_cantilever(axes):
    """Cells ten times as long as high: the plain ones are far too stiff, these are not."""
    assert _tip(elasticity, axes) == pytest.approx(1, abs=0.01)
    assert _tip(plain, axes) < 0.4


@pytest.mark.parametrize("n", [1, 2])
def test_only_rigid_motions_are_free(n):
    """Of warped cells, with six eigenvalues of rounding and none that is small beside the plain."""
    domain = _box(np.ones(3), [n, n, n])
    domain.geometry.x[:] += 0.1 / n * np.random.default_rng(0).random(domain.geometry.x.shape)
    u = displacement(domain)
    values = []
    for bulk in (elasticity, plain):
        A = _matrix(bulk(u, 1.0, NU), u)
        rows = range(A.size[0])
        values.append(np.linalg.eigvalsh(A.getValues(rows, rows)))
    cured, full = values
    assert np.abs(cured[:6]).max() < 1e-14
    assert np.all(cured[6:] > 0.5 * full[6:])


def test_nodal_stress_of_bodies_apart():
    """Extrapolation is exact for a stress that is linear, on either side of an interface."""
    domain = _box((2.0, 1.0, 1.0), [4, 2, 2])
    u = displacement(domain)
    # u_x = x^2 at the nodes: the strain of each cell is constant, its average linear inside
    u.interpolate(lambda x: np.array([x[0] ** 2, 0 * x[0], 0 * x[0]]))
    nodal = NodalStress(stress(u, 1.0, 0.0)[0, 0], domain, "stress")
    values, x = nodal.update(), nodal.values.function_space.tabulate_dof_coordinates()[:, 0]
    inner = (x > 0.1) & (x < 1.9)
    assert np.allclose(values[inner], 2 * x[inner])
    assert np.allclose(values[x < 0.1], 0.5) and np.allclose(values[x > 1.9], 3.5)
    # A twisted field, linear along two directions in each cell
    u.interpolate(lambda x: np.array([x[0] * x[1], 0 * x[0], 0 * x[0]]))
    y = nodal.values.function_space.tabulate_dof_coordinates()[:, 1]
    assert np.allclose(nodal.update(), y)
