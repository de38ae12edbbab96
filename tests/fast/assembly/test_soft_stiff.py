# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The block preconditioner of bodies: factors of soft bodies and of stiff ones."""

import numpy as np
import pytest

from contactx._host import compat
from contactx._host.condensed import soft_stiff, solver
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import CELLS, Blocks, blocks
from scenes.covering import covering
from story import fix

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
    monkeypatch.setattr(soft_stiff, "_MAX_ITERATIONS_WITH_SPRINGS", 0)
    made = []
    of = soft_stiff.CoarseModel.of
    monkeypatch.setattr(
        soft_stiff.CoarseModel, "of", lambda *args: made.append(of(*args)) or made[-1]
    )
    return made


@covering(cell=CELLS, law=LAWS, sliding=("finite", "small"))
def test_a_coarse_model_has_the_same_answer(cell, law, sliding, with_model):
    direct, found = both(dragged(cell, 1e4, sliding, **law))
    assert with_model and with_model[0] is not None
    for a, b in zip(direct[:2], found[:2], strict=True):
        assert np.abs(a - b).max() <= 1e-8 * np.abs(a).max()
    assert not any(report.uncondensed for report in found[2])


def test_no_solve_is_finer_than_an_iterate_needs(monkeypatch):
    """However soft the softest body is."""
    parts = []
    solve = solver.CondensedSolver._solve_condensed

    def note(self, operator, rhs, v, target):
        if not self.is_last:
            parts.append((target / rhs.norm(), self.target / rhs.norm()))
        return solve(self, operator, rhs, v, target)

    monkeypatch.setattr(solver.CondensedSolver, "_solve_condensed", note)
    monkeypatch.setattr(solver.CondensedOperator, "softness", lambda *args: 1e-9)
    both(dragged(CellType.hexahedron, 1e4, "small", friction=0.3))
    for part, asked in parts:
        assert part >= min(asked, 0.999e-11)
    assert any(part == pytest.approx(1e-11) for part, _ in parts)


def test_factors_serve_where_nothing_changes():
    _, found = both(dragged(CellType.hexahedron, 1e4, "small", tied=True))
    assert [report.factorisations for report in found[2]] == [2, 0, 0]


@pytest.mark.skipif(compat.direct_solver() != "mumps", reason="an option of MUMPS")
@pytest.mark.parametrize("is_held", [False, True])
def test_nodes_are_ordered_as_groups(is_held, monkeypatch):
    """Not where a node is partly in a block."""
    groups = []
    factorised = soft_stiff._factorised

    def note(*args):
        ksp = factorised(*args)
        groups.append((args[-1], -ksp.getPC().getFactorMatrix().getMumpsIcntl(15)))
        return ksp

    monkeypatch.setattr(soft_stiff, "_factorised", note)

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
