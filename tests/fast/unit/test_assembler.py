# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The assembler for Newton loops of one's own: its blocks, steps, forms, and its misuse."""

from petsc4py import PETSc

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import fem, la
from dolfinx.fem.petsc import assemble_matrix, create_vector
from dolfinx.mesh import CellType

from meshes import Tag
from scenes.blocks import Blocks
from scenes.coupled import Coupled
from scenes.driven import DrivenBlock
from scenes.problems import direct_solver
from story import METHODS, traction


def make(cell=CellType.triangle, **options):
    scene = Blocks(cell)
    contact = scene.contact(**options)
    return scene, contact, cx.ContactAssembler(scene.F, scene.u, contacts=[contact], bcs=scene.bcs)


def solve(assembler, stop=50):
    """Solve; or take some steps."""
    b, dx = assembler.create_vector(), assembler.create_vector()
    ksp = direct_solver()
    assembler.begin_step()
    while not assembler.settle().converged and stop > 0:
        stop -= 1
        assembler.residual(b)
        assembler.set_up(ksp)
        ksp.solve(-b, dx)
        assembler.update(dx, assembler.limit(dx))


def test_blocks_make_up_the_jacobian():
    _, _, assembler = make(friction=0.3)
    solve(assembler, 2)
    J = assembler.jacobian()
    blocks = assembler.blocks()
    n = assembler.u.x.array.size
    rows = [
        [blocks[name].convert("dense").getDenseArray() for name in pair] for pair in ("KB", "CD")
    ]
    whole = J.convert("dense").getDenseArray()
    np.testing.assert_array_equal(np.block(rows), whole)
    assert np.abs(whole[:n, n:]).max() > 0 < np.abs(whole[n:, :n]).max()


def test_blocks_of_a_solved_problem_leave_its_state_as_it_is():
    """Some nodes stick and some slip."""
    scene = DrivenBlock(CellType.quadrilateral, plane=cx.Plane((0, 0), (0, 1)), gap=0.01, n_upper=6)
    problem, contact = scene.problem, scene.problem.contacts[0]
    for place in ((0, -0.06), (0.05, -0.06)):
        scene.top.move(place)
        problem.solve()

    def state():
        fields = (problem.u, contact.slip, contact.slip_total, contact.status)
        return [f.x.array.copy() for f in fields] + [contact.multiplier.copy()]

    report, before = problem.report, state()
    assert set(contact.discrete.nodes.status) == {1, 2}
    blocks = problem.blocks()
    assert problem.report is report is problem.assembler.report
    for a, b in zip(state(), before, strict=True):
        np.testing.assert_array_equal(a, b)
    assembler = problem.assembler
    assembler.begin_step()
    assert assembler.settle().converged
    np.testing.assert_array_equal(contact.discrete.nodes.status, before[3][before[3] >= 0])
    for name, block in assembler.blocks().items():
        assert (block - blocks[name]).norm() == 0 < blocks["C"].norm()
    assembler.restore()
    scene.top.move((0.06, -0.06))
    with pytest.raises(RuntimeError, match="loads that were not solved for"):
        problem.blocks()
    problem.solve()


def test_the_jacobian_is_the_derivative_of_the_residual():
    _, _, assembler = make(CellType.tetrahedron, friction=0.3)
    solve(assembler, 2)
    assembler.settle()
    A = assembler.jacobian()
    rng = np.random.default_rng(5)
    dx = assembler.create_vector()
    dx.array[:] = rng.standard_normal(dx.getLocalSize())
    dx.array[: len(assembler.bulk.markers)][assembler.bulk.markers == 1] = 0
    b, product = assembler.create_vector(), assembler.create_vector()
    A.mult(dx, product)
    quotient = np.zeros(dx.getLocalSize())
    for sign in (1, -1):
        assembler.update(dx, sign * 1e-6)
        assembler.residual(b)
        quotient += sign * b.array_r / 2e-6
        assembler.update(dx, -sign * 1e-6)
    np.testing.assert_allclose(
        product.array_r, quotient, rtol=0, atol=1e-6 * np.abs(quotient).max()
    )


def test_what_settles_says_what_it_is():
    _, contact, assembler = make()
    assembler.begin_step()
    found = assembler.settle()
    assert (found.number, found.converged, found.failure) == (0, False, "")
    assert not assembler.converged
    solve(assembler)
    found = assembler.settle()
    assert found.converged
    assert assembler.converged
    assert found.residual <= found.tolerance
    assert found.tolerance >= 1e-11 * found.scale > 0
    assert found.closed == (contact.discrete.nodes.status != 0).sum()
    history = assembler.report.history
    assert [row.number for row in history[:-1]] == list(range(len(history) - 1))


