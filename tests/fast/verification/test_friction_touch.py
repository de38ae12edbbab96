# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Friction within a step: where nodes touch first, work and energy, a plane that moves.

A node that touches first within a step slips only from where it touches. Where that is does not
depend on how much of a Newton step is taken.
"""

from functools import partial

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from contactx import cpp as core
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

from scenes import CELLS, dimension
from scenes.coulomb import parts
from scenes.covering import BOTH, METHODS, SLIDINGS, covering
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean
from scenes.problems import direct_solver
from scenes.tower import Tower, lift

pytestmark = pytest.mark.usefixtures("method")


@covering(cell=CELLS, base=("plane", "elastic"), steps=(1, 2), **{"sliding,method": BOTH})
def test_sticks_where_it_touches(steps, cell, base, sliding, method):
    """Half way down: of 0.2 the gap takes 0.1; the straight way is half way aside there."""
    gdim = dimension(cell)
    scene = DrivenBlock(
        cell,
        plane=cx.Plane((0.0,) * gdim, np.eye(gdim)[-1]) if base == "plane" else None,
        friction=20.0,
        sliding=sliding,
        gap=0.1,
        width=4.0,
        n_upper=2,
        n_lower=7,
    )
    across = (0.0,) * (gdim - 2)
    if steps == 2:
        # An end of a step in the air changes nothing
        scene.step(0.3, *across, -0.06)
        assert scene.contact.force == pytest.approx(np.zeros(gdim))
    scene.step(1.0, *across, -0.2)
    discrete = scene.contact.discrete
    V = scene.u.function_space
    X = V.tabulate_dof_coordinates()[:, :gdim]
    u = scene.u.x.array.reshape(-1, gdim)
    if base == "plane":
        aside = u[discrete.slaves, 0]
    elif method == "surface-to-surface":
        # The place on the base that it came to, in the mean
        weights, n = discrete.master.weights(), len(discrete.slaves)
        moved = X[:, 0] if sliding == "finite" else -u[:, 0]
        aside = -np.bincount(weights.slaves, weights.values * moved[weights.nodes], n)
    else:
        aside = np.full(len(discrete.slaves), np.nan)
        at = core.pair_layout["xi"]
        for pairs in discrete.master.pairs():
            xi = np.ascontiguousarray(pairs.data[:, at : at + 2])
            N = core.shape_functions(pairs.nodes.shape[1] - 1, xi)
            masters = pairs.nodes[:, 1:]
            if sliding == "finite":
                # The place on the base that it came to, in the reference
                foot = np.einsum("il,ilk->ik", N, X[masters])
                aside[pairs.slaves[:, 0]] = (foot - X[pairs.nodes[:, 0]])[:, 0]
            else:
                moved = np.einsum("il,ilk->ik", N, u[masters])
                aside[pairs.slaves[:, 0]] = (u[pairs.nodes[:, 0]] - moved)[:, 0]
    stick = discrete.nodes.status == 1
    print(scene.iterations, discrete.nodes.status, aside)
    assert stick.sum() >= len(stick) / 2
    # Where facets bend, the mean of places is not the place of the mean
    bends = (method, base, sliding) == ("surface-to-surface", "elastic", "finite")
    assert aside[stick] == pytest.approx(0.5, abs=0.05 if bends else 1e-8)
    assert np.abs(discrete.history.slip[stick]).max() < 1e-9


class PressedBlock(DrivenBlock):
    """A neo-Hookean block, and a rigid ball that is to move up and aside in one step."""

    def __init__(self):
        ball = cx.Sphere((0.5, 0.5, -0.405), radius=0.4)
        super().__init__(
            CellType.hexahedron,
            plane=ball,
            friction=0.2,
            n_upper=6,
            shift=0.0,
            material=partial(neo_hookean, degree=3),
        )
        ball.centre = 0.65, 0.5, -0.255

    def run(self, first):
        """Newton steps by hand, of the first one a part."""
        assembler = self.problem.assembler
        ksp = direct_solver()
        b, dx = assembler.create_vector(), assembler.create_vector()
        assembler.begin_step()
        part = first
        while not assembler.settle().converged:
            assembler.residual(b)
            assembler.set_up(ksp)
            ksp.solve(b, dx)
            dx.scale(-1)
            assembler.update(dx, part * assembler.limit(dx))
            part = 1.0
        assembler.accept()
        return assembler.report


def test_no_matter_who_takes_the_steps_and_how_long_the_first_one_is():
    one = PressedBlock()
    one.problem.solve()
    report = one.problem.report
    nodes = one.contact.discrete.nodes
    assert report.limited > 0
    assert (nodes.status == 2).sum() >= 7
    forces = [one.contact.force]
    for first in (1.0, 0.4):
        other = PressedBlock()
        other.run(first)
        forces.append(other.contact.force)
        assert (other.contact.discrete.nodes.status == nodes.status).all()
        error = np.abs(other.u.x.array - one.u.x.array).max()
        print(first, error, forces[-1])
        assert error <= 1e-10 * np.abs(one.u.x.array).max()
    assert np.ptp(forces, axis=0).max() <= 1e-10 * np.abs(forces).max()


class Balance:
    """State of a scene with small sliding at the end of a step, to set against the one before."""

    def __init__(self, scene):
        contact = scene.contact
        self.u = scene.u.x.array.copy()
        self.f = scene.reactions
        self.p, self.t = parts(contact)
        self.closed = contact.discrete.nodes.closed.copy()
        self.dissipation = contact.discrete.history.dissipation.copy()
        self.total = contact.discrete.history.total.copy()

    @property
    def energy(self):
        """Of a linear bulk."""
        return 0.5 * self.f @ self.u


def relative(scene, du):
    """Movement of the slave nodes relative to their masters, shape (n, gdim)."""
    discrete = scene.contact.discrete
    du = du.reshape(-1, scene.gdim)
    way = du[discrete.slaves].copy()
    if isinstance(discrete.master, core.SurfaceToSurface):
        weights = discrete.master.weights()
        way[:] = 0
        np.add.at(way, weights.slaves, weights.values[:, None] * du[weights.nodes])
        return way
    for pairs in discrete.master.pairs():
        if pairs.nodes.shape[1] == 1:
            continue
        at = core.pair_layout["xi"]
        xi = np.ascontiguousarray(pairs.data[:, at : at + 2])
        N = core.shape_functions(pairs.nodes.shape[1] - 1, xi)
        way[pairs.slaves[:, 0]] -= np.einsum("il,ilk->ik", N, du[pairs.nodes[:, 1:]])
    return way


@covering(cell=CELLS, base=("plane", "elastic"), friction=(0.3, 0.9), method=METHODS)
def test_balance_of_each_step(friction, cell, base):
    gdim = dimension(cell)
    up = np.eye(gdim)[-1]
    scene = DrivenBlock(
        cell,
        plane=cx.Plane((0.0,) * gdim, up) if base == "plane" else None,
        friction=friction,
        sliding="small",
    )
    driven = np.concatenate([d.bc.dof_indices()[0] for d in (scene.top, scene.bottom) if d])
    across = (0.0,) * (gdim - 2)
    area = scene.contact.area
    scene.step(0.0, *across, -0.02)
    old = Balance(scene)
    defects, kept = [], []
    for x, down in [
        (0.005, -0.02),
        (0.08, -0.02),
        (0.2, -0.03),
        (0.195, -0.03),
        (0.19, -0.02),
        (0.1, -0.02),
        (0.1, -0.01),
        (-0.1, -0.02),
        (0.0, -0.02),
    ]:
        scene.step(x, *across, down)
        new = Balance(scene)
        du = new.u - old.u
        way = relative(scene, du)
        dg = way @ up
        slip = scene.contact.discrete.history.slip
        assert np.abs(slip @ up).max() < 1e-14
        # A node that has opened or closed has gone a part of its way in contact only
        stays = old.closed & new.closed
        kept.append(np.array_equal(old.closed, new.closed))
        assert slip[stays] == pytest.approx((way - np.outer(dg, up))[stays], abs=1e-13)
        ds = np.where(stays[:, None], slip, way - np.outer(dg, up))
        friction_work = area @ np.einsum("ij,ij->i", old.t + new.t, ds) / 2
        normal_work = area @ ((old.p + new.p) * dg) / 2
        if kept[-1]:
            assert abs(normal_work) < 1e-14
        work = (old.f + new.f)[driven] @ du[driven] / 2
        defects.append(work - (new.energy - old.energy - friction_work - normal_work))
        # What friction takes in the step, with the traction at its end
        lost = -np.einsum("ij,ij->i", new.t, slip)
        assert lost.min() >= -1e-14
        assert new.dissipation - old.dissipation == pytest.approx(area * lost, abs=1e-15)
        length = np.linalg.norm(slip, axis=1)
        assert new.total - old.total == pytest.approx(length, abs=1e-14)
        old = new
    cycle = old.dissipation.sum()
    print(
        scene.iterations, f"{sum(kept)} of {len(kept)} steps kept their nodes in contact,", end=""
    )
    print(f" off by {np.abs(defects).max() / cycle:.1e} of {cycle:.3g}")
    assert any(kept)
    assert np.abs(defects).max() <= 1e-6 * cycle
    # The fields are those of the history
    nodes = scene.contact.slave_nodes
    field = scene.contact.slip.x.array.reshape(-1, gdim)[nodes]
    np.testing.assert_array_equal(field, scene.contact.discrete.history.slip)
    assert scene.contact.slip_total.x.array.sum() == pytest.approx(old.total.sum(), rel=1e-12)


class Pressed(Tower):
    """A block pressed on a plane by a tenth of its height."""

    def __init__(self, cell, sliding, friction, n):
        gdim = dimension(cell)
        domain = mesh.create_unit_interval(MPI.COMM_SELF, 1)
        self.point = fem.Constant(domain, np.zeros(gdim))
        plane = cx.Plane(self.point, lift(gdim, 1))
        super().__init__(cell, n, 1, master=plane, nu=0.3, sliding=sliding, friction=friction)
        self.solve(*lift(gdim, -0.1))

    def shift(self, plane=0.0, top=0.0):
        self.point.value[0] = plane
        self.solve(*lift(self.gdim, -0.1, top))


@covering(cell=CELLS, sliding=SLIDINGS, method=METHODS)
def test_only_relative_movement_counts(cell, sliding):
    """The plane goes one way or the block's top the other."""
    plane, top = (Pressed(cell, sliding, 0.3, 3) for _ in range(2))
    for k in (1, 2, 3):
        plane.shift(plane=-0.03 * k)
        top.shift(top=0.03 * k)
        a, b = plane.contact, top.contact
        size = np.abs(b.multiplier).max()
        assert np.abs(a.multiplier - b.multiplier).max() <= 1e-9 * size
        assert np.abs(a.slip_total.x.array - b.slip_total.x.array).max() <= 1e-9
        assert np.array_equal(a.discrete.nodes.status, b.discrete.nodes.status)
    # Both kinds of nodes have come up
    assert {1, 2} <= set(a.discrete.nodes.status)
    assert a.force[0] < -0.01


