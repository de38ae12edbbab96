# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Quadratic convergence of finite sliding on a curved surface."""

import itertools

import numpy as np
import pytest

from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.materials import neo_hookean
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity, fix

pytestmark = pytest.mark.usefixtures("method")


def residuals_after_settling(report):
    """Residuals from the iteration on after which neither status nor pairs changed."""
    last = max(
        (row.number for row in report.history if row.status_changes or row.pair_changes), default=0
    )
    return [row.residual for row in report.history if row.number >= last]


@pytest.mark.parametrize("cell", ["tetrahedra", "hexahedra"])
def test_curved_finite_sliding_converges_quadratically(cell, method):
    """A second, tangential step slides the cap over the surface that the first has dented."""
    if cell == "tetrahedra":
        data, slide = meshes.hertz_sphere(0.04), 0.02
    else:
        data, slide = meshes.hertz_cap(8), 0.02
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
        fix(u, tags, 0, 0.0, Tag.UPPER_TOP),
        fix(u, tags, 2, -0.02, Tag.UPPER_TOP),
    ]
    contact = pair_of(tags)
    # Rates are those of Newton's method, with exact steps
    problem = make_problem(
        elasticity(u, 1.0, 0.3),
        u,
        [contact],
        bcs,
        petsc_options={"snes_rtol": 1e-15, "pc_type": "lu"},
    )
    problem.solve()
    bcs[-2].g.value[...] = slide
    problem.solve()
    print(problem.report.table())
    scale = max(row.residual for row in problem.report.history)
    r = np.array(residuals_after_settling(problem.report)) / scale
    print("relative residuals once status and pairs have settled:", r)
    # The master ends at the plane of symmetry, and what moves of its end is left out of the tangent
    check_quadratic(r, linear=2e-4 if method == "surface-to-surface" else 0.0)


def check_quadratic(r, linear=0.0):
    """Each residual is at most a constant times the square of the one before, until rounding.

    Args:
        r: Residuals.
        linear: Share of the one before that may stay as well.
    """
    pairs = [(before, after) for before, after in itertools.pairwise(r) if before > 1e-12]
    assert len(pairs) >= 2
    for before, after in pairs:
        assert after <= max(50 * before**2, linear * before, 1e-14)


def test_finite_strain_block_converges_quadratically():
    """A neo-Hookean block on a stiffer one: bulk and contact are both nonlinear."""
    data = meshes.blocks(
        CellType.tetrahedron, (3, 3, 3), (4, 4, 4), size_lower=(1.5, 1.5, 1), shift=(0.23, 0.23)
    )
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM, Tag.UPPER_TOP) for i in range(2)),
        fix(u, tags, 2, 0.0, Tag.LOWER_BOTTOM),
        fix(u, tags, 2, -0.1, Tag.UPPER_TOP),
    ]
    contact = pair_of(tags)
    problem = make_problem(
        neo_hookean(u, 2.6, 0.3), u, [contact], bcs, petsc_options={"snes_rtol": 1e-15}
    )
    problem.solve()
    print(problem.report.table())
    scale = problem.report.history[0].residual
    r = np.array(residuals_after_settling(problem.report)) / scale
    print("relative residuals once status and pairs have settled:", r)
    check_quadratic(r)
    assert problem.report.iterations == problem.assembler.bulk.assemblies
