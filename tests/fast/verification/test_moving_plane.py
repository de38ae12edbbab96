# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rigid plane that moves under a pressed block, with friction."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh

from scenes import CELLS, dimension
from scenes.covering import METHODS, SLIDINGS, covering
from scenes.tower import Tower, lift

pytestmark = pytest.mark.usefixtures("method")


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
