# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is said of iterations that come to nothing, and of bodies that stay apart."""

from types import SimpleNamespace

import numpy as np
import pytest

import contactx as cx
import ufl
from contactx import cpp as core
from dolfinx import fem
from dolfinx.mesh import CellType

from scenes import NU, Blocks
from scenes.materials import Plastic, neo_hookean
from story import elasticity

QUOTIENT = "the Jacobian is not the derivative of F: along the last step it differs by"


def failure(scene, contact=None, start=0.0, **options):
    problem = scene.problem(contact or scene.contact(), **options)
    with pytest.raises(cx.ConvergenceError) as caught:
        problem.solve()
    assert (scene.u.x.array == start).all()
    return str(caught.value)


@pytest.mark.parametrize("pc", ["lu", "condensed"])
def test_a_wrong_jacobian_is_named(pc):
    """One of a material twice as soft, with which Newton's method goes to and fro."""
    scene = Blocks(CellType.triangle)
    scene.F = neo_hookean(scene.u, 1.0, NU, degree=2)
    J = ufl.derivative(neo_hookean(scene.u, 0.4, NU, degree=2), scene.u)
    options = {"snes_max_it": 12, "pc_type": pc}
    said = failure(scene, J=J, petsc_options=options)
    assert QUOTIENT in said
    assert "Correct J, or leave it out to have it derived" in said


def test_a_coefficient_that_the_derivative_does_not_see():
    scene = Blocks(CellType.triangle)
    V = scene.u.function_space
    same = fem.Function(V, x=scene.u.x)
    scene.F += 40 * ufl.inner(same, ufl.TestFunction(V)) * ufl.dx
    said = failure(scene, petsc_options={"snes_max_it": 12})
    assert QUOTIENT in said
    assert "a coefficient that depends on u: give J" in said


def test_a_right_jacobian_is_not_blamed():
    scene = Blocks(CellType.triangle, down=0.3)
    scene.F = neo_hookean(scene.u, 1.0, NU, degree=2)
    said = failure(scene, petsc_options={"snes_max_it": 1})
    assert "no convergence in snes_max_it iterations" in said
    assert "Jacobian" not in said


def test_smaller_steps_are_not_advised_where_they_cannot_help():
    """Half the load is the same problem, scaled: the same iterates, of half the residual."""
    residuals, status = [], []
    for down in (0.05, 0.025):
        scene = Blocks(CellType.triangle, down=down)
        contact = scene.contact("small", friction=0.05)
        problem = scene.problem(contact)
        problem.solve()
        residuals.append([row.residual / down for row in problem.report.history[:-1]])
        assert problem.report.iterations > 1
        status.append(contact.status.x.array)
    assert residuals[0] == pytest.approx(residuals[1], rel=1e-9)
    assert (status[0] == status[1]).all()
    scene = Blocks(CellType.triangle)
    contact = scene.contact("small", friction=0.05)
    said = failure(scene, contact, petsc_options={"snes_max_it": 1})
    assert "smaller load steps would not help" in said
    assert "take smaller load steps" not in said


@pytest.mark.parametrize("what", ["gap", "finite", "law", "material", "start"])
def test_smaller_steps_are_advised_else(what):
    scene = Blocks(CellType.triangle, gap=1e-3 if what == "gap" else 0.0)
    if what == "material":
        scene.F = neo_hookean(scene.u, 1.0, NU, degree=2)
    law = cx.FrictionLaw(lambda p, s: 1e-3 + 0 * p)
    contact = scene.contact(
        "finite" if what == "finite" else "small", friction=law if what == "law" else 0.05
    )
    start = np.zeros_like(scene.u.x.array)
    if what == "start":
        start[:] = 1e-3 * np.sin(np.arange(len(start)))
        scene.u.x.array[:] = start
    said = failure(scene, contact, start, petsc_options={"snes_max_it": 1})
    assert "in snes_max_it iterations: take smaller load steps" in said


@pytest.mark.parametrize("wrong", [False, True])
def test_a_kink_of_the_material_is_not_blamed(wrong):
    """Where an accepted step has ended plastic bodies are about to yield, or to unload."""
    scene = Blocks(CellType.hexahedron)
    u = scene.u
    material = Plastic(u)
    J = ufl.derivative(material.F, u)
    if wrong:
        w, v = ufl.TrialFunction(u.function_space), ufl.TestFunction(u.function_space)
        J += 0.1 * ufl.inner(ufl.grad(w), ufl.grad(v)) * ufl.dx
    scene.F = material.F
    problem = scene.problem(scene.contact(), J=J)
    u.interpolate(lambda x: (0.01 * x[0], 0 * x[0], -0.02 * x[2]))
    material.commit()
    way = u.x.array.copy()
    assembler = problem.assembler
    system, extent = assembler.system.core, assembler.loop.convergence.extent
    # Half of each side's derivative
    assert core.derivative_error(system, way, 1e-6) > 0.1
    error = core.least_derivative_error(system, way, extent)
    print(error)
    assert error > 1e-3 if wrong else error < 1e-6
    assert (u.x.array == way).all()


