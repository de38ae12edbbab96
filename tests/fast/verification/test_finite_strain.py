# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Large deformation, and a material with a history, in plain UFL; quadratic convergence."""

import itertools

import finite_strain
import numpy as np
import pytest

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.materials import Plastic, neo_hookean
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity, fix

pytestmark = pytest.mark.usefixtures("method")


@pytest.mark.parametrize("make", [finite_strain.on_ball, finite_strain.on_block])
def test_a_block_through_30_percent_of_its_height(make, method):
    """In at most ten steps, and in balance: without friction work is energy."""
    press = make(4, "finite")
    reports = []

    def solve(problem):
        problem.solve()
        reports.append(problem.report)

    work, stored = press.run(8, solve)
    for report in reports:
        last = [row.residual for row in report.history[-3:]]
        print(report.iterations, [f"{r:.1e}" for r in last])
        assert report.iterations <= 8
        assert report.frozen_pairs == 0
    force = press.contact.force
    assert press.reaction() == pytest.approx(force[2], rel=1e-9)
    least, most = press.volume_ratios()
    assert 0.5 < least <= most < 1.1
    assert np.nanmin(press.contact.discrete.nodes.gap) > -1e-11
    # On a ball, mean normals times the slave's own nodes are no gradient of the mean gaps: their
    # work is energy to the square of the mesh size
    assert stored == pytest.approx(work, rel=0.01 if method == "node-to-surface" else 0.015)


def test_convergence_of_the_last_step_is_quadratic():
    press = finite_strain.on_ball(4, "finite")
    press.run(4, lambda problem: problem.solve())
    r = [row.residual for row in press.problem.report.history]
    scale = abs(press.contact.force[2])
    print("relative residuals", [f"{x / scale:.1e}" for x in r])
    pairs = [(a / scale, b / scale) for a, b in itertools.pairwise(r)]
    pairs = [(a, b) for a, b in pairs if 1e-12 < a < 1e-1]
    assert len(pairs) >= 2
    assert all(b <= max(50 * a**2, 1e-13) for a, b in pairs)


def test_plasticity_with_history_in_a_quadrature_space():
    """A ball dents a block; taken away, the dent stays and the force is gone."""
    data = meshes.hertz_sphere(0.04)
    mesh, tags = meshes.single(data, Tag.LOWER)
    u = displacement(mesh)
    material = Plastic(u)
    bcs = [
        fix(u, tags, 0, 0.0, Tag.LOWER_X0),
        fix(u, tags, 1, 0.0, Tag.LOWER_Y0),
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
    ]
    centre = fem.Constant(mesh, np.array([0.0, 0.0, 1.0]))
    contact = cx.Contact(cx.Surface(tags, Tag.LOWER_CONTACT), cx.Sphere(centre, 1.0))
    problem = make_problem(
        material.F, u, [contact], bcs, petsc_options={"snes_linesearch_type": "bt"}
    )
    # Unloading starts with the tangent of plastic flow, far too soft: damp the step
    forces, iterations = [], []
    for depth in (0.005, 0.01, 0.015, 0.02, 0.0):
        centre.value[2] = 1 - depth
        contact.active = depth > 0
        problem.solve()
        material.commit()
        forces.append(-contact.force[2])
        iterations.append(problem.report.iterations)
    print("forces", forces, "iterations", iterations)
    assert np.all(np.diff(forces[:4]) > 0)
    assert forces[4] == 0
    assert material.equivalent.x.array.max() > 0.01
    assert max(iterations) <= 12
    elastic = 4 / 3 / (1 - 0.3**2) * 100 * 0.02**1.5 / 4
    assert forces[3] < 0.8 * elastic
    x = u.function_space.tabulate_dof_coordinates()
    pole = np.argmin(np.linalg.norm(x, axis=1))
    assert -0.02 < u.x.array[3 * pole + 2] < -0.004


def test_two_finite_strain_bodies_of_different_cells_need_no_change():
    """Triangles in the plane: the same material in 2D."""
    data = meshes.blocks(CellType.triangle, (5, 5), (9, 6), size_lower=(1.6, 1.0), shift=(0.3,))
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2)),
        fix(u, tags, 0, 0.0, Tag.UPPER_TOP),
        fix(u, tags, 1, 0.0, Tag.UPPER_TOP),
    ]
    contact = pair_of(tags)
    problem = make_problem(neo_hookean(u, 2.6, 0.3), u, [contact], bcs)
    for step in range(1, 7):
        bcs[-1].g.value[...] = -0.05 * step
        problem.solve()
        assert problem.report.iterations <= 12
    assert contact.force[1] > 0.1
    assert np.nanmin(contact.discrete.nodes.gap) > -1e-11


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
