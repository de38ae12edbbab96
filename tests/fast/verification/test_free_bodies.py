# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies that contact alone holds."""

from functools import partial

import numpy as np
import pytest
import stacked_blocks

import contactx as cx
import ufl
from contactx import cpp as core
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import CELLS, Blocks
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.disc import WEIGHT, FreeDisc
from scenes.problems import make_problem
from story import displacement, elasticity

pytestmark = pytest.mark.usefixtures("method")

PRESSURE = 0.01


class FreeBlock:
    """The upper block has no supports and a load on its top; the lower block's bottom is fixed."""

    def __init__(self, cell, *, gap=0.0, load=-PRESSURE, aside=0.0, friction=0.0, sliding="finite"):
        scene = Blocks(cell, gap=gap)
        self.u, mesh = scene.u, scene.u.function_space.mesh
        self.gdim = mesh.geometry.dim
        scene.bcs = scene.bcs[: self.gdim]
        force = np.zeros(self.gdim)
        force[-1], force[0] = load, aside
        v = ufl.TestFunction(self.u.function_space)
        ds = ufl.Measure("ds", mesh, subdomain_data=scene.tags)
        scene.F -= ufl.inner(fem.Constant(mesh, force), v) * ds(int(Tag.UPPER_TOP))
        self.contact = scene.contact(sliding, friction=friction)
        self.problem = scene.problem(self.contact)
        self.load = force

    def solve(self):
        self.problem.solve()
        return self.problem.report


@covering(cell=CELLS, friction=(0.0, 0.5), gap=(0.0, 0.1), **{"sliding,method": BOTH})
def test_a_block_comes_to_rest_on_another(cell, friction, gap, sliding, method):
    scene = FreeBlock(cell, friction=friction, gap=gap, sliding=sliding)
    report = scene.solve()
    closed, free = report.closed_for_balance, report.free_modes
    print(report.iterations, "iterations", closed, "closed", free, "free")
    assert report.iterations <= 6
    assert np.abs(scene.contact.force + scene.load).max() <= 1e-9 * PRESSURE
    assert np.nanmin(scene.contact.discrete.nodes.gap) >= -1e-12
    # It has come down by the gap, and hardly aside
    u = scene.u.x.array.reshape(-1, scene.gdim)
    assert u[:, -1].min() == pytest.approx(-gap, abs=0.03)
    assert np.abs(u[:, :-1]).max() <= 0.05


@covering(method=METHODS[1:], cell=CELLS[:2])
def test_a_plane_block_that_mean_normals_leave_free_is_held(cell, method):
    """In the plane the forces of two nodes meet in a point, the common centre of curvature.

    A rotation about it changes no gap: only the geometric stiffness holds a block.
    """
    scene = FreeBlock(cell)
    scene.solve()
    assert np.abs(scene.contact.force + scene.load).max() <= 1e-9 * PRESSURE
    assert np.abs(scene.u.x.array.reshape(-1, 2)[:, 0]).max() <= 0.05


@covering(cell=(CellType.triangle, CellType.hexahedron), gap=(0.0, 0.1), method=METHODS)
def test_friction_holds_it_against_a_push(cell, gap):
    scene = FreeBlock(cell, friction=0.5, gap=gap, aside=0.003)
    scene.solve()
    assert np.abs(scene.contact.force + scene.load).max() <= 1e-9 * PRESSURE
    assert (scene.contact.discrete.nodes.status == 1).any()


@covering(
    **{"load,aside,friction": [(PRESSURE, 0.0, 0.0), (-PRESSURE, 0.02, 0.5)]},
    cell=(CellType.triangle, CellType.hexahedron),
    method=METHODS,
)
def test_loads_that_nothing_balances_are_named(cell, load, aside, friction):
    scene = FreeBlock(cell, load=load, aside=aside, friction=friction, gap=0.01)
    with pytest.raises(cx.ConvergenceError, match="cannot be balanced") as info:
        scene.solve()
    assert info.value.report.iterations <= 20
    assert not scene.u.x.array.any()


@covering(cell=CELLS, friction=(0.0, 0.5), method=METHODS)
def test_touching_without_force_is_no_trouble(cell, friction, method):
    scene = FreeBlock(cell, load=0.0, friction=friction)
    report = scene.solve()
    assert report.iterations == 0
    assert not scene.u.x.array.any()
    # The load may follow, and go away again
    with_load = FreeBlock(cell, friction=friction)
    with_load.solve()
    assert np.abs(with_load.contact.force[-1] - PRESSURE) <= 1e-9 * PRESSURE


@covering(cell=(CellType.triangle, CellType.hexahedron), friction=(0.0, 0.5), method=METHODS)
def test_the_springs_do_not_change_the_answer(cell, friction, monkeypatch):
    """Without friction the place along the surface is free: rounding over the spring decides it."""
    answers = []
    given = core.FreeBodies.springs

    def springs(free, factor):
        found = given.fget(free)
        return None if found is None else factor * found

    for factor in (1e-3, 1.0, 1e3):
        monkeypatch.setattr(core.FreeBodies, "springs", property(partial(springs, factor=factor)))
        scene = FreeBlock(cell, friction=friction, sliding="small")
        scene.solve()
        answers.append((scene.u.x.array.copy(), scene.contact.multiplier.copy()))
    for u, p in answers[1:]:
        free = 1e-9 if friction else 1e-4
        assert np.abs(u - answers[0][0]).max() <= free * np.abs(u).max()
        assert np.abs(p - answers[0][1]).max() <= 1e-9 * np.abs(p).max()


