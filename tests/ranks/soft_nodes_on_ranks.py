# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One solve with soft nodes on a master that yields: prints the largest relative residual."""

from mpi4py import MPI

import numpy as np

from contactx import cpp as core
from contactx._host.algebra import Algebra
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.closed import close_all
from story import METHODS

COMM = MPI.COMM_WORLD
LAWS = ({}, {"tied": True})


def total(values):
    """Sum of squares over ranks."""
    return COMM.allreduce(float(values @ values))


def residual(law):
    """Relative residual of a solve with springs of 1e-8 to 100 in c times the area; collective."""
    scene = Blocks(CellType.hexahedron, n_upper=4, n_lower=3)
    contact = scene.contact("small", **law)
    problem = scene.problem(contact, petsc_options={"pc_type": "condensed"})
    nodes = close_all(contact)
    rng = np.random.default_rng(COMM.rank)
    laws = nodes.by_multiplier.reshape(-1, nodes.size, nodes.size)
    for i in np.flatnonzero(nodes.closed):
        laws[i] = np.diag(nodes.area[i] * 10 ** rng.uniform(-8, 2, nodes.size))
    system, bulk = problem.assembler.system, problem.assembler.bulk
    b = rng.standard_normal(system.x.getLocalSize())
    n = system.num_displacements
    b[:n][bulk.markers[:n] == 1] = 0
    solver = core.CondensedSolver(problem.assembler.core, Algebra(bulk, system, "soft_"))
    x, product = np.empty_like(b), np.empty_like(b)
    solver.solve(b, x)
    statistics = solver.statistics()
    assert not statistics.direct and not statistics.by_bodies
    assert statistics.iterations <= 60, statistics.iterations
    solver.multiply(x, product)
    return np.sqrt(total(product - b) / total(b))


def main():
    found = max(residual({"method": method, **law}) for method in METHODS for law in LAWS)
    if COMM.rank == 0:
        print(found)


if __name__ == "__main__":
    main()