def test_accepting_commits_history_and_restoring_takes_it_back():
    scene, contact, assembler = make(friction=0.3)
    solve(assembler)
    u, multiplier = scene.u.x.array.copy(), contact.multiplier.copy()
    assembler.accept()
    assert assembler.report.converged
    assert assembler.report.pairs > 0
    assert contact.force[-1] > 0
    assembler.begin_step()
    assembler.settle()
    step = assembler.create_vector()
    step.array[:] = 1e-3
    assembler.update(step)
    assert np.abs(scene.u.x.array - u).max() > 0
    assembler.restore()
    np.testing.assert_array_equal(scene.u.x.array, u)
    np.testing.assert_array_equal(contact.multiplier, multiplier)
    assembler.begin_step()
    assert assembler.settle().converged


def test_loads_may_change_between_calls():
    scene, _, assembler = make()
    assembler.begin_step()
    before = assembler.settle()
    b, c = assembler.create_vector(), assembler.create_vector()
    assembler.residual(b)
    scene.u.x.array[:] += 1e-3
    assembler.residual(c)
    assert np.abs(b.array_r - c.array_r).max() > 1e-6
    assert before.number == 0


def test_a_loop_without_end_is_ended():
    _, _, assembler = make()
    assembler.begin_step()
    nothing = assembler.create_vector()
    with pytest.raises(cx.ConvergenceError, match="no convergence in 3 iterations"):
        for _ in range(10):
            assembler.settle(max_it=3)
            assembler.update(nothing)
    assert len(assembler.report.history) == 4


@pytest.mark.parametrize(
    "call", ["settle", "residual", "jacobian", "set_up", "limit", "update", "accept"]
)
def test_nothing_works_before_a_step_begins(call):
    _, _, assembler = make()
    given = {
        "residual": assembler.create_vector(),
        "limit": assembler.create_vector(),
        "update": assembler.create_vector(),
        "set_up": direct_solver(),
    }
    arguments = [given[call]] if call in given else []
    with pytest.raises(RuntimeError, match=rf"{call}\(\) before begin_step\(\)"):
        getattr(assembler, call)(*arguments)


@pytest.mark.parametrize("call", ["set_up", "limit", "accept"])
def test_some_calls_want_an_iterate_that_has_settled(call):
    _, _, assembler = make()
    dx = assembler.create_vector()
    given = {"set_up": [direct_solver()], "limit": [dx], "accept": []}[call]
    assembler.begin_step()
    with pytest.raises(RuntimeError, match=rf"{call}\(\) before settle\(\)"):
        getattr(assembler, call)(*given)
    assembler.settle()
    assembler.update(dx)
    with pytest.raises(RuntimeError, match=rf"{call}\(\) before settle\(\)"):
        getattr(assembler, call)(*given)


def test_no_iterate_but_a_solution_is_accepted():
    _, _, assembler = make()
    assembler.begin_step()
    assert not assembler.settle().converged
    with pytest.raises(RuntimeError, match=r"go on until settle\(\) says converged"):
        assembler.accept()


def test_vectors_and_matrices_of_another_layout_are_refused():
    scene, _, assembler = make()
    assembler.begin_step()
    assembler.settle()
    bulk = create_vector(scene.u.function_space)
    for call in ("residual", "limit", "update"):
        with pytest.raises(ValueError, match=rf"{call}\(\) was given a Vec .*create_vector\(\)"):
            getattr(assembler, call)(bulk)
    n = scene.u.x.array.size
    with pytest.raises(ValueError, match=r"jacobian\(\) was given a Mat"):
        assembler.jacobian(PETSc.Mat().createAIJ((n, n)))
    size = assembler.x.getSizes()
    with pytest.raises(ValueError, match="not the matrix that jacobian"):
        assembler.jacobian(PETSc.Mat().createAIJ((size, size)))
    A = assembler.jacobian()
    assert assembler.jacobian(A).handle == A.handle


def test_a_snes_that_fails_takes_nothing_along():
    scene, contact, assembler = make()
    snes = PETSc.SNES().create(assembler.x.comm)
    snes.getKSP().setType("preonly")
    pc = snes.getKSP().getPC()
    pc.setType("lu")
    pc.setFactorSolverType("mumps")
    snes.setTolerances(rtol=1e-11, max_it=1)
    snes.getLineSearch().setType("basic")
    assembler.attach(snes)
    assembler.begin_step()
    snes.solve(None, assembler.x)
    with pytest.raises(cx.ConvergenceError, match="no convergence in snes_max_it iterations"):
        assembler.accept()
    assert not scene.u.x.array.any()
    assert not contact.multiplier.any()
    snes.setTolerances(max_it=50)
    assembler.begin_step()
    snes.solve(None, assembler.x)
    assembler.accept()
    assert contact.force[-1] > 0


