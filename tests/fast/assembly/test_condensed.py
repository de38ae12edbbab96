# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The condensed solver against a dense solution of the whole Jacobian, and however rough it is."""

from types import SimpleNamespace

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest
import stacked_blocks

import contactx as cx
import ufl
from contactx import cpp as core
from contactx._host.algebra import Algebra, Hierarchy
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import scenes
from meshes import Tag
from scenes import CELLS, Blocks, hertz_sphere
from scenes.closed import close_all
from scenes.covering import METHODS, covering
from scenes.tuning import tuned
from story import traction

MORTAR = {"method": "surface-to-surface"}
LAWS = [{}, {"friction": 0.3}, {"tied": True}]
LAWS += [MORTAR, {"friction": 0.3, **MORTAR}, {"tied": True, **MORTAR}]


def soften(problem, contact, ratio):
    """Give sticking nodes, and those without friction, springs.

    Args:
        ratio: Stiffnesses of a node over the bulk's diagonal: normal and tangential.
    """
    nodes, bulk = contact.discrete.nodes, problem.assembler.bulk
    bulk.update()
    diagonal = np.median(bulk.diagonal())
    laws = nodes.by_multiplier.reshape(-1, nodes.size, nodes.size)
    for i in np.flatnonzero(nodes.closed):
        compliance = nodes.area[i] ** 2 * nodes.c[i] / (diagonal * np.asarray(ratio()))
        if nodes.size == 1:
            laws[i] = compliance[0]
        elif nodes.status[i] == 1:
            n = nodes.normal[i]
            along = np.outer(n, n)
            laws[i] = compliance[0] * along + compliance[1] * (np.eye(len(n)) - along)


@pytest.mark.parametrize("stiffness", [1.0, 0.01])
@pytest.mark.parametrize("law", [{}, {"tied": True}, MORTAR, {"tied": True, **MORTAR}])
def test_multigrid_does_not_feel_the_stiffness_of_soft_nodes(law, stiffness):
    """As many Krylov iterations as without springs, on masters that yield."""
    scene = Blocks(CellType.hexahedron, n_upper=6, n_lower=5, stiffness=stiffness)
    contact = scene.contact("small", **law)
    problem = scene.problem(contact, petsc_options={"pc_type": "condensed"})
    nodes = close_all(contact)
    rng = np.random.default_rng(5)
    system = problem.assembler.system
    b = rng.standard_normal(system.x.getSize())
    b[: system.num_bulk][problem.assembler.bulk.markers == 1] = 0
    counts = []

    def solve(solver):
        result, before = np.empty_like(b), solver.statistics().iterations
        solver.solve(b, result)
        statistics = solver.statistics()
        assert not statistics.direct and not statistics.by_bodies
        counts.append(statistics.iterations - before)

    def create():
        algebra = Algebra(problem.assembler.bulk, system, "soft_")
        return core.CondensedSolver(problem.assembler.core, algebra)

    solve(create())
    for exponent in (-2, 1, 4, 8):
        soften(problem, contact, lambda exponent=exponent: [10.0**exponent] * 2)
        solve(create())
        soften(problem, contact, lambda exponent=exponent: [10.0**exponent, 0.1])
        solve(create())
    soften(problem, contact, lambda: 10 ** rng.uniform(-2, 8, 2))
    solve(create())
    # Coarser levels forget the springs
    solver = create()
    soften(problem, contact, lambda: [1e-2, 1e-2])
    solve(solver)
    contact.discrete.law.evaluate(nodes)
    solve(solver)
    assert max(counts) <= 1.3 * counts[0], counts


def both(create):
    """Solve with the direct and the condensed solver."""
    answers = []
    for solver in ("lu", "condensed"):
        problem, contacts = create(solver)
        problem.solve()
        multipliers = np.concatenate([c.multiplier.ravel() for c in contacts])
        answers.append((problem.u.x.array.copy(), multipliers, problem.report))
    return answers


def assert_same(direct, condensed):
    for a, b in zip(direct[:2], condensed[:2], strict=True):
        assert np.abs(a - b).max() <= 1e-9 * np.abs(a).max()
    assert condensed[2].iterations <= direct[2].iterations + 4
    assert condensed[2].krylov > 0
    assert "Krylov iterations" in str(condensed[2])


