# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What ContactProblem refuses, with messages that say what to do."""

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest
from scenes import Blocks
from story import elasticity

import basix.ufl
import contactx as cx
from dolfinx import fem, mesh
from dolfinx.mesh import CellType


@pytest.fixture
def scene():
    return Blocks(CellType.tetrahedron)


def refused(scene, element, error=ValueError):
    V = fem.functionspace(scene.u.function_space.mesh, element)
    scene.u = fem.Function(V)
    with pytest.raises(error) as info:
        scene.problem(scene.contact())
    assert 'functionspace(mesh, ("Lagrange", 1, (3,)))' in str(info.value)
    return str(info.value)


def test_scalar_space(scene):
    assert "u has values of shape ()" in refused(scene, ("Lagrange", 1))


def test_wrong_size(scene):
    assert "u has values of shape (2,)" in refused(scene, ("Lagrange", 1, (2,)))


def test_degree_above_one(scene):
    assert "u is of degree 2" in refused(scene, ("Lagrange", 2, (3,)))


def test_discontinuous_space(scene):
    assert "not in a continuous Lagrange space" in refused(scene, ("DG", 1, (3,)))


def test_mixed_space(scene):
    cell = scene.u.function_space.mesh.basix_cell()
    vector = basix.ufl.element("Lagrange", cell, 1, shape=(3,))
    scalar = basix.ufl.element("Lagrange", cell, 1)
    assert "u is in a mixed space" in refused(scene, basix.ufl.mixed_element([vector, scalar]))


def test_part_of_a_mixed_space(scene):
    domain = scene.u.function_space.mesh
    vector = basix.ufl.element("Lagrange", domain.basix_cell(), 1, shape=(3,))
    scalar = basix.ufl.element("Lagrange", domain.basix_cell(), 1)
    W = fem.functionspace(domain, basix.ufl.mixed_element([vector, scalar]))
    scene.u = fem.Function(W).sub(0)
    with pytest.raises(ValueError, match="mixed space or a part of one"):
        scene.problem(scene.contact())


def test_no_function(scene):
    scene.u = np.zeros(3)
    with pytest.raises(TypeError, match=r"u must be a dolfinx.fem.Function, not ndarray"):
        scene.problem(scene.contact())


def test_single_precision_displacement(scene):
    domain = mesh.create_unit_cube(MPI.COMM_WORLD, 1, 1, 1, dtype=np.float32)
    V = fem.functionspace(domain, ("Lagrange", 1, (3,)))
    u = fem.Function(V, dtype=np.float32)
    with pytest.raises(TypeError, match="u holds float32 values, but contactx needs float64"):
        cx.ContactProblem(scene.F, u, contacts=[scene.contact()], petsc_options_prefix="f_")


@pytest.mark.parametrize("scalar", [np.complex128, np.float32])
def test_petsc_of_another_scalar(scene, monkeypatch, scalar):
    monkeypatch.setattr(PETSc, "ScalarType", scalar)
    name = np.dtype(scalar).name
    with pytest.raises(TypeError, match=f"PETSc was built with {name} scalars.*real double"):
        scene.problem(scene.contact())


def test_nan_in_coordinates(scene):
    contact = scene.contact()
    scene.u.function_space.mesh.geometry.x[3, 1] = np.nan
    with pytest.raises(ValueError, match=r"coordinates of the mesh are not finite at .* dofs"):
        scene.problem(contact)


def test_nan_in_displacement(scene):
    problem = scene.problem(scene.contact())
    scene.u.x.array[4] = np.nan
    with pytest.raises(ValueError, match=r"the displacement u is not finite at 1 dofs.*node 1:"):
        problem.solve()


@pytest.mark.parametrize("value", [-1e-8, "abc", float("nan"), None])
@pytest.mark.parametrize("name", ["snes_rtol", "snes_atol"])
def test_tolerances(scene, name, value):
    with pytest.raises(ValueError, match=f"{name}.*give a number of at least 0"):
        scene.problem(scene.contact(), petsc_options={name: value})


def test_empty_prefix(scene):
    with pytest.raises(ValueError, match="petsc_options_prefix is empty"):
        cx.ContactProblem(scene.F, scene.u, contacts=[scene.contact()], petsc_options_prefix="")


def test_no_contact(scene):
    with pytest.raises(ValueError, match="contacts is empty"):
        scene.problem()


def test_something_else_than_a_contact(scene):
    with pytest.raises(TypeError, match=r"contacts holds a Surface: pass a list of"):
        scene.problem(scene.contact().slave)


def test_contact_twice(scene):
    contact = scene.contact()
    with pytest.raises(ValueError, match="same Contact twice"):
        scene.problem(contact, contact)


def test_out_of_reach_warns_with_the_distance():
    scene = Blocks(CellType.tetrahedron, gap=5.0)
    problem = scene.problem(scene.contact())
    with pytest.warns(UserWarning, match=r"no slave node within reach.* 4\.95 away.* 2\.12"):
        problem.solve()
    assert problem.report.pairs == 0
    assert problem.report.iterations == 1


def test_elasticity_without_contact_force_is_plain_elasticity():
    """Bodies that stay apart: contact changes nothing."""
    scene = Blocks(CellType.tetrahedron, gap=0.2)
    contact = scene.contact()
    scene.problem(contact).solve()
    assert not contact.multiplier.any()
    assert not contact.force.any()
    assert np.nanmin(contact.gap.x.array) == pytest.approx(0.15)
    residual = fem.assemble_vector(fem.form(elasticity(scene.u, 1.0, 0.3))).array
    assert np.abs(residual).max() <= 1e-15