@pytest.mark.parametrize("wrong", [False, True])
def test_rounding_of_rigid_motions_is_not_blamed(wrong):
    """Bodies without supports may end in steps that turn them: no force, but its rounding."""
    scene = Blocks(CellType.quadrilateral)
    u, v = scene.u, ufl.TestFunction(scene.u.function_space)
    F = elasticity(u, 1.0, NU)
    J = ufl.derivative(F, u)
    if wrong:
        J += 1e-3 * ufl.inner(ufl.TrialFunction(u.function_space), v) * ufl.dx
    u.interpolate(lambda x: 0.01 * x[:2] ** 2)
    scene.F, scene.bcs = F, []
    problem = scene.problem(scene.contact(), J=J)
    turned = fem.Function(u.function_space)
    turned.interpolate(lambda x: (-x[1], x[0]))
    error = core.derivative_error(problem.assembler.system.core, turned.x.array, 1e-6)
    assert error > 0.5 if wrong else error < 1e-3


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.triangle], ids=lambda c: c.name)
def test_a_derived_jacobian_is_that_of_the_points_of_f(cell):
    """UFL estimates more points for a derivative that is no polynomial."""
    scene = Blocks(cell)
    u, v = scene.u, ufl.TestFunction(scene.u.function_space)
    deformed = ufl.Identity(2) + ufl.grad(u)
    stress = deformed - ufl.inv(deformed).T + ufl.ln(ufl.det(deformed)) * ufl.inv(deformed).T
    scene.F, scene.bcs = ufl.inner(stress, ufl.grad(v)) * ufl.dx, []
    noise = np.random.default_rng(0)
    u.x.array[:] = 0.03 * noise.normal(size=len(u.x.array))
    problem = scene.problem(scene.contact())
    direction = noise.normal(size=len(u.x.array))
    assert core.derivative_error(problem.assembler.system.core, direction, 1e-6) < 1e-7


def test_a_tolerance_below_rounding_is_named(monkeypatch):
    """Where no estimate of the rounding errors helps."""
    scene = Blocks(CellType.triangle)
    names = [name for name in vars(core.Settled) if not name.startswith("_")]
    judge = core.Problem.judge

    def judge_strictly(*given):
        found = judge(*given)
        return SimpleNamespace(
            **{name: getattr(found, name) for name in names} | {"converged": False}
        )

    monkeypatch.setattr(core.Problem, "judge", judge_strictly)
    monkeypatch.setattr(core.Problem, "converged", False)
    said = failure(scene, petsc_options={"snes_rtol": 1e-30})
    assert "the residual stagnates at" in said
    assert "Raise snes_rtol, or set snes_atol" in said


@pytest.fixture
def scene():
    return Blocks(CellType.tetrahedron)


def test_out_of_reach_warns_with_the_distance():
    scene = Blocks(CellType.tetrahedron, gap=5.0)
    problem = scene.problem(scene.contact())
    with pytest.warns(UserWarning, match=r"no slave node within reach.* 4\.95 away.* 2\.12"):
        problem.solve()
    assert problem.report.pairs == 0
    assert problem.report.iterations == 1


def test_small_sliding_out_of_reach_says_where_it_pairs():
    scene = Blocks(CellType.triangle, gap=0.2, down=0.1)
    problem = scene.problem(scene.contact("small", search_distance=0.1))
    said = (
        r"no slave node within reach.* 0\.2 away in the reference configuration.* reaches 0\.1\. "
        r'sliding="small" pairs nodes .* larger search_distance, or take sliding="finite"'
    )
    with pytest.warns(UserWarning, match=said):
        problem.solve()


def test_small_sliding_out_of_reach_must_not_pass_through():
    """The bodies are pressed into each other, and nothing resists."""
    scene = Blocks(CellType.triangle, gap=0.2, down=0.3)
    problem = scene.problem(scene.contact("small", search_distance=0.1))
    said = (
        r"slave nodes are inside the master, and have no pair with it, .*: "
        r'sliding="small" pairs nodes .* larger search_distance, or take sliding="finite"'
    )
    with pytest.raises(cx.ConvergenceError, match=said):
        problem.solve()


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
