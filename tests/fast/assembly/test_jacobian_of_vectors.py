# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Jacobian of the whole system with friction and with ties against central differences."""

import numpy as np

import contactx as cx
from contactx import cpp as core

from scenes import CELLS, Blocks
from scenes.covering import BOTH, METHODS, covering

OBSTACLES = ["facets", "plane", "sphere", "level set"]


def obstacle(kind, gdim):
    centre = np.full(gdim, 0.7)
    if kind == "facets":
        return None
    if kind == "plane":
        return cx.Plane(centre * 0, np.linspace(-0.2, 1, gdim))
    if kind == "sphere":
        centre[-1] = -2
        return cx.Sphere(centre, 2.0)
    return cx.LevelSet(lambda x: x[gdim - 1] + 0.2 * (x[0] - 0.7) ** 2)


def scene_with(cell, sliding, master, **options):
    """A random state in the middle of a step, with a prescribed part that has arrived."""
    scene = Blocks(cell, gap=0.05)
    gdim = scene.u.function_space.mesh.geometry.dim
    contact = scene.contact(sliding, master=obstacle(master, gdim), **options)
    problem = scene.problem(contact)
    discrete, nodes = contact.discrete, contact.discrete.nodes
    rng = np.random.default_rng(6)

    def displace():
        scene.u.x.array[:] = 0.02 * rng.standard_normal(len(scene.u.x.array))
        for bc in scene.bcs:
            bc.set(scene.u.x.array)

    displace()
    discrete.search()
    discrete.update_gap()
    discrete.accept()
    discrete.begin_step()
    displace()
    discrete.search()
    n = len(nodes.area)
    # Some directions that Dirichlet conditions have left immobile
    nodes.mobile[:] = rng.random((n, gdim)) < 0.9
    discrete.update_gap()
    assert discrete.master.paired.all()
    contact.multiplier[:] = rng.uniform(-1, 1, (n, gdim)) + 1.5 * nodes.normal
    nodes.c[:] = rng.uniform(1, 2, n)
    return problem, discrete, rng


def assert_consistent(problem, discrete):
    """Every kind of column: free displacements and all multipliers."""
    system = problem.assembler.system
    system.pack()
    x0 = system.x.array.copy()

    def residual(x):
        system.x.array = x
        system.unpack(system.x)
        system.residual(system.b)
        return system.b.array.copy()

    residual(x0)
    J = system.jacobian().convert("dense").getDenseArray()
    m = len(discrete.nodes.multiplier)
    free = np.flatnonzero(np.r_[problem.assembler.bulk.markers == 0, np.ones(m, dtype=bool)])
    gdim = discrete.nodes.size
    slaves = (discrete.slaves[:, None] * gdim + np.arange(gdim)).ravel()
    few = free[:: max(1, len(free) // 30)]
    h = 1e-6
    for column in np.union1d(few, slaves[:: max(1, len(slaves) // 15)]):
        dx = np.zeros_like(x0)
        dx[column] = h
        difference = (residual(x0 + dx) - residual(x0 - dx)) / (2 * h)
        error = np.abs(J[free, column] - difference[free]).max()
        assert error <= 1e-7 * np.abs(J).max()


@covering(cell=CELLS, master=OBSTACLES, **{"sliding,method": BOTH})
def test_with_friction(cell, sliding, method, master):
    problem, discrete, rng = scene_with(cell, sliding, master, friction=0.4, method=method)
    nodes = discrete.nodes
    nodes.status[:] = rng.permutation(np.arange(len(nodes.status)) % 3)
    assert np.abs(nodes.slip).max() > 1e-3
    assert_consistent(problem, discrete)


@covering(cell=CELLS, method=METHODS)
def test_with_frozen_kinematics(cell, method):
    problem, discrete, rng = scene_with(cell, "finite", "facets", friction=0.4, method=method)
    discrete.freeze(True)
    discrete.nodes.status[:] = rng.integers(3, size=len(discrete.nodes.status))
    assert_consistent(problem, discrete)
    # Kinematics are frozen indeed
    assert discrete.forms().K == []


@covering(cell=CELLS, method=METHODS, master=("facets", "sphere"))
def test_after_the_nodes_have_touched(cell, method, master):
    problem, discrete, rng = scene_with(cell, "finite", master, friction=0.4, method=method)
    before = discrete.nodes.slip.copy()
    discrete.update_status()
    assert np.abs(discrete.nodes.slip - before).max() > 1e-3
    discrete.nodes.status[:] = rng.integers(1, 3, size=len(discrete.nodes.status))
    assert_consistent(problem, discrete)


@covering(cell=CELLS, master=OBSTACLES, **{"sliding,method": BOTH})
def test_with_ties(cell, sliding, method, master):
    problem, discrete, _ = scene_with(cell, sliding, master, tied=True, method=method)
    nodes = discrete.nodes
    discrete.update_status()
    assert np.all(nodes.status == core.STICK)
    nodes.status[::4] = core.OPEN
    assert np.abs(nodes.slip).max() > 1e-3
    assert_consistent(problem, discrete)
