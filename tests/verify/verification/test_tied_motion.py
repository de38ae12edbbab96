# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ties under large rotations: they turn with the facets and carry nothing."""

from mpi4py import MPI

import numpy as np
import pytest

import contactx as cx
from dolfinx import fem, mesh

from scenes import CELLS, dimension
from scenes.covering import METHODS, covering
from scenes.tower import Tower, lift

pytestmark = pytest.mark.usefixtures("method")

every_gap = covering(cell=CELLS, gap=(0.0, 0.1, -0.05), method=METHODS)


def rotation(gdim, degrees):
    """About an axis that is none of the mesh's."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    if gdim == 2:
        return np.array([[c, -s], [s, c]])
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    K = np.cross(np.eye(3), axis)
    return np.eye(3) + s * K + (1 - c) * K @ K


def turned(gdim, degrees):
    Q = rotation(gdim, degrees)
    return lambda x: x @ Q.T + np.linspace(0.2, -0.1, gdim)


@every_gap
def test_rotation_of_both_ends_leaves_no_traction(cell, gap):
    tower = Tower(cell, 2, 3, tied=True, nu=0.3, gap=gap, neo=True)
    for degrees in (15, 30):
        motion = turned(tower.gdim, degrees)
        tower.move(motion)
    assert np.abs(tower.moved - motion(tower.X)).max() <= 1e-10
    assert np.abs(tower.contact.multiplier).max() <= 1e-10
    assert tower.contact.discrete.nodes.gap == pytest.approx(gap, abs=1e-10)
    assert np.all(tower.contact.discrete.nodes.status == 1)


@every_gap
def test_turned_tension_is_tension_that_has_turned(cell, gap):
    """First pulled, then turned: the same traction in the turned axes, and quadratic."""
    tower = Tower(cell, 2, 3, tied=True, nu=0.3, gap=gap, neo=True)
    gdim = tower.gdim
    pull = lift(gdim, 0.1, 0.05)

    def pulled(x):
        return x + np.where(x[:, -1:] > 0, pull, 0)

    tower.move(pulled)
    force, traction = tower.contact.force.copy(), tower.contact.multiplier.copy()
    assert force[-1] < -0.01
    for degrees in (15, 30):
        Q = rotation(gdim, degrees)
        tower.move(lambda x, Q=Q: pulled(x) @ Q.T)
    assert tower.contact.force == pytest.approx(Q @ force, abs=1e-10)
    assert np.abs(tower.contact.multiplier - traction @ Q.T).max() <= 1e-9
    assert tower.problem.report.iterations <= 7
    assert np.abs(tower.problem.report.imbalance).max() <= 1e-13


@every_gap
def test_a_plane_that_turns_takes_its_body_along(cell, gap):
    gdim = dimension(cell)
    domain = mesh.create_unit_interval(MPI.COMM_SELF, 1)
    start = np.full(gdim, 0.3)
    start[-1] = 0.0
    point, normal = fem.Constant(domain, start), fem.Constant(domain, lift(gdim, 1))
    tower = Tower(
        cell,
        2,
        2,
        master=cx.Plane(point, normal),
        tied=True,
        nu=0.3,
        gap=gap,
        neo=True,
        free_top=True,
    )
    shift = np.linspace(0.2, -0.1, gdim)
    for degrees in (15, 30):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        Q = np.eye(gdim)
        Q[np.ix_([0, -1], [0, -1])] = [[c, s], [-s, c]]
        point.value[:] = start + shift
        normal.value[:] = Q @ lift(gdim, 1)
        tower.problem.solve()
        expected = start + shift + (tower.X[tower.upper] - start) @ Q.T
        assert np.abs(tower.moved[tower.upper] - expected).max() <= 1e-9
        assert np.abs(tower.contact.multiplier).max() <= 1e-9
        assert tower.problem.report.iterations <= 9
