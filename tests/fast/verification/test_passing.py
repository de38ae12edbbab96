# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that are moved past each other, tools that are pushed deep, cells that turn inside out."""

from collections import namedtuple

from mpi4py import MPI

import numpy as np
import pytest

import basix
import contactx as cx
import ufl
from contactx import cpp as core
from contactx._host.nodes import linear_cells, parts_of_cells, reference_positions
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from scenes import CELLS, dimension
from scenes.held_sheet import RADIUS, HeldSheet, cylinder, disc, level_set, limit
from scenes.materials import neo_hookean, st_venant_kirchhoff
from scenes.roller import Roller
from scenes.two_tips import TwoTips

METHODS = pytest.mark.parametrize("method", ["node-to-surface", "surface-to-surface"])
DOWN = 12.0


def moved(steps, **options):
    tips = TwoTips(**options)
    for k in range(steps):
        tips.push(DOWN * (k + 1) / steps)
        tips.problem.solve()
    return tips


@METHODS
@pytest.mark.parametrize("overlap", [0.05, 0.2])
def test_facing_surfaces_stop_each_other_in_one_step(method, overlap):
    one, many = (moved(steps, method=method, overlap=overlap) for steps in (1, 12))
    assert one.contact.force[1] < 0
    assert one.contact.force == pytest.approx(many.contact.force, rel=1e-6)


@METHODS
@pytest.mark.parametrize("overlap", [0.05, 0.2])
def test_whole_boundaries_are_the_same_in_steps(method, overlap):
    """A face is not pressed from behind through a body that is thinner than the reach."""
    face = moved(12, method=method, overlap=overlap)
    whole = TwoTips(method=method, overlap=overlap, whole=True)
    for _ in cx.LoadSteps(whole.problem, 24, update=lambda t: whole.push(DOWN * t), progress=False):
        pass
    # By surface-to-surface facets at the ends of a face have an edge beside them in the whole
    near = 1e-6 if method == "node-to-surface" else 3e-4
    assert whole.contact.force == pytest.approx(face.contact.force, rel=near)


@METHODS
def test_whole_boundaries_do_not_pass_through_in_one_step(method):
    """They did, with no more than a warning that nothing was in reach."""
    tips = TwoTips(method=method, whole=True)
    tips.push(DOWN)
    with pytest.raises(cx.ConvergenceError, match="smaller load steps"):
        tips.problem.solve()
    assert not tips.u.x.array.any()


@METHODS
def test_whole_boundaries_out_of_contact_are_free(method):
    tips = TwoTips(method=method, whole=True)
    tips.push(-1.0)
    tips.problem.solve()
    assert not tips.contact.force.any()


TOOLS = [(disc, 2), (level_set, 2), (cylinder, 3)]


@METHODS
@pytest.mark.parametrize(("tool", "gdim"), TOOLS, ids=lambda v: getattr(v, "__name__", v))
@pytest.mark.parametrize("deep", [1.05, 2.5])
def test_too_deep_in_one_step_is_refused(tool, gdim, deep, method):
    """It was accepted, with the force reversed and the sheet on the far side."""
    sheet = HeldSheet(tool, gdim=gdim, n=12, method=method)
    with pytest.raises(cx.ConvergenceError, match=r"far side.*smaller load steps"):
        sheet.solve(deep, 1)
    assert not sheet.u.x.array.any()


@pytest.mark.parametrize("whole", [False, True])
@METHODS
def test_in_steps_the_force_is_that_of_a_push(method, whole):
    forces = []
    for steps in (8, 16):
        sheet = HeldSheet(method=method, whole=whole)
        sheet.solve(1.05, steps)
        forces.append(sheet.contact.force[1])
        assert sheet.lowest() == pytest.approx(-1.05 * RADIUS, rel=0.01)
    # Elastic, without friction: no path matters
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_the_tag_of_the_whole_boundary_changes_nothing():
    forces = []
    for whole in (False, True):
        sheet = HeldSheet(whole=whole, thickness=0.05)
        sheet.solve(0.8, 4)
        forces.append(sheet.contact.force[1])
    assert forces[0] == pytest.approx(forces[1], rel=1e-9)


