# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Displacements that are a part of a mixed space, or one of several functions."""

from itertools import product

import numpy as np
import pytest

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes.coupled import Coupled, fix, thermal
from scenes.problems import make_problem

KINDS = ("mixed", "mixed, pressure first", "blocks")
OPTIONS = {
    "frictionless": {},
    "friction": {"friction": 0.3},
    "facets": {"method": "surface-to-surface", "friction": 0.3},
    "tied": {"tied": True},
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_a_pressure_in_cells_changes_nothing(options):
    # Eliminated cell by cell it gives what the displacement alone has
    plain = Coupled("plain", **options)
    plain.problem.solve()
    assert np.abs(plain.contact.multiplier).max() > 0.01
    for kind in KINDS:
        scene = Coupled(kind, **options)
        assert scene.problem.solve() is scene.w
        assert scene.problem.report.iterations == plain.problem.report.iterations
        u = scene.problem.displacement.x.array
        assert np.abs(u - plain.w.x.array).max() < 1e-13
        assert np.abs(scene.contact.multiplier - plain.contact.multiplier).max() < 1e-12
        status = scene.contact.status.x.array
        assert (status == plain.contact.status.x.array).all()


@pytest.mark.parametrize("cell", [CellType.tetrahedron, CellType.hexahedron])
def test_it_does_so_in_space(cell):
    plain, mixed = Coupled("plain", cell, friction=0.2), Coupled("mixed", cell, friction=0.2)
    for scene in (plain, mixed):
        scene.problem.solve()
    if cell == CellType.tetrahedron:
        assert mixed.contact.force == pytest.approx(plain.contact.force, rel=1e-11)
    else:
        # One pressure a cell is softer
        assert 0 < plain.contact.force[2] / mixed.contact.force[2] - 1 < 0.08


def test_what_the_user_set_is_where_the_solve_starts():
    scene = Coupled("MINI", friction=0.3)
    scene.problem.solve()
    solution = scene.w.x.array.copy()
    scene.problem.solve()
    assert scene.problem.report.iterations == 0
    scene.w.x.array[:] *= 1 + 1e-6
    scene.problem.solve()
    assert scene.problem.report.iterations == 1
    assert np.abs(scene.w.x.array - solution).max() < 1e-12


def test_bubbles_soften_what_locks():
    plain, mini = Coupled("plain"), Coupled("MINI")
    for scene in (plain, mini):
        scene.problem.solve()
    assert 0.9 < mini.contact.force[1] / plain.contact.force[1] < 0.999


@pytest.mark.parametrize(
    ("cell", "friction"), [(CellType.triangle, 0.2), (CellType.tetrahedron, 0.0)]
)
def test_nearly_incompressible_neo_hooke(cell, friction):
    scene = Coupled("neo-Hooke", cell, friction=friction)
    down = scene.down

    def update(t):
        down.value = -0.1 * t

    steps = cx.LoadSteps(scene.problem, 2, update=update, progress=False)
    assert [step.iterations for step in steps][-1] <= 6
    u = scene.problem.displacement
    # Volume hardly changes: what goes in must come out
    F = ufl.Identity(len(u)) + ufl.grad(ufl.split(scene.w)[0])
    volume = fem.assemble_scalar(fem.form(ufl.det(F) * ufl.dx))
    whole = fem.assemble_scalar(fem.form(fem.Constant(u.function_space.mesh, 1.0) * ufl.dx))
    assert abs(volume / whole - 1) < 1e-4
    assert scene.contact.force[-1] > 0.05


def test_a_failed_step_leaves_everything_as_it_was():
    scene = Coupled("neo-Hooke", friction=0.2)
    scene.problem.solve()
    before = scene.w.x.array.copy(), scene.problem.displacement.x.array.copy()
    multiplier = scene.contact.multiplier.copy()
    scene.down.value = -5.0
    with pytest.raises(cx.ConvergenceError):
        scene.problem.solve()
    assert (scene.w.x.array == before[0]).all()
    assert (scene.problem.displacement.x.array == before[1]).all()
    assert (scene.contact.multiplier == multiplier).all()
    scene.down.value = -0.06
    scene.problem.solve()


@pytest.mark.parametrize("kind", ["blocks", "neo-Hooke"])
def test_steps_are_gone_on_with_from_a_checkpoint(kind, tmp_path):
    def steps(scene, **options):
        def update(t):
            scene.down.value = -0.08 * t

        return cx.LoadSteps(scene.problem, 4, update=update, progress=False, **options)

    straight, first, second = (Coupled(kind, friction=0.2) for _ in range(3))
    list(steps(straight))
    for step in steps(first, checkpoint=tmp_path / "state.state"):
        if step.index == 2:
            break
    list(steps(second, restart=tmp_path / "state.state"))
    for a, b in zip(straight.functions, second.functions, strict=True):
        assert a.x.array.tobytes() == b.x.array.tobytes()
    assert (straight.contact.multiplier == second.contact.multiplier).all()


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_heat_presses_as_it_does_field_by_field(unit):
    F, u, T, heat, hold, contact = thermal()
    F[1] = unit * F[1]
    problem = make_problem(F, [u, T], [contact], heat + hold, displacement=0)
    problem.solve()
    # Newton's method converges quadratically, whatever heat is measured in
    assert problem.report.iterations <= 7
    G, w, S, heat, hold, same = thermal()
    fem.petsc.NonlinearProblem(
        G[1], S, bcs=heat, petsc_options_prefix="heat_", petsc_options={"snes_rtol": 1e-12}
    ).solve()
    make_problem(G[0], w, [same], hold).solve()
    assert np.abs(T.x.array - S.x.array).max() < 1e-9
    assert np.abs(u.x.array - w.x.array).max() < 1e-12
    assert contact.force == pytest.approx(same.force, rel=1e-9)
    assert contact.force[1] > 1e-3


def test_a_hand_written_loop_solves_it_too():
    F, u, T, heat, hold, contact = thermal()
    assembler = cx.ContactAssembler(F, [u, T], contacts=[contact], bcs=heat + hold, displacement=0)
    F, w, S, heat, hold, same = thermal()
    problem = make_problem(F, [w, S], [same], heat + hold, displacement=0)
    problem.solve()
    b, dx = assembler.create_vector(), assembler.create_vector()
    ksp = problem.solver.getKSP()
    assembler.begin_step()
    while not (found := assembler.settle()).converged:
        assembler.residual(b)
        assembler.set_up(ksp)
        b.scale(-1)
        ksp.solve(b, dx)
        assembler.update(dx, assembler.limit(dx))
    assembler.accept()
    assert found.number == problem.report.iterations
    assert np.abs(u.x.array - w.x.array).max() < 1e-12
    assert np.abs(T.x.array - S.x.array).max() < 1e-10
    # The bulk has both fields' rows
    assembler.begin_step()
    size = len(u.x.array) + len(T.x.array)
    assert assembler.blocks()["K"].getSize() == (size, size)


def test_a_jacobian_may_be_given():
    scene = Coupled("blocks")
    scene.problem.solve()
    p, u = scene.w
    Q, V = p.function_space, u.function_space
    dp, du = ufl.TrialFunction(Q), ufl.TrialFunction(V)
    J = [
        [ufl.derivative(scene.F[0], p, dp), ufl.derivative(scene.F[0], u, du)],
        [ufl.derivative(scene.F[1], p, dp), ufl.derivative(scene.F[1], u, du)],
    ]
    contact = scene.new_contact()
    w = [fem.Function(Q), fem.Function(V)]
    F = [ufl.replace(f, dict(zip(scene.w, w, strict=True))) for f in scene.F]
    make_problem(F, w, [contact], scene.bcs, J=J, displacement=1).solve()
    assert np.abs(w[1].x.array - u.x.array).max() < 1e-13


def test_a_field_that_nothing_couples_is_solved_for_as_well():
    plain = Coupled("plain", friction=0.3)
    V = plain.w.function_space
    u, T = fem.Function(V), fem.Function(fem.functionspace(V.mesh, ("Lagrange", 1)))
    q, dT = ufl.TestFunction(T.function_space), ufl.TrialFunction(T.function_space)
    F = [ufl.replace(plain.F, {plain.w: u}), ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx]
    J = [[ufl.derivative(F[0], u, ufl.TrialFunction(V)), None], [None, ufl.derivative(F[1], T, dT)]]
    warm = [
        fix(T.function_space, plain.tags, 3.0, tag) for tag in (Tag.LOWER_BOTTOM, Tag.UPPER_TOP)
    ]
    for given in (J, None):
        u.x.array[:] = T.x.array[:] = 0
        problem = make_problem(
            F, [u, T], [plain.new_contact(friction=0.3)], plain.bcs + warm, J=given, displacement=0
        )
        problem.solve()
        assert np.abs(T.x.array - 3).max() < 1e-12
        plain.problem.solve()
        assert np.abs(u.x.array - plain.w.x.array).max() < 1e-13


def refused(message, error=ValueError, **changes):
    """What a problem with other arguments must say."""
    scene = Coupled("blocks")
    arguments = {"F": scene.F, "u": scene.w, "displacement": 1, "bcs": scene.bcs, **changes}
    with pytest.raises(error, match=message):
        cx.ContactAssembler(contacts=[scene.new_contact()], **arguments)


def test_what_does_not_fit_is_refused():
    scene = Coupled("blocks")
    p, u = scene.w
    domain = u.function_space.mesh
    refused(
        "displacement is NoneType None: give the number of the block", TypeError, displacement=None
    )
    refused("displacement is 2: give a number from 0 to 1", displacement=2)
    refused("displacement is bool True", TypeError, displacement=True)
    refused("the displacement is in .* no space of vectors of 2 Lagrange", displacement=0)
    refused(r"u\[1\] must be a dolfinx.fem.Function, not str", TypeError, u=[p, "T"])
    refused("u is an empty list", u=[])
    refused("u lists the same function twice", u=[u, u])
    refused("F must be a list with a residual for each function", TypeError, F=scene.F[0])
    refused("F has 1 residuals, but u has 2", F=scene.F[:1])
    refused("an argument in .* not of the function space of u", F=scene.F[::-1])
    other = Coupled("blocks").w[0]
    refused("functions on several meshes", u=[other, u])
    loose = fem.Function(p.function_space)
    refused(r"F\[0\] has an argument|no residual depends on u\[0\]", u=[loose, u])
    refused("J has 1 rows, but u has 2", J=[[None, None]])
    refused(r"J\[0\] must be a list with a form", TypeError, J=[None, None])
    cubic = fem.Function(fem.functionspace(domain, ("Lagrange", 3, (2,))))
    refused("contact needs degree 1 or 2 on the surface", u=[p, cubic])
    refused("displacement=0 is for a mixed space or a list", F=scene.F[0], u=p, displacement=0)


def test_a_mixed_space_needs_to_say_which_part():
    scene = Coupled("mixed")
    with pytest.raises(ValueError, match="say which part is the displacement"):
        cx.ContactAssembler(scene.F, scene.w, contacts=[scene.new_contact()])
    scalar = basix.ufl.element("Lagrange", "triangle", 1)
    W = fem.functionspace(scene.w.function_space.mesh, basix.ufl.mixed_element([scalar, scalar]))
    w = fem.Function(W)
    F = ufl.inner(w, ufl.TestFunction(W)) * ufl.dx
    with pytest.raises(ValueError, match="no space of vectors"):
        cx.ContactAssembler(F, w, contacts=[scene.new_contact()], displacement=0)


@pytest.mark.parametrize(
    ("kind", "cell", "name"),
    [
        *product([*KINDS, "MINI"], [CellType.tetrahedron], OPTIONS),
        *product(["mixed", "MINI"], [CellType.triangle], OPTIONS),
        # Without friction it has two solutions, with four and with five nodes closed
        *product(["neo-Hooke"], [CellType.triangle], list(OPTIONS)[1:]),
    ],
)
def test_fields_are_split_from_condensed_displacements(kind, cell, name):
    options = OPTIONS[name]
    direct = Coupled(kind, cell, **options)
    direct.problem.solve()
    split = Coupled(kind, cell, petsc_options={"pc_type": "condensed"}, **options)
    split.problem.solve()
    report = split.problem.report
    assert report.krylov > 0
    assert report.uncondensed == []
    # On so few nodes errors of a solve decide on one that touches
    assert report.iterations <= direct.problem.report.iterations + 3
    for a, b in zip(split.functions, direct.functions, strict=True):
        size = np.abs(b.x.array).max()
        assert np.abs(a.x.array - b.x.array).max() < 1e-9 * size
    assert split.contact.force == pytest.approx(direct.contact.force, rel=1e-9)


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_heat_is_split_from_condensed_displacements(unit):
    answers = []
    for pc in ("lu", "condensed"):
        F, u, T, heat, hold, contact = thermal()
        F[1] = unit * F[1]
        bcs = heat + hold
        options = {"pc_type": pc}
        problem = make_problem(F, [u, T], [contact], bcs, displacement=0, petsc_options=options)
        problem.solve()
        assert problem.report.uncondensed == []
        answers.append((problem.report.iterations, u.x.array, T.x.array))
    (one, u, T), (other, w, S) = answers
    assert abs(one - other) <= 1
    assert np.abs(u - w).max() < 1e-9 * np.abs(u).max()
    assert np.abs(T - S).max() < 1e-9 * np.abs(T).max()
