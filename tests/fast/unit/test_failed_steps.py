# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Steps: failed and interrupted ones, reuse of what was assembled, loads, several contacts."""

import gc
import weakref

from petsc4py import PETSc

import numpy as np
import pytest

import contactx as cx
import ufl
from dolfinx import default_scalar_type, fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from scenes.steps import Sheared
from story import fix

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


def test_user_options_reach_petsc():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(
        scene.contact(), petsc_options={"snes_rtol": 1e-6, "snes_max_it": 33, "ksp_type": "gmres"}
    )
    problem.solve()
    rtol, _, _, max_it = problem.solver.getTolerances()
    assert (rtol, max_it) == (1e-6, 33)
    assert problem.solver.getKSP().getType() == "gmres"


def test_changed_loads_are_seen():
    scene = Blocks(CellType.tetrahedron, down=0.0, gap=0.01)
    load = fem.Constant(scene.u.function_space.mesh, default_scalar_type(0.02))
    v = ufl.TestFunction(scene.u.function_space)
    ds = ufl.Measure("ds", scene.u.function_space.mesh, subdomain_data=scene.tags)
    scene.bcs = scene.bcs[:5]
    scene.F += load * v[2] * ds(Tag.UPPER_TOP)
    scene.bcs.append(fix(scene.u, scene.tags, 2, 0.0, Tag.UPPER_X0, Tag.UPPER_X1))
    contact = scene.contact("small")
    problem = scene.problem(contact)
    problem.solve()
    first = scene.u.x.array.copy()
    load.value = 0.04
    problem.solve()
    assert problem.assembler.bulk.assemblies == 1
    assert np.abs(scene.u.x.array - first).max() > 0.1 * np.abs(first).max()


def test_constraints_without_free_displacements_stay_open():
    """Where the supports of both bodies meet a gap of zero leaves nothing to solve for."""
    scene = Blocks(CellType.quadrilateral, n_upper=4, n_lower=6, down=0.0)
    v = ufl.TestFunction(scene.u.function_space)
    scene.bcs = [fix(scene.u, scene.tags, i, 0.0, Tag.LOWER_BOTTOM, Tag.UPPER_X0) for i in range(2)]
    scene.bcs += [fix(scene.u, scene.tags, i, 0.0, Tag.LOWER_CONTACT) for i in range(2)]
    ds = ufl.Measure("ds", scene.u.function_space.mesh, subdomain_data=scene.tags)
    scene.F += 0.01 * v[1] * ds(Tag.UPPER_TOP)
    for sliding in ("finite", "small"):
        contact = scene.contact(sliding)
        problem = scene.problem(contact)
        scene.u.x.array[:] = 0
        problem.solve()
        assert problem.report.immobile == 1
        assert "1 immobile" in str(problem.report)
        assert 0 < contact.force[1] < 0.02
        assert np.abs(contact.multiplier).max() < 1


def test_a_linear_bulk_is_assembled_once_and_again_when_a_constant_changes():
    scene = Blocks(CellType.tetrahedron)
    E = fem.Constant(scene.u.function_space.mesh, default_scalar_type(1.0))
    scene.F = E * scene.F
    contact = scene.contact()
    problem = scene.problem(contact)
    problem.solve()
    assert problem.assembler.bulk.is_linear
    assert problem.assembler.bulk.assemblies == 1
    assert problem.report.skipped["bulk Jacobian assembly"] == problem.report.iterations
    force = contact.force.copy()
    scene.bcs[-1].g.value[...] *= 1.1
    problem.solve()
    assert problem.assembler.bulk.assemblies == 1
    scene.bcs[-1].g.value[...] /= 1.1
    E.value = 3.0
    problem.solve()
    assert problem.assembler.bulk.assemblies == 2
    assert contact.force == pytest.approx(3 * force, rel=1e-9, abs=1e-12)


def test_an_open_contact_changes_nothing():
    scene = Blocks(CellType.tetrahedron)
    one = scene.contact()
    side = cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), cx.Plane((9, 0, 0), (-1, 0, 0)))
    problem = scene.problem(one, side)
    problem.solve()
    alone = Blocks(CellType.tetrahedron)
    contact = alone.contact()
    alone.problem(contact).solve()
    assert not side.force.any()
    assert one.force == pytest.approx(contact.force, rel=1e-12, abs=1e-15)
    assert len(problem.report.force) == 2


def test_a_body_that_has_run_away_is_no_solution(method):
    """Whatever rounding makes of its forces."""
    scene = Blocks(CellType.quadrilateral)
    problem = scene.problem(scene.contact())
    problem.solve()
    system, convergence = problem.assembler.system.core, problem.assembler.loop.convergence
    b = np.empty(system.offsets[-1])

    system.residual(b)
    residual, tolerance, _ = convergence.compare(b, 1e-11, 0.0)
    assert residual <= tolerance
    free = np.flatnonzero(problem.assembler.bulk.markers == 0)[0]
    scene.u.x.array[free] = 1e5
    residual, tolerance, _ = convergence.compare(b, 1e-11, 0.0)
    assert tolerance == 0


def test_report_and_table_fit_a_terminal():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(scene.contact())
    problem.solve()
    text = str(problem.report)
    assert max(map(len, text.splitlines())) <= 100
    assert f"converged after {problem.report.iterations} iterations" in text
    assert "9 of 9 slave nodes have a pair" in text
    assert "force on the slave" in text
    assert "skipped: bulk Jacobian assembly" in text
    assert problem.report.times["total"] > 0
    assert problem.report.history[0].number == 0
    numbers = [row.number for row in problem.report.history]
    assert numbers == list(range(problem.report.iterations + 1))


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.hexahedron])
def test_moments_of_both_sides_and_of_another_point(cell):
    """About two points they differ by the force's; the forces act where the slave nodes are."""
    scene = Blocks(cell)
    contact = scene.contact(friction=0.3)
    scene.problem(contact).solve()
    gdim = len(contact.force)
    a, b = np.zeros(gdim), np.arange(1.0, gdim + 1)
    arm = a - b
    if gdim == 2:
        turned = arm[0] * contact.force[1] - arm[1] * contact.force[0]
    else:
        turned = np.cross(arm, contact.force)
    np.testing.assert_allclose(contact.moment(b), contact.moment(a) + turned, rtol=1e-12)
    x = contact.discrete.positions()[contact.slave_nodes]
    forces = contact.area[:, None] * contact.multiplier
    if scene.u.function_space.mesh.geometry.dim == 2:
        by_hand = (x[:, 0] * forces[:, 1] - x[:, 1] * forces[:, 0]).sum()
    else:
        by_hand = np.cross(x, forces).sum(axis=0)
    np.testing.assert_allclose(contact.moment(a), by_hand, rtol=1e-12, atol=1e-14)
    with pytest.raises(ValueError, match="finite numbers"):
        contact.moment(np.zeros(gdim + 1))
    with pytest.raises(TypeError, match="real numbers"):
        contact.moment("here")


def test_what_users_see_are_the_names_for_them():
    names = [name for name in dir(cx) if not name.startswith("_")]
    assert set(names) == set(cx.__all__)
    assert all(hasattr(cx, name) for name in names)
