# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The block preconditioner of bodies, extrapolation of a first solution, and direct solvers."""

from petsc4py import PETSc

import numpy as np
import pytest

from contactx._host import compat
from contactx._host.algebra import Algebra, Hierarchy
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import CELLS, NU, Blocks, blocks
from scenes.covering import METHODS, covering
from scenes.driven import DrivenBlock
from scenes.problems import make_problem, pair_of
from scenes.refilled import LARGEST, sizes
from scenes.tuning import tuned
from story import displacement, elasticity, fix, traction

MORTAR = {"method": "surface-to-surface"}
LAWS = [{}, {"friction": 0.3}, {"tied": True}]
LAWS += [MORTAR, {"friction": 0.3, **MORTAR}, {"tied": True, **MORTAR}]
BY_BODIES = {"pc_type": "condensed", "condensed_pc_type": "bodies"}
HELD = "a slave node with a prescribed displacement moves its master"


def both(create, options=BY_BODIES):
    """Solve directly and by blocks: displacements, multipliers, reports of all steps."""
    answers = []
    for chosen in ({"pc_type": "lu"}, options):
        problem, contact, move = create(chosen)
        reports = []
        for k in range(3):
            move(k)
            problem.solve()
            reports.append(problem.report)
        answers.append((problem.u.x.array.copy(), contact.multiplier.ravel().copy(), reports))
    return answers


def assert_same(direct, found, tolerance=1e-8):
    for a, b in zip(direct[:2], found[:2], strict=True):
        assert np.abs(a - b).max() <= tolerance * np.abs(a).max()
    for report in found[2]:
        assert not report.uncondensed
        assert report.hierarchies == 0
        assert len(report.by_bodies) == report.iterations


def dragged(cell, stiffness, sliding="finite", **law):
    def create(options):
        scene = Blocks(cell, n_upper=3, n_lower=4, stiffness=stiffness)
        push = fix(scene.u, scene.tags, 0, 0.0, Tag.UPPER_TOP)
        scene.bcs.append(push)
        contact = scene.contact(sliding, **law)

        def move(k):
            push.g.value[...] = 0.03 * k

        return scene.problem(contact, petsc_options=options), contact, move

    return create


@covering(cell=CELLS, law=LAWS, stiffness=(1.0, 1e4), sliding=("finite", "small"))
def test_the_answer_is_that_of_the_direct_solver(cell, law, stiffness, sliding):
    """Bodies that are alike make one block, others two."""
    direct, found = both(dragged(cell, stiffness, sliding, **law))
    assert_same(direct, found)
    text = str(found[2][0]).replace("\n", " ")
    assert "solved with blocks of bodies" in text
    assert "condensed_pc_type asks for it" in text


def test_a_stiff_slave_on_a_soft_master_is_one_block():
    direct, found = both(dragged(CellType.hexahedron, 1e-4, friction=0.3))
    assert_same(direct, found, 1e-7)


def test_stiff_masters_cost_few_iterations():
    """The springs stand for the soft body: few iterations, however much softer it is."""
    counts = []
    for stiffness in (1e2, 1e4, 1e6):
        _, found = both(dragged(CellType.hexahedron, stiffness, "small", tied=True))
        counts.append(found[2][0].krylov / found[2][0].iterations)
    assert max(counts) <= 12


@pytest.fixture
def with_model(monkeypatch):
    """Take the coarse model of soft bodies at once."""
    made = []
    aggregate = Algebra.aggregate
    monkeypatch.setattr(
        Algebra, "aggregate", lambda *args: made.append(aggregate(*args)) or made[-1]
    )
    with tuned(max_iterations=0):
        yield made


@covering(cell=CELLS, law=LAWS, sliding=("finite", "small"))
def test_a_coarse_model_has_the_same_answer(cell, law, sliding, with_model):
    direct, found = both(dragged(cell, 1e4, sliding, **law))
    assert with_model and with_model[0] is not None
    for a, b in zip(direct[:2], found[:2], strict=True):
        assert np.abs(a - b).max() <= 1e-8 * np.abs(a).max()
    assert not any(report.uncondensed for report in found[2])


def test_the_softest_body_decides_how_fine_a_solve_is(monkeypatch):
    """The residual of the stiff one is far larger; rounding bounds what is asked for."""
    found = []
    solve = Hierarchy.solve

    def note(self, b, x, is_symmetric, target, most):
        iterations = solve(self, b, x, is_symmetric, target, most)
        found.append((target / np.linalg.norm(b), iterations[0]))
        return iterations

    monkeypatch.setattr(Hierarchy, "solve", note)
    firsts = []
    for stiffness in (1e-6, 1e-9):
        scene = Blocks(CellType.hexahedron, n_upper=3, n_lower=4, stiffness=stiffness)
        options = {"pc_type": "condensed", "snes_rtol": 1e-6}
        found.clear()
        scene.problem(scene.contact("small"), petsc_options=options).solve()
        firsts.append(found[0])
    assert firsts[1][0] < 1e-2 * firsts[0][0] < 1e-9
    assert firsts[1][1] <= firsts[0][1] + 5


def test_factors_serve_where_nothing_changes():
    _, found = both(dragged(CellType.hexahedron, 1e4, "small", tied=True))
    assert [report.factorisations for report in found[2]] == [2, 0, 0]


