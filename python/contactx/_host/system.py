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
from contactx._host.bulk import Bulk, Entries, Index
from contactx._host.bulk_host import BulkHost
from contactx._host.discrete_contact import DiscreteContact
from contactx._host.parallel.halo import Halo
from contactx._host.parallel.reduce import everywhere
from contactx.conductance import Conductance


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

    def matrix(self) -> PETSc.Mat:
        """Matrix of all unknowns without entries; all ranks must take part."""
        size = self._size, None
        return PETSc.Mat().createAIJ((size, size), comm=self._halo.comm)


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
        # Entries of the bulk, and the number of its assemblies when they were taken
        self._of_bulk: tuple[int, Entries] | None = None
        # Rows and columns of the entries of the last Jacobian
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
        parts = [self._bulk_entries(), contact.entries(places)]
        for conductance in self._bulk.conductances:
            parts += self._conducted(conductance, places)
        rows, columns, values = (np.concatenate(each) for each in zip(*parts, strict=True))
        same = A is not None and all(map(np.array_equal, (rows, columns), self._pattern))
        if A is None or not everywhere(self._comm, same):
            self._pattern = rows, columns
            A = self._layout.matrix()
            # PETSc adds entries of one place, and brings those of other ranks' rows there
            A.setPreallocationCOO(rows.astype(PETSc.IntType), columns.astype(PETSc.IntType))
        A.setValuesCOO(values, addv=PETSc.InsertMode.INSERT)
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

    def _conducted(self, conductance: Conductance, places: Index) -> list[Entries]:
        """Derivatives of a conductance; all ranks must take part.

        Args:
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
        parts = []
        for entries, columns in zip(conductance.derivatives(), all_columns, strict=True):
            rows, column, values = entries.rows, columns[entries.columns], entries.values
            keep = free[rows]
            parts.append((dofs[rows[keep]], column[keep], values[keep]))
        return parts

    def _bulk_entries(self) -> Entries:
        """Entries of the bulk's Jacobian, which are kept where it does not change."""
        bulk = self._bulk
        bulk.update()
        if self._of_bulk is None or self._of_bulk[0] != bulk.assemblies:
            self._of_bulk = bulk.assemblies, bulk.entries(self._layout.bulk())
        return self._of_bulk[1]

    @property
    def has_friction(self) -> bool:
        """True if any contact measures slip."""
        return any(discrete.history is not None for discrete in self.discrete_contacts)
