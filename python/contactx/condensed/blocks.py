# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact blocks of the Jacobian, row by row."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.integer]


class Entries:
    """Entries of a sparse matrix as triplets.

    Attributes:
        rows: Rows.
        columns: Columns.
        values: Values.
    """

    def __init__(self, rows: Index, columns: Index, values: Array):
        """Take triplets of the same length."""
        self.rows, self.columns, self.values = rows, columns, values

    def select(self, which: npt.NDArray[np.bool_]) -> Entries:
        """Some of the entries."""
        return Entries(self.rows[which], self.columns[which], self.values[which])

    def matrix(self, size: int) -> PETSc.Mat:
        """Square AIJ matrix; entries of one place are added."""
        order = np.argsort(self.rows, kind="stable")
        indptr = np.searchsorted(self.rows[order], np.arange(size + 1)).astype(PETSc.IntType)
        A = PETSc.Mat().createAIJ((size, size), comm=PETSc.COMM_SELF)
        A.setPreallocationNNZ(np.maximum(np.diff(indptr), 0).astype(PETSc.IntType))
        A.setValuesIJV(
            indptr,
            self.columns[order].astype(PETSc.IntType),
            self.values[order],
            addv=PETSc.InsertMode.ADD,
        )
        A.assemble()
        return A


def joined(parts: list[Entries]) -> Entries:
    """All entries of several matrices."""
    return Entries(
        np.concatenate([p.rows for p in parts]),
        np.concatenate([p.columns for p in parts]),
        np.concatenate([p.values for p in parts]),
    )


class ContactBlocks:
    """Blocks of the contact part of a Jacobian, in the unknowns (displacements, multipliers).

    Attributes:
        traction: Derivative of the displacements' rows by the multipliers, (dof, multiplier).
        constraint: Derivative of the multipliers' rows by the displacements, (multiplier, dof).
        stiffness: Derivative of the displacements' rows by the displacements.
    """

    def __init__(self, contact: PETSc.Mat, num_bulk: int):
        """Sort a matrix into blocks.

        Args:
            contact: Contact part of the Jacobian.
            num_bulk: Number of displacements.
        """
        indptr, columns, values = contact.getValuesCSR()
        rows = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
        every = Entries(rows, columns, values).select(values != 0)
        below, right = every.rows >= num_bulk, every.columns >= num_bulk
        self.stiffness = every.select(~below & ~right)
        self.traction = every.select(~below & right)
        self.traction.columns = self.traction.columns - num_bulk
        self.constraint = every.select(below & ~right)
        self.constraint.rows = self.constraint.rows - num_bulk