@pytest.mark.skipif(compat.direct_solver() != "mumps", reason="an option of MUMPS")
@pytest.mark.parametrize("is_held", [False, True])
def test_nodes_are_ordered_as_groups(is_held, monkeypatch):
    """Not where a node is partly in a block."""
    groups = []
    factorise = Algebra.factorise

    def note(self, A, name, is_symmetric, group, is_rough):
        factors = factorise(self, A, name, is_symmetric, group, is_rough)
        mumps = factors._ksp.getPC().getFactorMatrix()
        groups.append((group, -mumps.getMumpsIcntl(15)))
        return factors

    monkeypatch.setattr(Algebra, "factorise", note)

    def create(options):
        scene = Blocks(CellType.hexahedron, n_upper=3, n_lower=4, gap=1e-9, stiffness=1e4)
        if is_held:
            scene.bcs.append(fix(scene.u, scene.tags, 0, 0.0, Tag.UPPER_CONTACT))
        contact = scene.contact(friction=0.3)
        return scene.problem(contact, petsc_options=options), contact, lambda k: None

    both(create)
    assert set(groups) == ({(3, 3), (1, 0)} if is_held else {(3, 3)})


@pytest.mark.parametrize("stiffness", [1.0, 1e3])
@pytest.mark.parametrize("cell", CELLS)
def test_constrained_slave_nodes_hold_their_masters(cell, stiffness):
    """Their multipliers stay unknowns."""

    def create(options):
        scene = Blocks(cell, gap=1e-9, stiffness=stiffness)
        contact = scene.contact(friction=0.3)
        axes = range(len(scene.u))
        scene.bcs += [fix(scene.u, scene.tags, i, -0.01 * i, Tag.UPPER_CONTACT) for i in axes]
        problem = scene.problem(contact, petsc_options=options)
        return problem, contact, lambda k: None

    direct, found = both(create, {"pc_type": "condensed"})
    for a, b in zip(direct[:2], found[:2], strict=True):
        assert np.abs(a - b).max() <= 1e-8 * np.abs(a).max()
    assert HELD in found[2][0].by_bodies
    # An iterate may hold a node by nothing that moves
    assert len(found[2][0].uncondensed) <= 1


@covering(cell=(CellType.tetrahedron, CellType.hexahedron), method=METHODS, unit=(1.0, 1e9))
def test_multigrid_serves_where_an_edge_is_pushed(cell, method, unit, monkeypatch):
    """A few multipliers of its edge stay unknowns, in units of the stiffness that they hold."""
    monkeypatch.setattr(blocks, "elasticity", lambda u, young, nu: elasticity(u, unit * young, nu))

    def create(options):
        scene = Blocks(cell, n_upper=6, n_lower=7, gap=1e-9)
        contact = scene.contact(method=method, friction=0.3)
        push = fix(scene.u, scene.tags, 0, 0.0, Tag.UPPER_X0)
        scene.bcs.append(push)

        def move(k):
            push.g.value[...] = 0.001 * k

        return scene.problem(contact, petsc_options=options), contact, move

    direct, found = both(create, {"pc_type": "condensed"})
    for a, b in zip(direct[:2], found[:2], strict=True):
        assert np.abs(a - b).max() <= 1e-8 * np.abs(a).max()
    reports = found[2]
    assert not any(report.uncondensed for report in reports)
    # Near the last iterate of a step a solve may be slow in its first digit
    assert sum(len(report.by_bodies) for report in reports) <= 1
    assert sum(r.krylov for r in reports) <= 45 * sum(r.iterations for r in reports)


@pytest.mark.parametrize("stiffness", [1.0, 1e3])
def test_units_do_not_matter(stiffness, monkeypatch):
    """Newtons and metres, or meganewtons: as many iterations."""
    counts = []
    elasticity = blocks.elasticity
    for unit in (1.0, 1e6):
        monkeypatch.setattr(
            blocks, "elasticity", lambda u, young, nu, unit=unit: elasticity(u, unit * young, nu)
        )
        _, found = both(dragged(CellType.tetrahedron, stiffness, friction=0.3))
        counts.append([(r.iterations, r.krylov, r.factorisations) for r in found[2]])
    assert counts[0] == counts[1]


STEPS = 8


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


@pytest.mark.skipif(not PETSc.Sys.hasExternalPackage("superlu_dist"), reason="not in this PETSc")
@pytest.mark.parametrize("method", ["node-to-surface"], indirect=True)
def test_superlu_dist_goes_on_at_a_zero_pivot(monkeypatch, method):
    """It has no other rows to pivot with, and once said that the linear solver failed."""
    monkeypatch.setattr(compat, "direct_solver", lambda: "superlu_dist")
    scene = DrivenBlock(CellType.hexahedron, sliding="small", friction=0.3, n_upper=2, n_lower=3)
    scene.step(0, 0, -0.02)
    for k in range(1, 13):
        angle = np.pi / 6 * k
        scene.step(0.3 * (np.cos(angle) - 1), 0.3 * np.sin(angle), -0.02)
    assert scene.normal > 0


def test_a_matrix_without_factors_leaves_nothing_behind():
    """PETSc once raised that MUMPS was asked to solve without them, or had none ever after."""
    assert sizes([False, True, True, False]) == pytest.approx([LARGEST, np.inf, np.inf, LARGEST])
    assert sizes([True, True, False]) == pytest.approx([np.inf, np.inf, LARGEST])