@covering(cell=CELLS, law=LAWS, gap=(0.0, 0.02))
def test_blocks_pushed_aside(cell, law, gap):
    def create(solver):
        scene = Blocks(cell, gap=gap, n_upper=4, n_lower=3)
        scene.bcs[-2].g.value[...] = 0.02
        contact = scene.contact(**law)
        return scene.problem(contact, petsc_options={"pc_type": solver}), [contact]

    direct, condensed = both(create)
    assert_same(direct, condensed)
    assert not condensed[2].uncondensed


def test_a_status_that_comes_back_is_reported():
    """And the direct solver's answer is found nevertheless."""

    def create(solver):
        scene = Blocks(CellType.tetrahedron, gap=0.02, n_upper=4, n_lower=3)
        scene.bcs[-2].g.value[...] = 0.02
        contact = scene.contact(friction=0.3)
        return scene.problem(contact, petsc_options={"pc_type": solver}), [contact]

    direct, condensed = both(create)
    assert_same(direct, condensed)
    for *_, report in (direct, condensed):
        assert report.cycles == 1
        assert "the status came back 1 times" in str(report)


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_sphere(sliding):
    """Slave nodes on planes of symmetry keep an equation for their pressure."""
    answers = []
    for solver in ("lu", "condensed"):
        problem, contact = hertz_sphere(0.04, sliding, petsc_options={"pc_type": solver})
        problem.solve()
        answers.append((problem.u.x.array, contact.multiplier, problem.report))
    assert_same(*answers)
    assert not answers[1][2].uncondensed
    again = answers[1][2].krylov
    assert 0 < again < 200


def test_friction_on_planes_of_symmetry():
    """What a plane of symmetry takes from a slave node's traction is not the bulk's to give."""

    def create(solver):
        problem, contact = hertz_sphere(
            0.04, "finite", friction=0.3, petsc_options={"pc_type": solver}
        )
        return problem, [contact]

    direct, condensed = both(create)
    assert_same(direct, condensed)
    assert not condensed[2].uncondensed


@pytest.fixture
def report_of_a_corner():
    """Report of a scene whose edge nodes are slave on the floor and at the wall."""
    scene = Blocks(CellType.tetrahedron, n_upper=3)
    u, tags = scene.u, scene.tags
    scene.bcs = scene.bcs[:3]
    for face, axis in ((Tag.UPPER_TOP, 2), (Tag.UPPER_X1, 0)):
        load = fem.Constant(u.function_space.mesh, -0.01 * np.eye(3)[axis])
        scene.F += traction(u, tags, face, load)
    foot, side = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.UPPER_X0)
    planes = [(foot, np.zeros(3), np.eye(3)[2]), (side, 0.23 * np.eye(3)[0], np.eye(3)[0])]
    contacts = [cx.Contact(face, cx.Plane(point, n), friction=0.3) for face, point, n in planes]
    problem = scene.problem(*contacts, petsc_options={"pc_type": "condensed"})
    problem.solve()
    return problem.report


def test_nodes_of_two_closed_contacts_are_solved_directly(report_of_a_corner):
    """The report says what was not condensed, and why."""
    reasons = report_of_a_corner.uncondensed
    assert len(reasons) > 0
    assert set(reasons) == {"a node is slave in several contacts that are closed"}
    assert f"solved directly {len(reasons)} times" in str(report_of_a_corner)


@pytest.mark.parametrize(("dim", "shear"), [(2, 0.0025), (3, 0.001)])
def test_five_free_blocks(dim, shear, monkeypatch):
    """Bodies that contact alone holds, each slave below and master above."""
    monkeypatch.setattr(stacked_blocks, "FRICTION", 0.3)
    monkeypatch.setattr(stacked_blocks, "INTERFERENCE", 0.0)

    def create(solver):
        problem, contacts, load = stacked_blocks.create(
            0.25, "finite", dim, petsc_options={"pc_type": solver}
        )
        load.value[0], load.value[-1] = shear, -0.01
        return problem, contacts

    assert_same(*both(create))


def test_a_bulk_that_is_not_symmetric():
    """GMRES takes its place, and the answer is that of the direct solver."""

    def create(solver):
        scene = Blocks(CellType.hexahedron, n_upper=4, n_lower=3)
        v = ufl.TestFunction(scene.u.function_space)
        wind = ufl.as_vector((0.3, 0.0, 0.1))
        scene.F += ufl.inner(ufl.dot(ufl.grad(scene.u), wind), v) * ufl.dx
        contact = scene.contact("small")
        return scene.problem(contact, petsc_options={"pc_type": solver}), [contact]

    direct, condensed = both(create)
    assert_same(direct, condensed)
    assert not condensed[2].uncondensed


