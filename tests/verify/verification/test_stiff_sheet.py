# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A stiff sheet tied to soft ground: iterations with blocks of bodies as both grow."""

import pytest

import ufl
from contactx._host.condensed import soft_stiff
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity, fix

BY_BODIES = {"pc_type": "condensed", "condensed_pc_type": "bodies"}
CELL, THICK, STIFF = 0.5, 0.5, 1e4


def iterations(length):
    """Krylov iterations of a solve with factors of this matrix, under a load at the end."""
    n = round(length / CELL)
    data = meshes.blocks(
        CellType.quadrilateral,
        (n, n // 2),
        (2 * n, 2),
        size_upper=(length, length / 2),
        size_lower=(length, THICK),
    )
    tags = data.facet_tags
    u = displacement(data.mesh, 1)
    young = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
    young.x.array[:] = 1.0
    young.x.array[data.cell_tags.find(Tag.LOWER)] = STIFF
    load = 1e-4 * ufl.exp(-(ufl.SpatialCoordinate(data.mesh)[0] ** 2))
    ds = ufl.Measure("ds", domain=data.mesh, subdomain_data=tags)
    F = elasticity(u, young, 0.3) - load * ufl.TestFunction(u.function_space)[1] * ds(
        Tag.LOWER_BOTTOM
    )
    contact = pair_of(tags, tied=True, sliding="small")
    problem = make_problem(
        F,
        u,
        [contact],
        [fix(u, tags, axis, 0.0, Tag.UPPER_TOP) for axis in range(2)],
        petsc_options=BY_BODIES,
    )
    problem.solve()
    assert not problem.report.uncondensed
    return problem.report.krylov / problem.report.iterations


@pytest.fixture
def model(monkeypatch):
    """The coarse model."""
    monkeypatch.setattr(soft_stiff, "_MAX_ITERATIONS_WITH_SPRINGS", 0)


def test_iterations_with_the_coarse_model_hardly_grow(model):
    """Over eight times the length, as from 5 to 40 slabs of a dam."""
    assert iterations(64) <= 1.5 * iterations(8)
