# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A linear system whose one matrix is filled anew, with and without zero rows."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import cast

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from contactx._host.algebra import Algebra
from contactx._host.bulk import Bulk
from contactx._host.system import SaddlePointSystem

N = 24


class Refilled:
    """Laplace's matrix of a line, whose rows may be zero.

    Attributes:
        is_singular: Whether the next matrix has zero rows.
    """

    def __init__(self) -> None:
        self.halo = SimpleNamespace(comm=MPI.COMM_WORLD)
        self.is_singular = False

    def jacobian(self, A: PETSc.Mat | None, springs: object) -> PETSc.Mat:
        """Fill the matrix."""
        if A is None:
            A = PETSc.Mat().createAIJ((N, N), nnz=3, comm=self.halo.comm)
        for i in range(*A.getOwnershipRange()):
            part = 0.0 if self.is_singular and i in (5, 6, 20) else 1.0
            for j in range(max(i - 1, 0), min(i + 2, N)):
                A[i, j] = part * (2.0 if i == j else -1.0)
        A.assemble()
        return A


def sizes(singular: Sequence[bool]) -> list[float]:
    """Largest entry of the solution of each of some systems in turn, with factors that are kept."""
    system = Refilled()
    bulk = cast(Bulk, SimpleNamespace(comm=MPI.COMM_WORLD))
    algebra = Algebra(bulk, cast(SaddlePointSystem, system), "refilled_")
    solver = algebra.direct_solver()
    found = []
    for system.is_singular in singular:
        b, x = system.jacobian(None, None).createVecs()
        b.set(1.0)
        solver.assemble(None)
        x.set(np.inf)
        if solver.factorise():
            solver.solve(b.array_r, x.array, 1e-9, 40)
        found.append(float(x.norm(PETSc.NormType.INFINITY)))
    return found


# x_i = (i + 1) (N - i) / 2 where no row is zero
LARGEST = float(np.max(np.arange(1, N + 1) * np.arange(N, 0, -1)) / 2)
