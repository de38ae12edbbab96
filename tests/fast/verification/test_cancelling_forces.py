# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Forces that cancel leave nothing but rounding errors to measure a residual by."""

import numpy as np
import pytest

import ufl
from contactx._host.bulk_host import CellForces
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.problems import make_problem
from story import elasticity

pytestmark = pytest.mark.usefixtures("method")
# Size of the scene and Young's modulus: without units, and of steel in millimetres
UNITS = [(1.0, 1.0), (1e-3, 2e11)]
NU = 0.3


class Apart:
    """Two blocks, free and apart, in any units."""

    def __init__(self, length, young):
        self.scene = Blocks(CellType.quadrilateral, gap=0.01)
        self.u = self.scene.u
        self.domain = self.u.function_space.mesh
        self.domain.geometry.x[:] *= length
        self.length, self.young = length, young
        self.v = ufl.TestFunction(self.u.function_space)

    def stress(self, strain):
        mu, lmbda = self.young / (2 * (1 + NU)), self.young * NU / ((1 + NU) * (1 - 2 * NU))
        return 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(2)

    def problem(self, F):
        return make_problem(F, self.u, [self.scene.contact()])


def thermal(scene):
    """Free bodies that grow without a stress."""
    strain = ufl.sym(ufl.grad(scene.u)) - fem.Constant(scene.domain, 1e-3) * ufl.Identity(2)
    return ufl.inner(scene.stress(strain), ufl.grad(scene.v)) * ufl.dx


def flight(scene):
    """A step of time in free flight, from where the predictor has taken the bodies."""
    predictor = fem.Function(scene.u.function_space)
    predictor.x.array[0::2], predictor.x.array[1::2] = 3e-3 * scene.length, 1.7e-3 * scene.length
    scene.u.x.array[:] = predictor.x.array
    inertia = scene.young / scene.length**2 * ufl.inner(scene.u - predictor, scene.v) * ufl.dx
    return elasticity(scene.u, scene.young, NU) + inertia


def prestress(scene):
    """A uniform stress that tractions balance: nothing moves."""
    stress = fem.Constant(scene.domain, scene.young) * ufl.as_matrix([[2.0, 1.0], [1.0, 3.0]])
    load = ufl.inner(stress * ufl.FacetNormal(scene.domain), scene.v) * ufl.ds
    return (
        elasticity(scene.u, scene.young, NU)
        + ufl.inner(stress, ufl.grad(scene.v)) * ufl.dx
        - load
    )  # fmt: skip


SCENES = {"thermal strain": thermal, "free flight": flight, "prestress": prestress}


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("name", SCENES)
def test_bodies_without_forces(name, units):
    scene = Apart(*units)
    problem = scene.problem(SCENES[name](scene))
    problem.solve()
    assert problem.report.iterations <= 2
    u = scene.u.x.array
    if name == "thermal strain":
        strain = ufl.sym(ufl.grad(scene.u)) - 1e-3 * ufl.Identity(2)
        left = fem.assemble_scalar(fem.form(ufl.inner(strain, strain) * ufl.dx))
        assert np.sqrt(left) <= 1e-14 * scene.length
    elif name == "free flight":
        assert np.abs(u[0::2] - 3e-3 * scene.length).max() <= 1e-15 * scene.length
    else:
        assert np.abs(u).max() <= 1e-13 * scene.length
    before = u.copy()
    for _ in range(2):
        problem.solve()
        assert problem.report.iterations == 0
        assert (u == before).all()
    # Another problem does not know what the first has done
    again = scene.problem(SCENES[name](scene))
    again.solve()
    assert again.report.iterations <= 1


def test_cell_forces_of_one_cell_are_those_of_its_node():
    """Of a uniform stress, by hand: half the force on each side of a square."""
    scene = Apart(1.0, 1.0)
    problem = scene.problem(prestress(scene))
    halo = problem.assembler.halo
    forces = CellForces(
        ufl.inner(ufl.as_matrix([[2.0, 0.0], [0.0, 0.0]]), ufl.grad(scene.v)) * ufl.dx,
        scene.u,
        halo,
        {},
    ).magnitudes()
    # In blocks of 2 by 2 squares of side 1/2 each corner of a cell has the force 2 * 1/2 / 2
    upper = np.flatnonzero(halo.x[:, 1] > 0)
    middle = upper[np.isclose(halo.x[upper], [0.23 + 0.5, 0.51]).all(axis=1)]
    assert len(middle) == 1
    assert forces[middle[0]] == pytest.approx(4 * 0.5)