def test_load_steps_cut_until_it_is_right():
    sheet, other = HeldSheet(), HeldSheet()
    for _ in cx.LoadSteps(sheet.problem, 1, update=lambda t: sheet.push(1.5 * t), progress=False):
        pass
    other.solve(1.5, 16)
    assert sheet.contact.force[1] == pytest.approx(other.contact.force[1], rel=1e-6)


@METHODS
def test_an_overlap_at_the_start_beyond_the_middle_is_refused(method):
    sheet = HeldSheet(deep=1.05, method=method)
    with pytest.raises(cx.ConvergenceError, match=r"inside the rigid Sphere.*face away"):
        sheet.problem.solve()


def test_a_node_in_the_centre_of_a_disc_is_refused():
    sheet = HeldSheet()
    with pytest.raises(cx.ConvergenceError, match="far side"):
        sheet.solve(1.0, 1)


def test_a_block_is_not_pushed_through():
    block = HeldSheet(thickness=1.0, on_ground=True)
    with pytest.raises(cx.ConvergenceError, match="far side"):
        block.solve(2.5, 1)
    block.solve(0.6, 4)
    assert block.contact.force[1] < 0


def test_the_audit_may_warn_instead():
    sheet = HeldSheet(audit="warn")
    with pytest.warns(UserWarning, match="far side"):
        sheet.solve(2.5, 1)
    assert sheet.problem.report.audit.passed > 0
    assert not sheet.problem.report.audit.faults or sheet.problem.report.converged


def test_a_tool_may_pass_by():
    """Over the sheet, beside it and around its end, without touching it."""
    sheet = HeldSheet(n=12)
    for x, z in [(-0.5, 0.5), (1.5, 0.5), (1.5, -1.0), (0.0, -1.0)]:
        sheet.place.value[:] = x, z
        sheet.problem.solve()
        assert not sheet.contact.force.any()


def test_a_whole_boundary_slides_and_turns_under_a_tool():
    """Sideways by more than a radius a step: legal, though chords cross the tool."""
    sheet = HeldSheet(thickness=0.2, whole=True, material=neo_hookean)
    sheet.solve(0.5, 2)
    for x in (0.35, -0.35):
        sheet.place.value[0] = x
        sheet.problem.solve()
        assert sheet.contact.force[1] < 0
    assert np.isfinite(sheet.lowest())


@pytest.fixture
def full_steps(monkeypatch):
    """Steps that nothing shortens."""
    monkeypatch.setattr(core.Loop, "limit", limit)


def roller(**options):
    return Roller("svk", "surface-to-surface", 0.0, n=10, **options)


def test_one_deep_step_is_refused(full_steps):
    """It converges: a material that hardly resists is folded over the roller."""
    pressed = roller()
    with pytest.raises(cx.ConvergenceError, match=r"\d+ cells are turned inside out.*smaller load"):
        pressed.press(0.6)
    assert not pressed.u.x.array.any()
    audit = pressed.problem.report.audit
    assert audit.inverted > 0
    assert audit.smallest_det < 0


def test_load_steps_cut_until_no_cell_is_inside_out():
    forces = []
    for steps in (1, 4):
        pressed = HeldSheet(n=24, thickness=1.0, on_ground=True, material=st_venant_kirchhoff)
        for step in cx.LoadSteps(
            pressed.problem, steps, update=lambda t, p=pressed: p.push(0.45 * t), progress=False
        ):
            assert step.report.audit.inverted == 0
        forces.append(pressed.contact.force[1])
    assert forces[0] < 0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_one_deep_step_is_right_where_steps_turn_no_cell_inside_out():
    forces = []
    for steps in (1, 8):
        pressed = roller()
        for k in range(steps):
            assert pressed.press(0.6 * (k + 1) / steps).audit.inverted == 0
        forces.append(pressed.contact.force[1])
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_the_audit_may_warn_of_cells(full_steps):
    pressed = roller(audit="warn")
    with pytest.warns(UserWarning, match="inside out"):
        pressed.press(0.6)
    assert pressed.problem.report.converged