@pytest.mark.parametrize("sliding", ["finite", "small"])
def test_what_a_scene_does_not_need_is_reported(sliding):
    scene = Blocks(CellType.tetrahedron, gap=0.02, n_upper=4, n_lower=3)
    contact = scene.contact(sliding)
    problem = scene.problem(contact, petsc_options={"pc_type": "condensed"})
    problem.solve()
    report = problem.report
    assert report.hierarchies == 1
    assert report.skipped["hierarchy"] == report.iterations - 1
    assert (report.skipped["search"] > report.iterations) == (sliding == "small")
    assert f"hierarchy {report.iterations - 1}x" in str(report).replace("\n", " ")
    scene.bcs[-1].g.value[...] *= 1.001
    problem.solve()
    assert problem.report.hierarchies == 0


def test_factors_serve_several_solves(report_of_a_corner):
    """Where nothing can be condensed, few rows change from one Jacobian to the next."""
    report = report_of_a_corner
    assert 0 < report.factorisations < len(report.uncondensed)
    again = len(report.uncondensed) - report.factorisations
    assert report.skipped["factorisation"] == again
    assert f"factorisation {again}x" in str(report).replace("\n", " ")


def test_another_preconditioner_is_refused():
    """At every solve, not only at the first."""
    scene = Blocks(CellType.tetrahedron)
    options = {"pc_type": "condensed", "condensed_pc_type": "lu"}
    problem = scene.problem(scene.contact(), petsc_options=options)
    for _ in range(2):
        with pytest.raises(ValueError, match=r"condensed_pc_type.*set pc_type to lu"):
            problem.solve()


def updates_of_coarse_levels(monkeypatch):
    """A list that grows with each."""
    updates, update = [], Hierarchy.update

    def counted(self):
        updates.append(1)
        update(self)

    monkeypatch.setattr(Hierarchy, "update", counted)
    return updates


def test_coarse_levels_are_kept_while_the_same_nodes_touch(monkeypatch):
    updates = updates_of_coarse_levels(monkeypatch)
    scene = Blocks(CellType.tetrahedron, n_upper=4, n_lower=3)
    problem = scene.problem(scene.contact(), petsc_options={"pc_type": "condensed"})
    for down, wanted in ((0.03, 1), (0.04, 0)):
        scene.bcs[-1].g.value[...] = -down
        updates.clear()
        problem.solve()
        assert problem.report.iterations >= 3
        assert len(updates) == wanted


def test_coarse_levels_are_kept_while_few_nodes_open(monkeypatch):
    """For the same solution and iterates, at few more Krylov iterations."""
    updates = updates_of_coarse_levels(monkeypatch)
    found = []
    for max_change in (0.0, 0.15):
        with tuned(max_change=max_change):
            scene = scenes.HertzSphere(
                meshes.hertz_sphere(0.012), "finite", petsc_options={"pc_type": "condensed"}
            )
        updates.clear()
        scene.problem.solve()
        report = scene.problem.report
        found.append((len(updates), report.iterations, report.krylov, scene.contact.force[2]))
    often, seldom = found
    changing = sum(row.status_changes > 0 for row in report.history)
    assert often[0] == changing > seldom[0] + 2
    assert seldom[1] == often[1]
    assert seldom[2] <= 1.1 * often[2]
    assert seldom[3] == pytest.approx(often[3], rel=1e-10)


@pytest.mark.parametrize("is_slow", [True, False])
def test_multigrid_is_asked_for_a_digit_where_bodies_differ(is_slow, monkeypatch):
    """Before the rest, as bodies make blocks of their own where it is slow."""
    asked, cycles = [], Hierarchy.solve

    def solve(self, b, x, is_symmetric, target, most):
        asked.append(target / np.linalg.norm(b))
        if is_slow:
            return most, core.End.FAILED
        return cycles(self, b, x, is_symmetric, target, most)

    monkeypatch.setattr(Hierarchy, "solve", solve)
    scene = Blocks(CellType.tetrahedron, n_upper=4, n_lower=3, stiffness=1e3)
    problem = scene.problem(scene.contact(), petsc_options={"pc_type": "condensed"})
    problem.solve()
    assert asked[0] == pytest.approx(0.1)
    assert len(asked) == (1 if is_slow else 1 + problem.report.iterations)
    assert ("multigrid is slow here" in problem.report.by_bodies) == is_slow


