# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Laws of friction of the user's own, against closed formulas."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem, mesh

import story
from scenes.coulomb import parts
from scenes.grids import faces
from scenes.problems import make_problem

PRESSURE = 0.2


class Pushed:
    """A block of 2 by 1, pressed on a rigid floor by a uniform pressure and pushed by its top.

    Its top stays level if it is held, else it may tilt.
    """

    def __init__(self, friction, dim=2, method="node-to-surface", held=False, **options):
        if dim == 2:
            domain = mesh.create_rectangle(MPI.COMM_WORLD, [[0, 0], [2, 1]], [8, 4])
        else:
            domain = mesh.create_box(MPI.COMM_WORLD, [[0, 0, 0], [2, 1, 1]], [4, 2, 2])
        tags = faces(domain, [(dim - 1, 0), (dim - 1, 1)])
        self.u = u = story.displacement(domain)
        load = fem.Constant(domain, -PRESSURE * np.eye(dim)[-1])
        F = story.elasticity(u, 10.0, 0.0) + story.traction(u, tags, 2, load)
        self.push = fem.Constant(domain, 0.0)
        V = u.function_space.sub(0)
        dofs = fem.locate_dofs_topological(V, dim - 1, tags.find(2))
        bcs = [fem.dirichletbc(self.push, dofs, V)]
        bcs += [story.fix(u, tags, i, 0.0, 2) for i in range(1, dim - 1)]
        if held:
            bcs.append(story.fix(u, tags, dim - 1, -PRESSURE / 10, 2))
        floor = cx.Plane(np.zeros(dim), np.eye(dim)[-1])
        self.contact = cx.Contact(cx.Surface(tags, 1), floor, friction=friction, method=method)
        self.problem = make_problem(F, u, [self.contact], bcs, **options)

    def pushed_to(self, *places):
        """Forces of friction at displacements of the top."""
        forces = []
        for place in places:
            self.push.value = place
            self.problem.solve()
            forces.append(-self.contact.force[0])
        return np.array(forces)


@pytest.mark.parametrize("dim", [2, 3])
@pytest.mark.parametrize("method", story.METHODS)
def test_a_bound_of_tresca_is_a_force_per_area(dim, method):
    scene = Pushed(cx.FrictionLaw(lambda p, s: ufl.as_ufl(0.03)), dim, method)
    forces = scene.pushed_to(0.001, 0.1, 0.3)
    assert 0 < forces[0] < 0.7 * 0.06
    # In 3D nodes first slip askew
    np.testing.assert_allclose(forces[1:], 0.03 * 2, rtol=1e-9 if dim == 2 else 1e-5)


def test_coulombs_law_as_a_law_of_ones_own_is_coulombs():
    laws = [
        0.3,
        cx.FrictionLaw(lambda p, s: 0.3 * p),
        cx.FrictionLaw(lambda p, s: 0.3 * p, lambda p, s: (np.full_like(p, 0.3), 0.0)),
    ]
    answers = []
    for law in laws:
        scene = Pushed(law)
        forces = scene.pushed_to(0.005, 0.1, -0.1)
        answers.append((forces, scene.contact.multiplier, scene.problem.report.iterations))
    for forces, multiplier, iterations in answers[1:]:
        np.testing.assert_allclose(forces, answers[0][0], rtol=1e-11)
        np.testing.assert_allclose(multiplier, answers[0][1], rtol=0, atol=1e-11)
        assert iterations == answers[0][2]


def test_friction_up_to_a_limit_is_the_smaller_of_both():
    limit = 0.3 * PRESSURE
    scene = Pushed(cx.FrictionLaw(lambda p, s: ufl.min_value(0.3 * p, limit)))
    scene.pushed_to(0.1)
    p, t = parts(scene.contact)
    size = np.linalg.norm(t, axis=1)
    np.testing.assert_allclose(size, np.minimum(0.3 * p, limit), rtol=1e-8)
    assert (0.3 * p > 1.1 * limit).any()
    assert (0.3 * p < 0.9 * limit).any()


@pytest.mark.parametrize("solver", ["lu", "condensed"])
def test_friction_that_weakens_with_slip_counts_the_slip_of_all_steps(solver):
    def law(p, s):
        return (0.2 + 0.2 * ufl.exp(-s / 0.05)) * p

    given = {"pc_type": solver}
    if solver == "lu":
        given["pc_factor_mat_solver_type"] = "mumps"
    scene = Pushed(cx.FrictionLaw(law), held=True, petsc_options=given)
    places = [0.05, 0.1, 0.05, 0.15]
    forces = []
    for place in places:
        forces.append(float(scene.pushed_to(place)[0] / scene.contact.force[1]))
    # All nodes slip by about what the top moves
    way = np.cumsum(np.abs(np.diff([0.0, *places])))
    signs = np.sign(np.diff([0.0, *places]))
    np.testing.assert_allclose(forces, signs * (0.2 + 0.2 * np.exp(-way / 0.05)), rtol=0.15)
    assert (np.diff(np.abs(forces)) < 0).all()
    p, t = parts(scene.contact)
    total = scene.contact.slip_total.x.array[scene.contact.slave_nodes]
    np.testing.assert_allclose(
        np.linalg.norm(t, axis=1), (0.2 + 0.2 * np.exp(-total / 0.05)) * p, rtol=1e-7
    )


def test_constants_of_a_law_may_change():
    scene = Pushed(0.0)
    domain = scene.u.function_space.mesh
    limit = fem.Constant(domain, 0.03)
    scene = Pushed(cx.FrictionLaw(lambda p, s: ufl.as_ufl(limit)), held=True)
    first = scene.pushed_to(0.1)
    limit.value = 0.05
    second = scene.pushed_to(0.3)
    np.testing.assert_allclose([*first, *second], [0.06, 0.1], rtol=1e-9)


def test_a_law_that_is_none_is_refused():
    with pytest.raises(ValueError, match="function of a FrictionLaw is not one of UFL"):
        Pushed(cx.FrictionLaw(lambda p, s: np.exp(p))).pushed_to(0.1)
    with pytest.raises(ValueError, match=r"bound -0\.1.* at the pressure.*at least 0"):
        Pushed(cx.FrictionLaw(lambda p, s: ufl.as_ufl(-0.1))).pushed_to(0.1)
    wrong = cx.FrictionLaw(lambda p, s: 0.3 * p, lambda p, s: (np.ones(3), 0.0))
    with pytest.raises(ValueError, match="derivative by p of a FrictionLaw has the shape"):
        Pushed(wrong).pushed_to(0.1)
