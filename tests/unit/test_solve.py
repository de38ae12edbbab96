# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Failed steps, reuse of what was assembled, several contacts, output."""

import gc
import warnings
import weakref
from pathlib import Path

from petsc4py import PETSc

import numpy as np
import pytest
import pyvista
from scenes import Blocks
from story import displacement, fix

import contactx as cx
import ufl
from contactx.meshes import Tag
from dolfinx import default_scalar_type, fem
from dolfinx.mesh import CellType


def test_no_convergence_leaves_everything_as_it_was():
    scene = Blocks(CellType.tetrahedron, down=0.01)
    contact = scene.contact()
    problem = scene.problem(contact, petsc_options={"snes_max_it": 4})
    problem.solve()
    before = [
        scene.u.x.array.copy(),
        contact.multiplier.copy(),
        contact.interface.status.copy(),
        contact.interface.gap.copy(),
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
    assert problem.report.iterations == 4
    after = [
        scene.u.x.array,
        contact.multiplier,
        contact.interface.status,
        contact.interface.gap,
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


def test_material_that_fails_with_nan():
    scene = Blocks(CellType.tetrahedron)
    stretch = 1 + ufl.tr(ufl.grad(scene.u))
    scene.F = ufl.derivative(ufl.ln(stretch - 1.001) ** 2 * ufl.dx, scene.u)
    problem = scene.problem(scene.contact())
    with pytest.raises(cx.ConvergenceError, match="the residual is not finite: the material fails"):
        problem.solve()
    assert not scene.u.x.array.any()


@pytest.mark.parametrize("part", ["residual", "jacobian", "scatter"])
@pytest.mark.parametrize("call", [1, 3])
def test_an_interrupt_anywhere_leaves_everything_as_it_was(monkeypatch, part, call):
    scene = Blocks(CellType.tetrahedron)
    contact = scene.contact()
    problem = scene.problem(contact)
    system, calls = problem._system, []
    real = getattr(system, part)

    def interrupted(*args):
        calls.append(part)
        if len(calls) == call:
            raise KeyboardInterrupt
        return real(*args)

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
    nodes = [pairs.nodes.copy() for pairs in contact.interface.master.pairs()]
    data = [pairs.data.copy() for pairs in contact.interface.master.pairs()]
    scene.bcs[0].g.value[...] = 0.4
    scene.bcs[-1].g.value[...] = -0.9
    with pytest.raises(cx.ConvergenceError):
        problem.solve()
    for pairs, before, values in zip(contact.interface.master.pairs(), nodes, data, strict=True):
        assert np.array_equal(pairs.nodes, before)
        assert np.array_equal(pairs.data, values)


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
    assert problem._bulk.assemblies == 1
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
        assert "1 nothing to yield" in str(problem.report)
        assert 0 < contact.force[1] < 0.02
        assert np.abs(contact.multiplier).max() < 1


def test_problems_are_freed():
    scene = Blocks(CellType.triangle)
    problem = scene.problem(scene.contact())
    problem.solve()
    system = weakref.ref(problem._system)
    del problem
    gc.collect()
    assert system() is None


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
    monkeypatch.setattr(cx.compat, "direct_solver", lambda: solver)
    scene, reference = Blocks(CellType.hexahedron), Blocks(CellType.hexahedron)
    contact = scene.contact()
    scene.problem(contact).solve()
    monkeypatch.undo()
    other = reference.contact()
    reference.problem(other).solve()
    assert contact.force == pytest.approx(other.force, rel=1e-9, abs=1e-12)


def test_a_refused_problem_frees_its_contacts():
    scene = Blocks(CellType.tetrahedron)
    good = scene.contact()
    bad = cx.Contact(
        cx.Surface(scene.tags, Tag.UPPER_CONTACT), cx.Surface(scene.tags, Tag.UPPER_X0)
    )
    with pytest.raises(ValueError, match="overlap"):
        scene.problem(good, bad)
    scene.problem(good).solve()
    assert good.force[2] > 0


def test_a_linear_bulk_is_assembled_once_and_again_when_a_constant_changes():
    scene = Blocks(CellType.tetrahedron)
    E = fem.Constant(scene.u.function_space.mesh, default_scalar_type(1.0))
    scene.F = E * scene.F
    contact = scene.contact()
    problem = scene.problem(contact)
    problem.solve()
    assert problem._bulk.is_linear
    assert problem._bulk.assemblies == 1
    assert problem.report.skipped["bulk Jacobian assembly"] == problem.report.iterations
    force = contact.force.copy()
    scene.bcs[-1].g.value[...] *= 1.1
    problem.solve()
    assert problem._bulk.assemblies == 1
    scene.bcs[-1].g.value[...] /= 1.1
    E.value = 3.0
    problem.solve()
    assert problem._bulk.assemblies == 2
    assert contact.force == pytest.approx(3 * force, rel=1e-9, abs=1e-12)


def test_loading_and_unloading_opens_again():
    scene = Blocks(CellType.quadrilateral, down=0.05, gap=0.01)
    contact = scene.contact()
    problem = scene.problem(contact)
    problem.solve()
    loaded = contact.force.copy()
    assert loaded[1] > 0
    scene.bcs[-1].g.value[...] = 0.0
    problem.solve()
    assert not contact.force.any()
    assert np.abs(scene.u.x.array).max() <= 1e-14
    scene.bcs[-1].g.value[...] = -0.05
    problem.solve()
    assert contact.force == pytest.approx(loaded, rel=1e-10, abs=1e-14)


def test_a_contact_that_faces_away_warns_and_changes_nothing():
    scene = Blocks(CellType.tetrahedron)
    one = scene.contact()
    side = cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), cx.Surface(scene.tags, Tag.LOWER_X1))
    problem = scene.problem(one, side)
    with pytest.warns(UserWarning, match=r"contact 1 .* no slave node that faces its master"):
        problem.solve()
    alone = Blocks(CellType.tetrahedron)
    contact = alone.contact()
    alone.problem(contact).solve()
    assert not side.force.any()
    assert one.force == pytest.approx(contact.force, rel=1e-12, abs=1e-15)
    assert len(problem.report.force) == 2