@covering(
    **{
        "friction,offset,shear": [
            (0.3, 0.0, 0.001),
            (0.3, 0.0, 0.0),
            (0.0, 0.0, 0.0),
            (0.3, -0.01, 0.0),
            (0.3, 1e-8, 0.001),
        ],
        "method,dim": [(METHODS[0], 2), (METHODS[0], 3), (METHODS[1], 2)],
    },
    sliding=SLIDINGS,
)
def test_five_free_blocks(dim, friction, offset, shear, sliding, method, monkeypatch):
    monkeypatch.setattr(stacked_blocks, "FRICTION", friction)
    monkeypatch.setattr(stacked_blocks, "INTERFERENCE", offset)
    problem, contacts, load = stacked_blocks.create(0.25, sliding, dim)
    load.value[0], load.value[-1] = shear, -PRESSURE
    problem.solve()
    print(problem.report.iterations, "iterations")
    assert problem.report.iterations <= 8
    for contact in contacts:
        assert np.abs(contact.force + load.value).max() <= 1e-9 * PRESSURE
    # No drift: what the pressure and the gaps ask for, no more
    assert np.abs(problem.u.x.array).max() <= 0.1


@covering(cell=CELLS[:2], n=(2, 3, 5, 6), method=METHODS)
def test_friction_holds_a_block_on_a_slope(cell, n):
    """Nodes that slip to both sides balance it; Newton steps on the way have all of them slip."""
    data = meshes.blocks(cell, (n, n), (1, 1))
    domain, tags = meshes.single(data, Tag.UPPER)
    u = displacement(domain)
    v = ufl.TestFunction(u.function_space)
    F = elasticity(u, 1.0, 0.3) - ufl.inner(fem.Constant(domain, (0.0, -0.01)), v) * ufl.dx
    normal = fem.Constant(domain, np.array([0.0, 1.0]))
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0.0, 0.0), normal), friction=0.3
    )
    problem = make_problem(F, u, [contact])
    problem.solve()
    # Up to 85 % of the friction
    for angle in np.linspace(0, 0.25, 6)[1:]:
        normal.value[:] = -np.sin(angle), np.cos(angle)
        problem.solve()
        assert problem.report.iterations <= 8
        assert contact.force == pytest.approx([0, 0.01], abs=1e-11)
    # The slope gets too steep
    normal.value[:] = -np.sin(0.31), np.cos(0.31)
    with pytest.raises(cx.ConvergenceError, match="cannot be balanced"):
        problem.solve()


@covering(
    cell=(CellType.quadrilateral, CellType.hexahedron),
    friction=(0.0, 0.3),
    k=(1e-3, 1e-6, 1e-9, 1e-12),
    method=METHODS,
)
def test_a_body_on_weak_springs_does_not_pass_through_another(cell, friction, k):
    """The springs alone would let the load move it by ten times the size of the other one."""
    scene = Blocks(cell, gap=0.1)
    mesh = scene.u.function_space.mesh
    gdim = mesh.geometry.dim
    v = ufl.TestFunction(scene.u.function_space)
    ds = ufl.Measure("ds", mesh, subdomain_data=scene.tags)
    scene.F += k * ufl.inner(scene.u, v) * ufl.dx + PRESSURE * v[gdim - 1] * ds(int(Tag.UPPER_TOP))
    scene.bcs = scene.bcs[:gdim]
    contact = scene.contact(friction=friction)
    problem = scene.problem(contact)
    problem.solve()
    assert problem.report.iterations <= 10
    # The springs carry what they can over the gap
    assert contact.force[-1] == pytest.approx(PRESSURE, abs=0.2 * k + 1e-11)
    assert np.nanmin(contact.discrete.nodes.gap) >= -1e-12


@pytest.mark.parametrize(
    "cell", [CellType.quadrilateral, CellType.hexahedron], ids=lambda c: c.name
)
def test_a_support_that_comes_later(cell):
    gdim = 2 if cell == CellType.quadrilateral else 3
    data = meshes.blocks(cell, (3,) * gdim, (1,) * gdim)
    domain, tags = meshes.single(data, Tag.UPPER)
    u = displacement(domain)
    v = ufl.TestFunction(u.function_space)
    k, load = fem.Constant(domain, 0.0), fem.Constant(domain, -0.01)
    F = elasticity(u, 1.0, 0.3) + (k * ufl.inner(u, v) - load * v[gdim - 1]) * ufl.dx
    floor = cx.Plane(np.zeros(gdim), np.eye(gdim)[-1])
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), floor)
    problem = make_problem(F, u, [contact])
    problem.solve()
    k.value, load.value = 0.1, 0.01
    problem.solve()
    rises = np.zeros(gdim)
    rises[-1] = 0.1
    assert np.abs(u.x.array.reshape(-1, gdim) - rises).max() <= 1e-9


@pytest.mark.filterwarnings("ignore:nothing but the corners")
@pytest.mark.parametrize(
    ("cup", "gap", "linear"),
    [(1.3, 0.0, False), (2.0, 0.0, False), (2.0, 0.1, True), (None, 0.5, True), (None, 0.5, False)],
)
def test_a_disc_neither_turns_nor_drifts_where_nothing_makes_it(cup, gap, linear):
    """Its first nodes in contact are close to each other, and hardly resist a rotation."""
    disc = FreeDisc(cup, gap, linear=linear)
    disc.problem.solve()
    turned, aside = disc.moved
    assert abs(turned) <= 0.025 and abs(aside) <= 0.012
    assert np.abs(disc.contact.force - [0, WEIGHT]).max() <= 0.01 * WEIGHT
    assert disc.problem.report.iterations <= 18
