# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where displacements are on a rank, those of other ranks included, and in PETSc's matrices."""

from __future__ import annotations

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.bulk import Bulk
from contactx._host.parallel.halo import Halo
from contactx._host.system import SaddlePointSystem

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.integer]

DIFFERENT = PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN


class Numbering:
    """Where the displacements of a rank are in vectors and matrices of the bulk.

    A rank's contact entries are in its local numbers: displacements of its own nodes first, then
    those of nodes of other ranks. On one rank the local numbers are those of the bulk's matrix.

    Attributes:
        comm: Communicator.
        num_owned: Number of displacements that this rank owns.
        num_local: Number of displacements of all nodes.
        nodes: Nodes of this rank as the core sees them.
        gdim: Geometric dimension.
    """

    def __init__(self, halo: Halo):
        """Take the numbers of a halo as it is now.

        Args:
            halo: Nodes on this rank.
        """
        self._halo = halo
        self.comm = halo.comm
        self.nodes = halo.nodes
        self.gdim = gdim = halo.gdim
        self.num_owned = halo.num_owned * gdim
        self.num_local = halo.num_nodes * gdim
        self._numbers: Index | None = None
        if self.comm.size > 1:
            nodes = halo.numbers(np.arange(halo.num_nodes))
            self._numbers = (nodes[:, None] * gdim + np.arange(gdim)).ravel()

    def scatter_forward[T: np.generic](self, values: npt.NDArray[T]) -> npt.NDArray[T]:
        """Give all displacements the values that their owners have; all ranks must take part.

        Args:
            values: Values, of which the first count, shape (at least num_owned,).

        Returns:
            Values of the same type, shape (num_local,).
        """
        every: npt.NDArray[T] = self._halo.scatter_forward(
            values.reshape(-1, self._halo.gdim)
        ).ravel()
        return every

    def scatter_reverse(self, values: Array) -> Array:
        """Add what all ranks have for a displacement on its owner; all ranks must take part.

        Args:
            values: What this rank has for the displacements of all nodes, shape (num_local,).

        Returns:
            Sums at the owned ones, shape (num_owned,).
        """
        return self._halo.scatter_reverse(values.reshape(-1, self._halo.gdim)).ravel()

    def numbers(self, dofs: Index) -> Index:
        """Numbers of displacements in the bulk's matrix, shape (n,)."""
        return dofs if self._numbers is None else self._numbers[dofs]

    def index_set(self, dofs: Index) -> PETSc.IS:
        """Owned displacements as an index set of the bulk's matrix."""
        return PETSc.IS().createGeneral(_integers(self.numbers(dofs)), comm=self.comm)

    def matrix(
        self, *entries: core.Triplets, rows: Index | None = None, is_square: bool = False
    ) -> PETSc.Mat:
        """Matrix of contact entries; those of one place are added, over all ranks.

        All ranks must take part.

        Args:
            *entries: Entries in local numbers.
            rows: Owned displacements that its rows stand for, in order, when on no rank other
                rows have entries; all displacements of all ranks if None.
            is_square: Whether its columns stand for the same displacements, and entries in others
                are left out; for all displacements if False.
        """
        size = self.num_owned
        places = np.concatenate([part.rows for part in entries])
        columns = np.concatenate([part.columns for part in entries])
        if rows is None:
            places, columns = self.numbers(places), self.numbers(columns)
        else:
            size = len(rows)
            first, _ = PETSc.Vec().createMPI((size, None), comm=self.comm).getOwnershipRange()
            # PETSc leaves out negative numbers
            row = np.full(self.num_owned, -1)
            row[rows] = first + np.arange(size)
            # A row of a master may be another rank's
            every = self.scatter_forward(row)
            places = every[places]
            columns = every[columns] if is_square else self.numbers(columns)
        num_columns = size if is_square else self.num_owned
        A = PETSc.Mat().createAIJ(((size, None), (num_columns, None)), comm=self.comm)
        A.setPreallocationCOO(_integers(places), _integers(columns))
        A.setValuesCOO(np.concatenate([part.values for part in entries]), PETSc.InsertMode.ADD)
        return A


class NodeLayout:
    """Numbers and free dofs of all nodes on a rank, those of other ranks included.

    Attributes:
        numbering: Where the displacements are in the bulk's matrix.
        free: 1 at displacements that are not prescribed, else 0, shape (num_local,).
    """

    numbering: Numbering
    free: npt.NDArray[np.int8]

    def __init__(self, bulk: Bulk, system: SaddlePointSystem):
        """Create it; ``rebuild`` comes before the first use.

        Args:
            bulk: The bulk.
            system: The coupled system.
        """
        self._bulk = bulk
        self._system = system
        self._version = -1

    def reset(self) -> None:
        """Make all anew when asked for it next: prescribed displacements may be others."""
        self._version = -1

    def rebuild(self) -> None:
        """Make all anew where the nodes of this rank have changed; all ranks must take part."""
        halo = self._system.halo
        if self._version == halo.version:
            return
        self._version = halo.version
        self.numbering = Numbering(halo)
        self.free = self.numbering.scatter_forward((self._bulk.markers == 0).astype(np.int8))


def index_set(places: Index, A: PETSc.Mat) -> PETSc.IS:
    """Some of this rank's rows of a matrix, by their places among them."""
    return PETSc.IS().createGeneral(_integers(A.getOwnershipRange()[0] + places), comm=A.comm)


def diagonal_matrix(values: Array, comm: MPI.Comm) -> PETSc.Mat:
    """A matrix with nothing but a diagonal; all ranks must take part.

    PETSc's own shift moves all entries behind each one that it adds.

    Args:
        values: The diagonal in this rank's rows.
        comm: Communicator.
    """
    size = (len(values), None)
    diagonal = PETSc.Mat().createAIJ((size, size), comm=comm)
    first, last = diagonal.getOwnershipRange()
    places = _integers(np.arange(first, last))
    diagonal.setPreallocationCOO(places, places)
    diagonal.setValuesCOO(values)
    return diagonal


def own_columns(A: PETSc.Mat) -> PETSc.IS:
    """This rank's columns of a matrix."""
    first, last = A.getOwnershipRangeColumn()
    return PETSc.IS().createStride(last - first, first, comm=A.comm)


def _integers(numbers: Index) -> npt.NDArray[np.integer]:
    return numbers.astype(PETSc.IntType)
