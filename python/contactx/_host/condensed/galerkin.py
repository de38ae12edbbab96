# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Galerkin products of the change that contact makes to the bulk's matrix, on every level."""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from contactx._host.condensed.chains import add_terms
from contactx._host.condensed.numbering import DIFFERENT, Index, index_set, own_columns
from contactx._host.condensed.operator import ContactUpdate
from contactx._host.parallel import reduce

# Changed eliminated dofs, as a fraction of all of them, up to which a hierarchy is kept as it is
_MAX_CHANGED_FRACTION = 0.25


class Galerkin:
    """Adds Q^T (T^T K T - K + springs) Q to the matrices of the coarser levels, T = I + right.

    T differs from one in the rows of eliminated displacements e alone: with X = R_e Q, Y = K_e Q
    and M = X^T (Y + K_ee X / 2) it is M + M^T and the springs, products of few rows. Where these
    displacements need one another the first terms of the series of (I - C)^-1 R_e take the place
    of R_e. What the turning of normals adds to K is left to the finest level.
    """

    def __init__(self, comm: MPI.Comm, slave_rows: PETSc.Mat, prolongations: Sequence[PETSc.Mat]):
        """Create the projections.

        Args:
            comm: Communicator.
            slave_rows: Rows of the bulk's matrix at the displacements of all slave nodes.
            prolongations: To the finest level, to the next coarser one, and so on.
        """
        self._comm = comm
        self._prolongations = list(prolongations)
        self._rows = [slave_rows]
        for Q in prolongations:
            self._rows.append(self._rows[-1].matMult(Q))
        self._added: list[PETSc.Mat | None] = [None for _ in prolongations]
        self._eliminated: Index = np.zeros(0, dtype=np.int64)

    def nearly_serves(self, update: ContactUpdate) -> bool:
        """True if the eliminated displacements of both states are nearly the same.

        All ranks must take part, and have the same answer.
        """
        new = np.setxor1d(update.places, self._eliminated, assume_unique=True)
        changed, count = reduce.total(self._comm, np.array([len(new), len(update.places)]))
        return update.springs is None and bool(changed <= _MAX_CHANGED_FRACTION * count)

    def update(self, update: ContactUpdate, matrices: Sequence[PETSc.Mat]) -> None:
        """Bring the matrices of the coarser levels from one state of the contacts to another.

        All ranks must take part.

        Args:
            update: What contact changes now.
            matrices: Matrices of the levels, in the order of the prolongations.
        """
        X, springs = update.right, update.springs
        chosen = index_set(update.places, self._rows[0])
        levels = zip(self._prolongations, self._rows[1:], matrices, strict=True)
        for level, (Q, rows, A) in enumerate(levels):
            X = X.matMult(Q)
            if level == 0 and update.chains is not None:
                add_terms(X, update.chains)
            Y = update.block.matMult(X)
            Y.scale(0.5)
            Y.axpy(1.0, rows.createSubMatrix(chosen, own_columns(rows)), DIFFERENT)
            change = X.transposeMatMult(Y)
            change.axpy(1.0, change.transpose(PETSc.Mat()), DIFFERENT)
            if springs is not None:
                springs = springs.ptap(Q)
                change.axpy(1.0, springs, DIFFERENT)
            before, self._added[level] = self._added[level], change.copy()
            if before is not None:
                change.axpy(-1.0, before, DIFFERENT)
            A.axpy(1.0, change, DIFFERENT)
        self._eliminated = update.places