def test_touching_without_force():
    """Gaps that are zero but for rounding neither chatter nor make the system singular."""
    for sliding in ("finite", "small"):
        scene = Blocks(CellType.tetrahedron, down=0.0, n_upper=3, n_lower=4)
        contact = scene.contact(sliding)
        problem = scene.problem(contact)
        problem.solve()
        assert problem.report.iterations <= 1
        assert np.abs(scene.u.x.array).max() <= 1e-15
        assert np.abs(contact.multiplier).max() <= 1e-13


def test_held_pairs_that_hide_a_penetration_warn():
    scene = Blocks(CellType.tetrahedron)
    contact = scene.contact()
    problem = scene.problem(contact)

    class Held:
        paired, frozen = np.ones(3, dtype=bool), np.arange(2)

        def deepest_frozen(self, _):
            return -1e-3

    interface = contact.interface
    assert interface.master.deepest_frozen(interface.positions()) == 0
    interface.master = Held()
    with pytest.warns(UserWarning, match=r"2 pairs went back.*hide a penetration of 0\.001"):
        problem._warn(0, interface)


def test_slave_and_master_may_change_roles():
    """Not the same constraints, but answers that approach each other with the mesh size."""
    forces = []
    for swap in (False, True):
        scene = Blocks(CellType.quadrilateral, n_upper=16, n_lower=24)
        surfaces = [
            cx.Surface(scene.tags, Tag.UPPER_CONTACT),
            cx.Surface(scene.tags, Tag.LOWER_CONTACT),
        ]
        contact = cx.Contact(*(surfaces[::-1] if swap else surfaces))
        scene.problem(contact).solve()
        forces.append(-contact.force if swap else contact.force)
    assert forces[0][1] == pytest.approx(forces[1][1], rel=0.03)


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


def test_user_options_reach_petsc():
    scene = Blocks(CellType.tetrahedron)
    problem = scene.problem(
        scene.contact(), petsc_options={"snes_rtol": 1e-6, "snes_max_it": 33, "ksp_type": "gmres"}
    )
    problem.solve()
    rtol, _, _, max_it = problem.solver.getTolerances()
    assert (rtol, max_it) == (1e-6, 33)
    assert problem.solver.getKSP().getType() == "gmres"


@pytest.mark.parametrize("contacts", [1, 2])
def test_paraview_output(tmp_path: Path, contacts):
    scene = Blocks(CellType.hexahedron)
    scene.u.name = "displacement"
    all_contacts = [
        scene.contact(),
        cx.Contact(cx.Surface(scene.tags, Tag.UPPER_X1), cx.Surface(scene.tags, Tag.LOWER_X1)),
    ][:contacts]
    problem = scene.problem(*all_contacts)
    if contacts == 2:
        warnings.simplefilter("ignore", UserWarning)  # the second one faces away
    path = tmp_path / "new" / "blocks.pvd"
    with cx.VTKOutput(path, scene.u, all_contacts) as output:
        output.write(0.0)
        problem.solve()
        output.write(1.0)
    reader = pyvista.get_reader(str(path))
    assert reader.time_values == [0.0, 1.0]
    reader.set_active_time_value(1.0)
    data = reader.read()[0].point_data
    suffix = "_0" if contacts == 2 else ""
    assert data["displacement"].shape[1] == 3
    assert data["pressure" + suffix].max() == pytest.approx(all_contacts[0].multiplier.max())
    assert np.nanmin(data["gap" + suffix]) == pytest.approx(0, abs=1e-12)
    assert set(data["status" + suffix]) <= {-1, 0, 2}


def test_paraview_output_needs_pvd(tmp_path: Path):
    scene = Blocks(CellType.triangle)
    with pytest.raises(ValueError, match=r"ends in '.xdmf'.*\.pvd"):
        cx.VTKOutput(tmp_path / "a.xdmf", displacement(scene.u.function_space.mesh), [])


def test_a_contact_that_a_dirichlet_value_closes_by_force():
    """Prescribed displacement of the top in two steps gives what one step gives (no history)."""
    one, two = Blocks(CellType.tetrahedron), Blocks(CellType.tetrahedron)
    contact = one.contact()
    one.problem(contact).solve()
    two.bcs[-1] = fix(two.u, two.tags, 2, -0.02, Tag.UPPER_TOP)
    stepped = two.contact()
    problem = two.problem(stepped)
    problem.solve()
    two.bcs[-1].g.value[...] = -0.05
    problem.solve()
    assert stepped.force == pytest.approx(contact.force, rel=1e-9, abs=1e-12)
