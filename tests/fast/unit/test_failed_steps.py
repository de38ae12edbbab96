# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Failed and interrupted steps, and the life of a problem's solver."""

import gc
import weakref

from petsc4py import PETSc

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from scenes.covering import METHODS, covering
from scenes.steps import Sheared

pytestmark = pytest.mark.usefixtures("method")


def test_no_convergence_leaves_everything_as_it_was(method):
    most = 4 if method == "node-to-surface" else 3
    scene = Blocks(CellType.tetrahedron, down=0.01)
    contact = scene.contact()
    problem = scene.problem(contact, petsc_options={"snes_max_it": most})
    problem.solve()
    before = [
        scene.u.x.array.copy(),
        contact.multiplier.copy(),
        contact.discrete.nodes.status.copy(),
        contact.discrete.nodes.gap.copy(),
        contact.pressure.x.array.copy(),
        contact.force.copy(),
    ]
    scene.bcs[-1].g.value[...] = -0.5
    with pytest.raises(cx.ConvergenceError, match="no convergence in snes_max_it") as info:
        problem.solve()
    assert "residual" in str(info.value)
    assert info.value.report is problem.report
    assert info.value.reason == problem.report.reason
    assert not problem.report.converged
    assert problem.report.iterations == most
    after = [
        scene.u.x.array,
        contact.multiplier,
        contact.discrete.nodes.status,
        contact.discrete.nodes.gap,
        contact.pressure.x.array,
        contact.force,
    ]
    for a, b in zip(before, after, strict=True):
        assert np.array_equal(a, b)

    # And the problem goes on from there
    scene.bcs[-1].g.value[...] = -0.011
    problem.solve()
    assert problem.report.converged


def test_a_body_that_is_pulled_away_says_so():
    scene = Blocks(CellType.tetrahedron)
    scene.bcs = scene.bcs[:3]
    v = ufl.TestFunction(scene.u.function_space)
    top = ufl.Measure("ds", scene.u.function_space.mesh, subdomain_data=scene.tags)(Tag.UPPER_TOP)
    scene.F -= 0.1 * v[2] * top
    problem = scene.problem(scene.contact())
    with pytest.raises(cx.ConvergenceError):
        problem.solve()
    assert not scene.u.x.array.any()


@covering(part=("residual", "jacobian", "unpack"), call=(1, 3), method=METHODS)
def test_an_interrupt_anywhere_leaves_everything_as_it_was(monkeypatch, part, call):
    scene = Blocks(CellType.tetrahedron)
    contact = scene.contact()
    problem = scene.problem(contact)
    system, calls = problem.assembler.system, []
    real = getattr(system, part)

    def interrupted(*args, **options):
        calls.append(part)
        if len(calls) == call:
            raise KeyboardInterrupt
        return real(*args, **options)

    monkeypatch.setattr(system, part, interrupted)
    with pytest.raises(KeyboardInterrupt):
        problem.solve()
    assert not scene.u.x.array.any()
    assert not contact.multiplier.any()
    problem.solve()
    assert problem.report.converged
    other = Blocks(CellType.tetrahedron)
    same = other.contact()
    other.problem(same).solve()
    assert contact.force == pytest.approx(same.force, rel=1e-12, abs=1e-15)


def test_a_failed_step_brings_the_pairs_back():
    """Pairs that the failed iterates made are gone: the next step is as if it had not been."""
    scene = Blocks(CellType.quadrilateral, n_upper=6, n_lower=9)
    contact = scene.contact()
    problem = scene.problem(contact, petsc_options={"snes_max_it": 6})
    problem.solve()
    nodes = [pairs.nodes.copy() for pairs in contact.discrete.master.pairs()]
    data = [pairs.data.copy() for pairs in contact.discrete.master.pairs()]
    scene.bcs[0].g.value[...] = 0.4
    scene.bcs[-1].g.value[...] = -0.9
    with pytest.raises(cx.ConvergenceError):
        problem.solve()
    for pairs, before, values in zip(contact.discrete.master.pairs(), nodes, data, strict=True):
        assert np.array_equal(pairs.nodes, before)
        assert np.array_equal(pairs.data, values)


def test_a_failed_step_brings_back_which_nodes_can_yield():
    """On a plane that has turned upright none can: they are fixed sideways."""
    scene = Sheared()
    scene.update(0.1)
    scene.problem.solve()
    before = scene.state()
    assert not scene.contact.discrete.nodes.immobile.any()
    scene.normal.value[:] = (1, 0)
    scene.update(300.0)
    with pytest.raises(cx.ConvergenceError):
        scene.problem.solve()
    assert scene.state() == before


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("pc", ["lu", "condensed"])
def test_problems_are_freed(pc, friction):
    """With all that has vectors of PETSc and communicators, of which there are not many."""
    scene = Blocks(CellType.triangle)
    problem = scene.problem(scene.contact(friction=friction), petsc_options={"pc_type": pc})
    problem.solve()
    assembler = problem.assembler
    parts = (assembler, assembler.system, assembler.discrete_contacts[0], assembler.halo)
    seen = [weakref.ref(part) for part in parts]
    del problem, assembler, parts
    gc.collect()
    assert [part() for part in seen] == [None] * len(seen)


def test_another_kind_of_snes_does_not_pass_for_convergence():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(scene.contact(), petsc_options={"snes_type": "ksponly"})
    with pytest.raises(cx.ConvergenceError, match="SNES stopped by itself, with reason"):
        problem.solve()


def test_options_of_the_command_line_go_before_defaults_and_stay():
    scene = Blocks(CellType.triangle)
    database = PETSc.Options()
    database["blocks_ksp_type"] = "gmres"
    try:
        problem = scene.problem(scene.contact())
        problem.solve()
        assert problem.solver.getKSP().getType() == "gmres"
        assert database["blocks_ksp_type"] == "gmres"
        assert not database.hasName("blocks_pc_type")
    finally:
        del database["blocks_ksp_type"]


@pytest.mark.parametrize("solver", [None, "superlu_dist"])
def test_other_direct_solvers(monkeypatch, solver):
    scene, reference = Blocks(CellType.hexahedron), Blocks(CellType.hexahedron)
    contact = scene.contact()
    with monkeypatch.context() as patch:
        patch.setattr(cx.compat, "direct_solver", lambda: solver)
        scene.problem(contact).solve()
    other = reference.contact()
    reference.problem(other).solve()
    assert contact.force == pytest.approx(other.force, rel=1e-9, abs=1e-12)


def test_a_refused_problem_frees_its_contacts():
    scene = Blocks(CellType.tetrahedron)
    good = scene.contact()
    bad = cx.Contact(
        cx.Surface(scene.tags, Tag.UPPER_CONTACT), cx.Surface(scene.tags, Tag.UPPER_X0)
    )
    with pytest.raises(ValueError, match="faces away"):
        scene.problem(good, bad)
    scene.problem(good).solve()
    assert good.force[2] > 0


def test_user_options_reach_petsc():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(
        scene.contact(), petsc_options={"snes_rtol": 1e-6, "snes_max_it": 33, "ksp_type": "gmres"}
    )
    problem.solve()
    rtol, _, _, max_it = problem.solver.getTolerances()
    assert (rtol, max_it) == (1e-6, 33)
    assert problem.solver.getKSP().getType() == "gmres"