@pytest.mark.parametrize(("sliding", "inverted"), [("finite", True), ("small", False)])
def test_linear_bodies_are_only_warned_of(sliding, inverted, recwarn):
    """A linear material does not notice; in small sliding positions do not matter."""
    pressed = HeldSheet(thickness=0.1, on_ground=True, sliding=sliding)
    pressed.solve(0.4, 4)
    audit = pressed.problem.report.audit
    assert (audit.inverted > 0) == inverted
    assert any("A linear material does not resist" in str(w.message) for w in recwarn) == inverted


Found = namedtuple("Found", "smallest cell inverted")


def out_of_shape(cell, n=3):
    """A displacement on n cells an axis that are out of shape."""
    gdim = dimension(cell)
    create = mesh.create_unit_square if gdim == 2 else mesh.create_unit_cube
    domain = create(MPI.COMM_SELF, *(n,) * gdim, cell)
    x = domain.geometry.x[:, :gdim]
    x += np.random.default_rng(1).uniform(-0.15 / n, 0.15 / n, x.shape)
    return fem.Function(fem.functionspace(domain, ("Lagrange", 1, (gdim,))))


def look(u):
    """Smallest det F of the cells of a displacement, which one has it, and the inverted ones."""
    V = u.function_space
    X = reference_positions(V)
    owned = V.mesh.topology.index_map(V.mesh.topology.dim).size_local
    cells = linear_cells(V)[: owned * parts_of_cells(V)]
    return Found(*core.deformed_cells(cells, X, u.x.array, X.shape[1]))


def by_ufl(u):
    """Values of det(I + grad u) at the points of the audit, shape (num_cells, num_points)."""
    domain = u.function_space.mesh
    cell = basix.CellType[domain.basix_cell().name]
    simplex = cell in (basix.CellType.triangle, basix.CellType.tetrahedron)
    points = basix.create_lattice(cell, 1 if simplex else 2, basix.LatticeType.equispaced, True)
    J = ufl.det(ufl.Identity(domain.geometry.dim) + ufl.grad(u))
    owned = domain.topology.index_map(domain.topology.dim).size_local
    return fem.Expression(J, points).eval(domain, np.arange(owned, dtype=np.int32))


@pytest.mark.parametrize("cell", CELLS, ids=lambda c: c.name)
@pytest.mark.parametrize("size", [0.02, 0.1, 0.3, 1.0])
def test_smallest_determinant_is_that_of_ufl(cell, size):
    u = out_of_shape(cell)
    u.x.array[:] = np.random.default_rng(2).uniform(-size, size, len(u.x.array))
    J = by_ufl(u)
    found = look(u)
    if found.smallest == pytest.approx(J.min(), rel=1e-10, abs=1e-12):
        assert J[found.cell].min() == pytest.approx(J.min(), rel=1e-10, abs=1e-12)
    else:
        # Between the points
        assert cell == CellType.hexahedron and found.smallest < J.min()
    assert found.inverted >= np.count_nonzero(J.min(axis=1) <= 0)
    assert (found.inverted > 0) == (found.smallest <= 0)
    if size == 0.02:
        assert found.inverted == 0
    if size >= 0.3:
        assert found.inverted > 0


def test_curved_cells_are_taken_by_their_vertices():
    """Their geometry has nodes that the displacement has not."""
    curved = mesh.create_mesh(
        MPI.COMM_SELF,
        np.array([[0, 1, 2, 3, 4, 5]]),
        basix.ufl.element("Lagrange", "triangle", 2, shape=(2,)),
        np.array([[0.0, 0], [1, 0], [0, 1], [0.6, 0.6], [0, 0.5], [0.5, 0]]),
    )
    assert curved.geometry.dofmaps[0].shape[1] == 6
    u = fem.Function(fem.functionspace(curved, ("Lagrange", 1, (2,))))
    u.interpolate(lambda x: np.stack([x[0], -0.5 * x[1]]))
    found = look(u)
    assert (found.smallest, found.inverted) == (pytest.approx(1), 0)
    assert found.cell == 0
