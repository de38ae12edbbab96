# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact blocks of the Jacobian, row by row."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface

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

    def scaled(self, factor: float) -> Entries:
        """The entries times a factor."""
        return Entries(self.rows, self.columns, factor * self.values)

    def matrix(self, shape: tuple[int, int]) -> PETSc.Mat:
        """AIJ matrix of this rank alone; entries of one place are added."""
        A = PETSc.Mat().createAIJ(shape, comm=PETSc.COMM_SELF)
        A.setPreallocationCOO(self.rows.astype(PETSc.IntType), self.columns.astype(PETSc.IntType))
        A.setValuesCOO(self.values, PETSc.InsertMode.ADD)
        return A


def entries_of(A: PETSc.Mat) -> Entries:
    """Entries of a matrix that are not zero."""
    indptr, columns, values = A.getValuesCSR()
    rows = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
    return Entries(rows, columns, values).select(values != 0)


def multiplied(A: PETSc.Mat, x: Array) -> Array:
    """Product of a matrix and an array."""
    vector, product = A.createVecs()
    vector.array[:] = x
    A.mult(vector, product)
    result: Array = product.array
    return result


def joined(parts: list[Entries]) -> Entries:
    """All entries of several matrices."""
    return Entries(
        np.concatenate([p.rows for p in parts]),
        np.concatenate([p.columns for p in parts]),
        np.concatenate([p.values for p in parts]),
    )


@dataclass(frozen=True)
class ContactBlocks:
    """Blocks of a rank's contact part of a Jacobian, in its unknowns (displacements, multipliers).

    The displacements are those of all nodes on the rank. Entries of one place add up, those of
    other ranks included.

    Attributes:
        traction: Derivative of the displacements' rows by the multipliers, (dof, multiplier).
        constraint: Derivative of the multipliers' rows by the displacements, (multiplier, dof).
        stiffness: Derivative of the displacements' rows by the displacements.
    """

    traction: Entries
    constraint: Entries
    stiffness: Entries

    @staticmethod
    def of(contact: PETSc.Mat, num_local: int) -> ContactBlocks:
        """Sort a matrix into blocks.

        Args:
            contact: Contact part of the Jacobian, of this rank's pairs.
            num_local: Number of displacements of all nodes on this rank.
        """
        every = entries_of(contact)
        below, right = every.rows >= num_local, every.columns >= num_local
        traction, constraint = every.select(~below & right), every.select(below & ~right)
        traction.columns = traction.columns - num_local
        constraint.rows = constraint.rows - num_local
        return ContactBlocks(traction, constraint, every.select(~below & ~right))


def lumped(
    blocks: ContactBlocks,
    interfaces: Sequence[Interface],
    is_slave: npt.NDArray[np.bool_],
    gdim: int,
) -> ContactBlocks:
    """Blocks in which a slave node stands for the others of its facets.

    What is integrated over slave facets feels all of their nodes as they slide, if only by the
    angle between the surfaces, and ties turn with them. As if all moved like the constraint's own
    node, the slave side is diagonal.

    Args:
        blocks: Contact blocks of a Jacobian.
        interfaces: Discrete sides of the contacts.
        is_slave: Whether each of all nodes is slave in each contact, shape (num_nodes, contacts).
        gdim: Geometric dimension.

    Returns:
        The same blocks where there are no such entries.
    """
    own = np.concatenate([np.repeat(i.slaves, i.nodes.size) for i in interfaces])
    contact = np.repeat(
        np.arange(len(interfaces)), [len(i.slaves) * i.nodes.size for i in interfaces]
    )

    def moved(dofs: Index, multipliers: Index) -> Index:
        node, home = dofs // gdim, own[multipliers]
        away = is_slave[node, contact[multipliers]] & (node != home)
        return np.where(away, home * gdim + dofs % gdim, dofs)

    C, T = blocks.constraint, blocks.traction
    columns, rows = moved(C.columns, C.rows), moved(T.rows, T.columns)
    if np.array_equal(columns, C.columns) and np.array_equal(rows, T.rows):
        return blocks
    return replace(
        blocks,
        constraint=Entries(C.rows, columns, C.values),
        traction=Entries(rows, T.columns, T.values),
    )


class NotCondensable(Exception):
    """A multiplier has no equation of its own; the message says which."""