@pytest.mark.parametrize("method", METHODS)
def test_no_eigenvalue_is_large_where_nodes_stick(method, monkeypatch):
    """Coarse levels must not make residuals of eliminated displacements: up to 4.7 else."""
    largest, make, solve = [], Hierarchy.__init__, Hierarchy.solve

    def made(self, *args):
        make(self, *args)
        # Heard of by a solver that is set up after it
        self._ksp.setType("preonly")
        self._ksp.setComputeEigenvalues(True)

    def watched(self, *args):
        result = solve(self, *args)
        largest.append(np.abs(self._ksp.computeEigenvalues()).max())
        return result

    monkeypatch.setattr(Hierarchy, "__init__", made)
    monkeypatch.setattr(Hierarchy, "solve", watched)
    scene = scenes.HertzSphere(
        meshes.hertz_sphere(0.02), "finite", friction=0.6, method=method,
        petsc_options={"pc_type": "condensed"},
    )  # fmt: skip
    scene.problem.solve()
    assert (scene.contact.discrete.nodes.status == core.STICK).sum() > 20
    assert max(largest) < 1.1


def test_the_same_bits_wherever_vectors_lie():
    """PETSc's products of vectors at once depend on where in memory they are, if it may choose."""
    found = set()
    gaps = []
    for run in range(10):
        lengths = np.random.default_rng(run).integers(1, 3000, 50)
        gaps.append([np.empty(length) for length in lengths])
        scene = Blocks(CellType.hexahedron, n_upper=3, n_lower=4)
        contact = scene.contact(friction=scene.scalar(0.3))
        problem = scene.problem(contact, petsc_options={"pc_type": "condensed"})
        scene.bcs[-2].g.value[...] = 0.02
        problem.solve()
        found.add(scene.u.x.array.tobytes())
    assert len(found) == 1


def test_factors_of_a_pattern_that_is_not_that_of_a_diagonal():
    """PETSc's factors of such a matrix were made of what memory held, or ended the process."""
    columns = [(0, 1, 2), (0, 1, 2), range(6), (2, 3, 6), (2, 4, 6), (2, 5, 6), range(3, 9)]
    columns += [(6, 7, 8), (6, 7, 8)]
    rows = np.repeat(np.arange(9), list(map(len, columns)))
    places = np.concatenate([rows, np.arange(9)]), np.concatenate([*columns, np.arange(9)])
    rng = np.random.default_rng(0)
    algebra = Algebra(SimpleNamespace(comm=MPI.COMM_SELF), None, "factors_")
    for _ in range(300):
        values = np.r_[0.1 * rng.uniform(-1, 1, len(rows)), np.ones(9)]
        A = algebra.matrix(9, 9, *places, values)
        dense = A.convert("dense", PETSc.Mat()).getDenseArray()
        factors = algebra.factorise(A, "chains", False, 1, False)
        assert factors.is_good
        b = rng.standard_normal(9)
        x = np.empty(9)
        factors.solve(b, x, False)
        np.testing.assert_allclose(dense @ x, b, atol=1e-12)
        factors.solve(b, x, True)
        np.testing.assert_allclose(dense.T @ x, b, atol=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_hertz_with_friction(method):
    """Exact solves, solves that are as rough as the loop asks for, and far more accurate ones."""
    data = meshes.hertz_sphere(0.05)
    answers, krylov = [], []
    for solver, part in (("lu", 1.0), ("condensed", 1.0), ("condensed", 1e-3)):
        with tuned(roughness=part):
            scene = scenes.HertzSphere(
                data, "finite", method=method, friction=0.3,
                petsc_options={"pc_type": solver},
            )  # fmt: skip
        scene.problem.solve()
        answers.append((scene.problem.u.x.array, scene.contact.multiplier))
        krylov.append(scene.problem.report.krylov)
    assert krylov[1] < 0.9 * krylov[2]
    for other in answers[1:]:
        for found, exact in zip(other, answers[0], strict=True):
            assert np.abs(found - exact).max() < 1e-8 * np.abs(exact).max()
