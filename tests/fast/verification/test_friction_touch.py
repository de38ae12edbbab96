# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A node that touches first within a step slips only from where it touches.

Where that is does not depend on how much of a Newton step is taken.
"""

from functools import partial

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import pytest

import contactx as cx
from contactx import cpp as core
from dolfinx.mesh import CellType

from scenes import CELLS, dimension
from scenes.covering import BOTH, covering
from scenes.driven import DrivenBlock
from scenes.materials import neo_hookean

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
        ksp = PETSc.KSP().create(MPI.COMM_WORLD)
        ksp.setType("preonly")
        ksp.getPC().setType("lu")
        ksp.getPC().setFactorSolverType("mumps")
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
