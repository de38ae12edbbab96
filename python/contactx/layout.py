# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where the unknowns of bulk and contacts are in vectors and matrices."""

from __future__ import annotations

from typing import Any

from petsc4py import PETSc

import numpy as np
import numpy.typing as npt

from contactx.parallel.halo import Halo

type Index = npt.NDArray[np.int64]


class Layout:
    """Each rank's displacements, followed by its multipliers."""

    def __init__(self, halo: Halo, size: int):
        """Create the layout.

        Args:
            halo: Nodes of this rank.
            size: Number of this rank's unknowns.
        """
        self._halo = halo
        self._size = int(size)
        g = halo.gdim
        counts = halo.comm.allgather((halo.num_owned * g, self._size))
        # Where the displacements of each rank start in the bulk, and in all
        self._bulk, self._all = np.cumsum([(0, 0), *counts], axis=0)[:-1].T
        self._start = int(self._all[halo.comm.rank])

    def places(self) -> Index:
        """Places of the displacements of all nodes, then of this rank's multipliers; collective."""
        halo, g = self._halo, self._halo.gdim
        own = self._start + g * np.arange(halo.num_owned, dtype=np.int64)
        nodes = (halo.scatter_forward(own)[:, None] + np.arange(g)).ravel()
        multipliers = np.arange(self._start + g * halo.num_owned, self._start + self._size)
        return np.concatenate([nodes, multipliers])

    def matrix(self) -> PETSc.Mat:
        """Matrix of all unknowns without entries."""
        size = (self._size, None)
        A = PETSc.Mat().createAIJ((size, size), comm=self._halo.comm)
        A.setUp()
        return A

    def embed(self, K: PETSc.Mat) -> PETSc.Mat:
        """The bulk's matrix with empty rows and columns for the multipliers."""
        size = (self._size, None)
        return PETSc.Mat().createAIJ((size, size), csr=self._rows(K), comm=self._halo.comm)

    def add(self, K: PETSc.Mat, A: PETSc.Mat) -> None:
        """Add the bulk's matrix to one that has its entries; entries of others may follow.

        Args:
            K: The bulk's matrix.
            A: Matrix of all unknowns.
        """
        A.setValuesIJV(*self._rows(K), addv=PETSc.InsertMode.ADD)

    def _rows(self, K: PETSc.Mat) -> tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]:
        """Entries of the bulk's matrix in compressed rows of all unknowns."""
        indptr, indices, values = K.getValuesCSR()
        multipliers = self._size - self._halo.num_owned * self._halo.gdim
        indptr = np.concatenate([indptr, np.full(multipliers, indptr[-1], dtype=indptr.dtype)])
        if len(self._all) > 1:
            rank = np.searchsorted(self._bulk, indices, side="right") - 1
            indices = (indices + (self._all - self._bulk)[rank]).astype(PETSc.IntType)
        return indptr, indices, values