def make_forms(cell=CellType.hexahedron, *, is_free=False, **options):
    """The upper block on the lower one, and on a floor; it may be free, under a load."""
    scene = Blocks(cell, gap=0.02)
    gdim = scene.u.function_space.mesh.geometry.dim
    if is_free:
        del scene.bcs[gdim:]
        down = fem.Constant(scene.u.function_space.mesh, -0.01 * np.eye(gdim)[-1])
        scene.F += traction(scene.u, scene.tags, Tag.UPPER_TOP, down)
    # Nothing holds a free one along the surface
    friction = 0.0 if is_free else 0.3
    contacts = [scene.contact(friction=friction, offset=0.05, **options)]
    floor = cx.Plane(point=[0.0] * gdim, normal=[0.0] * (gdim - 1) + [1.0])
    contacts.append(cx.Contact(cx.Surface(scene.tags, Tag.UPPER_CONTACT), floor, **options))
    assembler = cx.ContactAssembler(scene.F, scene.u, contacts=contacts, bcs=scene.bcs)
    J = fem.form(ufl.derivative(scene.F, scene.u))
    return scene, assembler, cx.Forms(assembler, J), J


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("cell", "is_free"),
    [(CellType.triangle, True), (CellType.triangle, False), (CellType.hexahedron, False)],
)
def test_the_system_is_that_of_the_assembler(cell, is_free, method):
    scene, assembler, forms, J = make_forms(cell, is_free=is_free, method=method)
    rng = np.random.default_rng(3)
    for bc in scene.bcs:
        bc.set(scene.u.x.array)
    assembler.begin_step()
    assembler.settle()
    x = assembler.x
    x.array[assembler.system.num_bulk :] += 0.01 * rng.standard_normal(
        x.getLocalSize() - assembler.system.num_bulk
    )
    forms.update(x)
    b, expected = assembler.create_vector(), assembler.create_vector()
    force = la.vector(J._cpp_object.function_spaces[0].dofmap.index_map, len(scene.u))
    fem.assemble_vector(force.array, fem.form(scene.F))
    for bc in scene.bcs:
        bc.set(force.array, scene.u.x.array, -1)
    b.array[: len(force.array)] = force.array
    forms.assemble_vector(b)
    assembler.residual(expected)
    assert (b - expected).norm() <= 1e-13 * expected.norm()
    A = forms.matrix()
    assemble_matrix(A, [[J]], bcs=scene.bcs)
    forms.assemble_matrix(A)
    assert (assembler.loop.free_bodies.springs is not None) == is_free
    # Columns of prescribed displacements stay in contact's part
    dx = x.duplicate()
    dx.array[:] = rng.standard_normal(x.getLocalSize())
    markers = assembler.bulk.markers
    dx.array[: len(markers)][markers == 1] = 0
    product, wanted = x.duplicate(), x.duplicate()
    A.mult(dx, product)
    assembler.jacobian().mult(dx, wanted)
    assert (product - wanted).norm() <= 1e-13 * wanted.norm() > 0
    blocks, others = forms.blocks(A), assembler.blocks()
    for name in "BCD":
        assert others[name].norm() > 0
    for name in "BD":
        assert (blocks[name] - others[name]).norm() <= 1e-13 * others[name].norm()


def test_the_matrix_of_other_pairs_is_another_one():
    scene, assembler, forms, _ = make_forms(CellType.triangle)
    assembler.begin_step()
    forms.settle(assembler.x)
    first = forms.matrix()
    forms.update(assembler.x)
    assert forms.matrix() is first
    scene.u.x.array[0::2] += 0.35 * (scene.u.function_space.tabulate_dof_coordinates()[:, 1] > 0)
    assembler.begin_step()
    forms.settle(assembler.x)
    with pytest.raises(ValueError, match="A is not the matrix of the pairs of now"):
        forms.assemble_matrix(first)
    assert forms.matrix() is not first


def test_misuse_of_forms():
    scene, assembler, forms, J = make_forms(CellType.triangle)
    with pytest.raises(RuntimeError, match=r"residual\(\) before begin_step\(\)"):
        forms.assemble_vector(assembler.x)
    assembler.begin_step()
    with pytest.raises(ValueError, match="was given a Vec of the sizes"):
        forms.assemble_vector(PETSc.Vec().createMPI(3))
    for wrong in (scene.F, fem.form(scene.F)):
        with pytest.raises(ValueError, match="J must be a compiled bilinear form"):
            cx.Forms(assembler, wrong)
    with pytest.raises(RuntimeError, match="has no results yet"):
        scene.contact().forms()
    coupled = Coupled("mixed").problem.assembler
    with pytest.raises(ValueError, match="Forms is for a displacement alone"):
        cx.Forms(coupled, J)
