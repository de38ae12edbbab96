# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Expressions and quadrature functions as Lagrange functions, in files and by themselves."""

from mpi4py import MPI

import numpy as np
import pytest
import pyvista

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType, create_unit_square, locate_entities, meshtags

DISCONTINUOUS = "Discontinuous Lagrange"


def domain_of(cell=CellType.triangle):
    return create_unit_square(MPI.COMM_WORLD, 5, 4, cell)


def quadrature(domain, shape=(), degree=2):
    element = basix.ufl.quadrature_element(domain.basix_cell(), value_shape=shape, degree=degree)
    return fem.Function(fem.functionspace(domain, element), name="history")


@pytest.mark.parametrize("cell", [CellType.triangle, CellType.quadrilateral])
@pytest.mark.parametrize("family", ["Lagrange", DISCONTINUOUS])
@pytest.mark.parametrize("degree", [1, 2])
def test_what_a_space_has_is_exact(cell, family, degree):
    domain = domain_of(cell)
    x = ufl.SpatialCoordinate(domain)
    V = fem.functionspace(domain, (family, degree, (2, 2)))
    found = cx.Projection(ufl.outer(x, ufl.as_vector((1, 2))), V, name="A").function
    exact = fem.Function(V)
    exact.interpolate(lambda x: np.stack([x[0], 2 * x[0], x[1], 2 * x[1]]))
    assert found.name == "A"
    assert np.allclose(found.x.array, exact.x.array, rtol=0, atol=1e-10)


def test_means_of_cells_and_later_values():
    """Of quadrature points by their own rule, whatever degree UFL estimates."""
    domain = domain_of()
    old = quadrature(domain)
    rng = np.random.default_rng(1)
    old.x.array[:] = rng.random(len(old.x.array))
    P0 = fem.functionspace(domain, (DISCONTINUOUS, 0))
    squared = cx.Projection(old**2, P0)
    # Three points of the same weight in each triangle
    means = (old.x.array.reshape(-1, 3) ** 2).mean(axis=1)
    assert np.allclose(squared.function.x.array, means, rtol=1e-12)
    old.x.array[:] *= 2
    assert squared.update() is squared.function
    assert np.allclose(squared.function.x.array, 4 * means, rtol=1e-12)


def test_a_part_of_the_cells():
    domain = domain_of()
    cells = locate_entities(domain, 2, lambda x: x[0] <= 0.4 + 1e-12)
    tags = meshtags(domain, 2, cells, np.full(len(cells), 7, dtype=np.int32))
    P0 = fem.functionspace(domain, (DISCONTINUOUS, 0))
    dx = ufl.Measure("dx", domain, subdomain_data=tags)
    found = cx.Projection(fem.Constant(domain, 3.0), P0, dx=dx(7)).function
    assert set(found.x.array.round(12)) == {0, 3}
    assert np.count_nonzero(found.x.array) == len(cells)


@pytest.mark.parametrize("degree", [1, 2])
def test_fields_of_files_are_those_of_each_write(tmp_path, degree):
    """Uniaxial strain: von Mises' stress is 2 mu times the strain, in plane strain."""
    domain = domain_of()
    V = fem.functionspace(domain, ("Lagrange", degree, (2,)))
    u = fem.Function(V, name="u")
    e = ufl.sym(ufl.grad(u))
    e = ufl.as_tensor([[e[0, 0], e[0, 1], 0], [e[1, 0], e[1, 1], 0], [0, 0, 0]])
    s = 2 * 80.0 * ufl.dev(e)
    mises = ufl.sqrt(1.5 * ufl.inner(s, s))
    history = quadrature(domain, (3, 3))
    P0 = fem.functionspace(domain, (DISCONTINUOUS, 0))
    fields = {
        "mises": mises,
        "plastic": history,
        "of cells": cx.Projection(history[0, 0], P0),
        "given": fem.Function(P0),
    }
    with cx.VTKOutput(tmp_path / "run.pvd", u, [], fields=fields) as output:
        for step in (1, 2):
            u.interpolate(lambda x, step=step: np.stack([0.01 * step * x[0], 0 * x[0]]))
            history.x.array[:] = fields["given"].x.array[:] = step
            output.write(step)
    reader = pyvista.get_reader(str(tmp_path / "run.pvd"))
    for step in (1, 2):
        reader.set_active_time_value(step)
        data = reader.read()[0]
        assert np.allclose(data.point_data["mises"], 2 * 80 * 0.01 * step, rtol=1e-9)
        assert np.allclose(data.point_data["plastic"], step, rtol=1e-9)
        for name in ("of cells", "given"):
            assert np.allclose(data.cell_data[name], step, rtol=1e-9)