@covering(
    **{"cell,n": [(CELLS[0], 6), (CELLS[1], 9), (CELLS[3], 4)]},
    sliding=SLIDINGS,
    friction=(0.03, 0.2, 0.3, 0.5),
    method=METHODS,
)
def test_slip_that_turns_back_does_not_cycle(cell, n, sliding, friction):
    """All nodes start to slip where most of them stick in the end, and the plane returns."""
    scene = Pressed(cell, sliding, friction, n)
    contact, nodes = scene.contact, scene.contact.discrete.nodes
    for place in (-0.03, 0.03, -0.1):
        scene.shift(plane=place)
        assert scene.problem.report.iterations <= 13
        closed = nodes.closed
        traction = contact.multiplier - nodes.pressure[:, None] * nodes.normal
        size = np.linalg.norm(traction, axis=1)
        bound = friction * nodes.pressure
        scale = nodes.pressure.max()
        assert np.abs(nodes.gap[closed]).max() <= 1e-12
        assert np.all(size <= bound + 1e-9 * scale)
        stick, slip = nodes.status == 1, nodes.status == 2
        assert np.abs(nodes.slip[stick]).max(initial=0) <= 1e-11
        # Against the slip, and as large as friction can be
        assert size[slip] == pytest.approx(bound[slip], abs=1e-9 * scale)
        work = np.einsum("ij,ij->i", traction, nodes.slip)
        length = np.linalg.norm(nodes.slip, axis=1)
        assert np.abs(work + size * length)[slip].max(initial=0) <= 1e-9 * scale
