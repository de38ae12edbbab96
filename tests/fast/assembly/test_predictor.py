# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Extrapolation of a step's first solution."""

import numpy as np
import pytest

from contactx._host.condensed import predictor
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import NU
from scenes.covering import METHODS
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity, fix, traction

STEPS = 8


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_values_of_a_polynomial_go_on(order):
    coefficients = np.arange(1.0, order + 1)[:, None] * [[1.0, -2.0]]
    values = [sum(c * k**i for i, c in enumerate(coefficients)) for k in range(order + 1)]
    np.testing.assert_allclose(predictor._next(values[-2::-1]), values[-1], rtol=1e-13)


def pressed(method, solver, load_at):
    """Displacement and reports of a block that is pressed on a wider one in steps."""
    data = meshes.blocks(CellType.hexahedron, (4, 4, 4), (5, 5, 3), size_lower=(1.5, 1.5, 1.0))
    tags, u = data.facet_tags, displacement(data.mesh)
    load = fem.Constant(data.mesh, (0.0, 0.0, 0.0))
    contact = pair_of(tags, method=method)
    bcs = [
        fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
    ]
    problem = make_problem(
        elasticity(u, 1.0, NU) + traction(u, tags, Tag.UPPER_TOP, load),
        u,
        [contact],
        bcs,
        petsc_options={"pc_type": solver},
    )
    reports = []
    for k in range(STEPS):
        load.value[...] = load_at(k + 1)
        problem.solve()
        reports.append(problem.report)
    return u.x.array, contact.multiplier, reports


@pytest.mark.parametrize("method", METHODS)
def test_even_loads(method):
    """Steps take less and less, and come to the same."""
    answers = [pressed(method, pc, lambda k: (0.0, 0.0, -2e-3 * k)) for pc in ("lu", "condensed")]
    for found, exact in zip(answers[1][:2], answers[0][:2], strict=True):
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-9 * np.abs(exact).max())
    reports = answers[1][2]
    assert sum(r.uncondensed != [] for r in reports) == 0
    assert reports[-1].krylov <= 0.7 * reports[1].krylov
    assert reports[-1].iterations < reports[1].iterations


@pytest.mark.parametrize("method", METHODS)
def test_loads_that_turn(method):
    """What was is no guide then, and does no harm."""

    def turning(k):
        return (1e-4 * (-1) ** k, 3e-4 * (k % 3), -2e-3 - 1e-3 * (k % 2))

    answers = [pressed(method, pc, turning) for pc in ("lu", "condensed")]
    for found, exact in zip(answers[1][:2], answers[0][:2], strict=True):
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-9 * np.abs(exact).max())
    direct, condensed = (sum(r.iterations for r in answer[2]) for answer in answers)
    assert condensed <= direct + STEPS