@pytest.mark.parametrize("suffix", [".xdmf", ".bp"])
def test_fields_of_other_formats(tmp_path, suffix):
    domain = domain_of()
    u = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (2,))), name="u")
    P0 = fem.functionspace(domain, (DISCONTINUOUS, 0))
    fields = {"strain": ufl.sym(ufl.grad(u)), "trace": cx.Projection(ufl.div(u), P0)}
    with cx.VTKOutput(tmp_path / f"run{suffix}", u, [], fields=fields) as output:
        output.write(0)
        output.write(1)
    if suffix == ".xdmf":
        assert (tmp_path / "run.xdmf").read_text().count('Attribute Name="strain"') == 2
    else:
        assert {path.name for path in tmp_path.iterdir()} == {"run_vectors.bp", "run_scalars.bp"}


def test_projections_that_are_refused():
    domain, other = domain_of(), domain_of()
    P1 = fem.functionspace(domain, ("Lagrange", 1))
    N1 = fem.functionspace(domain, ("N1curl", 1))
    x = ufl.SpatialCoordinate(domain)
    for kind, message, arguments in (
        (TypeError, "expression is float 1.0: give an expression", (1.0, P1)),
        (TypeError, "V is NoneType None: give a fem.FunctionSpace", (x[0], None)),
        (ValueError, r"expression has the shape \(2,\), and functions of V have \(\)", (x, P1)),
        (ValueError, "V is of .*: give a Lagrange space", (x, N1)),
        (ValueError, "test or trial functions", (ufl.TestFunction(P1), P1)),
        (ValueError, "on another mesh than V", (ufl.SpatialCoordinate(other)[0], P1)),
        (
            ValueError,
            "several quadrature rules",
            (quadrature(domain) * quadrature(domain, degree=3), P1),
        ),
        (
            ValueError,
            "rule of 1 points, which is too coarse for V of degree 2",
            (quadrature(domain, degree=1), fem.functionspace(domain, ("Lagrange", 2))),
        ),
    ):
        with pytest.raises(kind, match=message):
            cx.Projection(*arguments)
    with pytest.raises(TypeError, match=r"dx is .*: give a measure of cells"):
        cx.Projection(x[0], P1, dx=ufl.ds)


def test_fields_that_are_refused(tmp_path):
    domain = domain_of()
    u = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (2,))), name="u")
    x = ufl.SpatialCoordinate(domain)
    P2 = fem.Function(fem.functionspace(domain, ("Lagrange", 2)))
    for kind, message, fields in (
        (TypeError, r"fields is .*: give a list", x[0]),
        (TypeError, r"fields\[0\] is .*expressions by their names", [x[0]]),
        (TypeError, r"fields\['a'\] is int 1", {"a": 1}),
        (ValueError, r"fields has the name 1: give a text", {1: x[0]}),
        (ValueError, r"fields\['a'\] is of .*degree", {"a": P2}),
        (ValueError, r"fields\[0\] is of .*degree", [quadrature(domain)]),
    ):
        with pytest.raises(kind, match=message):
            cx.VTKOutput(tmp_path / "run.pvd", u, [], fields=fields)
