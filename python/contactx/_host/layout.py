# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where the unknowns of bulk and contacts are in vectors and matrices."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx._host.parallel.halo import Halo

type Index = npt.NDArray[np.int64]
type Rows = tuple[Index, Index, npt.NDArray[np.float64]]


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
        counts = halo.comm.allgather((self._num_bulk, self._size))
        # Where the displacements of each rank start in the bulk, and in all
        self._bulk, self._all = np.cumsum([(0, 0), *counts], axis=0)[:-1].T
        self._start = int(self._all[halo.comm.rank])

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

    def rows(self, K: PETSc.Mat) -> Rows:
        """Rows of the bulk's matrix, with places of all unknowns for columns."""
        indptr, indices, values = K.getValuesCSR()
        columns = indices.astype(np.int64)
        if len(self._all) > 1:
            rank = np.searchsorted(self._bulk, columns, side="right") - 1
            columns += (self._all - self._bulk)[rank]
        return indptr.astype(np.int64), columns, values
