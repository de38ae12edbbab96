# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The coupled system of bulk and contacts: one vector, one matrix.

Each rank's unknowns are its displacements followed by the multipliers of each contact, all of them
lengths, and all rows are forces: see ``solve/system.h``.
"""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.bulk import Bulk, Index, Rows
from contactx._host.bulk_host import BulkHost
from contactx._host.discrete_contact import DiscreteContact
from contactx._host.parallel.halo import Halo
from contactx._host.parallel.reduce import anywhere, everywhere
from contactx.conductance import Conductance, add_entries


class Layout:
    """Each rank's displacements, followed by the bulk's other fields and by its multipliers."""

    def __init__(self, halo: Halo, num_bulk: int, size: int):
        """Create the layout.

        Args:
            halo: Nodes of this rank.
            num_bulk: Number of the bulk's unknowns of this rank.
            size: Number of this rank's unknowns.
        """
        self._halo = halo
        self._num_bulk, self._size = int(num_bulk), int(size)
        counts = halo.comm.allgather(self._size)
        # Where this rank's displacements start
        self._start = sum(counts[: halo.comm.rank])

    def places(self) -> Index:
        """Places of the displacements of all nodes, then of this rank's multipliers; collective."""
        halo, g = self._halo, self._halo.gdim
        own = self._start + g * np.arange(halo.num_owned, dtype=np.int64)
        nodes = (halo.scatter_forward(own)[:, None] + np.arange(g)).ravel()
        multipliers = np.arange(self._start + self._num_bulk, self._start + self._size)
        return np.concatenate([nodes, multipliers])

    def bulk(self) -> Index:
        """Places of the bulk's unknowns of this rank."""
        return np.arange(self._start, self._start + self._num_bulk, dtype=np.int64)

    def matrix(self, rows: Rows) -> PETSc.Mat:
        """Matrix of all unknowns; all ranks must take part.

        Args:
            rows: This rank's rows, in places.
        """
        size, (offsets, columns, values) = (self._size, None), rows
        csr = offsets.astype(PETSc.IntType), columns.astype(PETSc.IntType), values
        return PETSc.Mat().createAIJ((size, size), csr=csr, comm=self._halo.comm)


class SaddlePointSystem:
    """Residual and Jacobian of the displacement and the multipliers.

    Unknowns and rows of a rank are those of the nodes that it owns. What is assembled from its
    pairs concerns all nodes that it has.

    Attributes:
        core: The core's part: residual and unknowns.
        x: Unknowns.
        b: Residual.
        discrete_contacts: Contacts on the discrete bulk.
        halo: Nodes of this rank.
        num_displacements: Number of displacements of this rank.
        num_bulk: Number of the bulk's unknowns of this rank, displacements first.
        block: Displacements a node.
    """

    def __init__(self, bulk: Bulk, discrete_contacts: Sequence[DiscreteContact], halo: Halo):
        """Lay out the unknowns.

        Args:
            bulk: The bulk.
            discrete_contacts: Contacts on the discrete bulk.
            halo: Nodes of this rank.
        """
        self._bulk = bulk
        self.core = core.System(halo.nodes, BulkHost(bulk, halo), list(discrete_contacts))
        self.discrete_contacts = list(discrete_contacts)
        self.halo = halo
        self._comm = halo.comm
        self.block = halo.gdim
        self.num_displacements = halo.num_owned * halo.gdim
        self._offsets = self.core.offsets
        self.num_bulk = self._offsets[1]
        self._make_vectors()
        self._layout = Layout(halo, self.num_bulk, self._offsets[-1])
        # Rows of the bulk, and the number of its assemblies when they were taken
        self._rows: tuple[int, Rows] | None = None
        # Places of the entries of the last Jacobian
        self._pattern: tuple[npt.NDArray[np.int64], ...] = ()

    @property
    def num_local(self) -> int:
        """Number of displacements of all nodes that this rank has."""
        return int(self.halo.num_nodes * self.block)

    def begin_step(self) -> None:
        """Start a step."""
        # An error inside PETSc leaves the old ones locked
        self._make_vectors()

    def _make_vectors(self) -> None:
        self.x = PETSc.Vec().createMPI((self._offsets[-1], None), comm=self._comm)
        self.b = self.x.duplicate()

    def pack(self) -> None:
        """Write the unknowns from the functions into ``x``."""
        self.core.unknowns(self.x.array)

    def unpack(self, x: PETSc.Vec) -> None:
        """Write the unknowns from a vector into the functions; all ranks must take part."""
        self.core.take(x.array_r)

    def bulk_residual(self) -> npt.NDArray[np.float64]:
        """Residual of the bulk alone, assembled anew only where the displacement has changed."""
        return self.core.bulk_residual()

    def residual(self, b: PETSc.Vec) -> None:
        """Assemble the residual at the functions' state; pairs and status are as they stand.

        Args:
            b: Vector that is overwritten.
        """
        self.core.residual(b.array)

    def jacobian(
        self, A: PETSc.Mat | None = None, springs: npt.NDArray[np.float64] | None = None
    ) -> PETSc.Mat:
        """Assemble the Jacobian at the functions' state.

        Args:
            A: What the last call returned: it is written to if it has the right places.
            springs: What is added to the diagonal of the displacements, shape (num_displacements,).

        Returns:
            The Jacobian.
        """
        contact = core.ContactBlock(self.discrete_contacts, self.core.markers(), keeps_zeros=True)
        places = self.places()
        rows, others, added = core.coupled_rows(
            *self._bulk_rows(), contact, places, self.num_displacements, self.num_local
        )
        pattern = (*rows[:2], others, *added[:2])
        same = A is not None and all(map(np.array_equal, pattern, self._pattern))
        if A is None or not everywhere(self._comm, same):
            self._pattern = pattern
            A = self._layout.matrix(rows)
        else:
            A.zeroEntries()
            _add(A, rows, None)
        if anywhere(self._comm, len(others) > 0):
            A.assemble(PETSc.Mat.AssemblyType.FLUSH)
            A.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
            _add(A, added, others)
        for conductance in self._bulk.conductances:
            self._add_conductance(A, conductance, places)
        A.assemble()
        self.finish(A, springs)
        return A

    def finish(self, A: PETSc.Mat, springs: npt.NDArray[np.float64] | None) -> None:
        """Add what holds free bodies to an assembled Jacobian, and take the unknowns' units.

        Args:
            A: Jacobian by displacements and multipliers.
            springs: What is added to the diagonal of the displacements, shape (num_displacements,).
        """
        diagonal = self.x.duplicate()
        if springs is not None:
            diagonal.array[: self.num_displacements] = springs
            A.setDiagonal(diagonal, addv=PETSc.InsertMode.ADD)
        diagonal.array[: self.num_bulk] = 1
        diagonal.array[self.num_bulk :] = self.core.factors
        A.diagonalScale(None, diagonal)

    def places(self) -> npt.NDArray[np.int64]:
        """Places of the displacements of all nodes, then of this rank's multipliers; collective."""
        return self._layout.places()

    def blocks(self, A: PETSc.Mat) -> dict[str, PETSc.Mat]:
        """Split a matrix of all unknowns into its blocks [[K, B], [C, D]].

        Args:
            A: The matrix.
        """
        n, size = self.num_bulk, self.x.getLocalSize()
        first, _ = self.x.getOwnershipRange()
        u, w = (
            PETSc.IS().createStride(count, first=first + start, comm=self._comm)
            for start, count in ((0, n), (n, size - n))
        )
        return {
            name: A.createSubMatrix(row, column)
            for name, row, column in (("K", u, u), ("B", u, w), ("C", w, u), ("D", w, w))
        }

    def _add_conductance(
        self, A: PETSc.Mat, conductance: Conductance, places: npt.NDArray[np.int64]
    ) -> None:
        """Add the derivatives of a conductance; all ranks must take part.

        Args:
            A: Jacobian, not scaled yet.
            conductance: What flows.
            places: Places of the displacements of all nodes, then of this rank's multipliers.
        """
        bulk, discrete = self._bulk, conductance.contact.discrete
        k = bulk.number_of(conductance.field)
        count = conductance.field.function_space.dofmap.index_map.size_local
        first = self._layout.bulk()[:1] + self.num_displacements + bulk.first_of(k)
        dofs = conductance.at_nodes(first + np.arange(count, dtype=np.int64))
        free = conductance.at_nodes(bulk.blocks.markers[k].astype(np.int64)) == 0
        at = self._offsets[1 + self.discrete_contacts.index(discrete)] - self.num_bulk
        all_columns = dofs, places, places[self.num_local + at :]
        derivatives = conductance.derivatives()
        A.assemble(PETSc.Mat.AssemblyType.FLUSH)
        A.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
        for entries, columns in zip(derivatives, all_columns, strict=True):
            rows, column, values = entries.rows, columns[entries.columns], entries.values
            keep = free[rows]
            add_entries(A, dofs[rows[keep]], column[keep], values[keep])

    def _bulk_rows(self) -> Rows:
        """Rows of the bulk's Jacobian, which are kept where it does not change."""
        bulk = self._bulk
        bulk.update()
        if self._rows is None or not bulk.is_linear or self._rows[0] != bulk.assemblies:
            self._rows = bulk.assemblies, bulk.rows_in(self._layout.bulk())
        return self._rows[1]

    @property
    def has_friction(self) -> bool:
        """True if any contact measures slip."""
        return any(discrete.history is not None for discrete in self.discrete_contacts)


def _add(A: PETSc.Mat, rows: Rows, which: npt.NDArray[np.int64] | None) -> None:
    """Add rows to a matrix: those of this rank, or some by their places."""
    offsets, columns, values = rows
    A.setValuesIJV(
        offsets.astype(PETSc.IntType),
        columns.astype(PETSc.IntType),
        values,
        addv=PETSc.InsertMode.ADD,
        rowmap=None if which is None else which.astype(PETSc.IntType),
    )
