# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows of arrays that the ranks share out, in an order that does not depend on how."""

from __future__ import annotations

import hashlib
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

type Array = npt.NDArray[Any]


class Rows:
    """Rows of all ranks, told apart by keys that are the same on any number of ranks.

    Attributes:
        digest: What differs where the keys of all ranks do, shape (32,); empty but on rank 0.
    """

    def __init__(self, comm: MPI.Comm, keys: npt.NDArray[np.integer]):
        """Find the order of the rows: that of their keys; all ranks must take part.

        Args:
            comm: Communicator.
            keys: Whole numbers that no other row has, on this rank or another one, shape (n, k)
                with the same k on all ranks.

        Raises:
            ValueError: If two rows of several ranks have the same key.
        """
        self._comm = comm
        self._counts: list[int] = comm.allgather(len(keys))
        self._order = np.zeros(0, dtype=np.int64)
        self.digest = np.zeros(0, dtype=np.uint8)
        gathered = self._gather(np.asarray(keys, dtype=np.int64))
        twice = False
        if gathered is not None:
            # The first column counts most
            self._order = np.lexsort(gathered.T[::-1])
            ordered = gathered[self._order]
            twice = bool(np.any(np.all(np.diff(ordered, axis=0) == 0, axis=1)))
            self.digest = np.frombuffer(hashlib.sha256(ordered.tobytes()).digest(), np.uint8)
        if comm.size > 1 and comm.bcast(twice):
            raise ValueError(
                "two nodes or cells have the same number in the mesh as it was made: make the "
                "mesh with mesh.create_mesh from nodes that are numbered once, or use one rank"
            )

    def gather(self, values: Array) -> Array | None:
        """Bring rows to rank 0; all ranks must take part.

        Args:
            values: Rows of this rank, shape (n, ...), of one type and width on all ranks that have
                some.

        Returns:
            Rows of all ranks in the order of their keys; None but on rank 0.
        """
        gathered = self._gather(values)
        return None if gathered is None else gathered[self._order]

    def scatter(self, values: Array | None) -> Array:
        """Bring rows from rank 0 to where they belong; all ranks must take part.

        Args:
            values: Rows of all ranks in the order of their keys; None but on rank 0.

        Returns:
            Rows of this rank, shape (n, ...).
        """
        comm = self._comm
        ordered: Array | None = None
        if values is not None:
            ordered = np.empty_like(values, order="C")
            ordered[self._order] = values
        if comm.size == 1:
            assert ordered is not None
            return ordered
        kind = comm.bcast(None if ordered is None else (ordered.dtype, ordered.shape[1:]))
        mine: Array = np.empty((self._counts[comm.rank], *kind[1]), dtype=kind[0])
        row = _row(mine)
        sent = None if ordered is None else [ordered, (self._counts, None), row]
        comm.Scatterv(sent, [mine, len(mine), row])
        row.Free()
        return mine

    def _gather(self, values: Array) -> Array | None:
        """Rows of all ranks, rank after rank, on rank 0."""
        comm = self._comm
        values = np.ascontiguousarray(values)
        if comm.size == 1:
            return values
        kinds = comm.gather((values.dtype, values.shape[1:]))
        if kinds is None:
            row = _row(values)
            comm.Gatherv([values, len(values), row], None)
            row.Free()
            return None
        # A rank without rows may not know their kind
        dtype, shape = kinds[int(np.argmax(self._counts))]
        gathered: Array = np.empty((sum(self._counts), *shape), dtype=dtype)
        row = _row(gathered)
        comm.Gatherv([values, len(values), row], [gathered, (self._counts, None), row])
        row.Free()
        return gathered


def _row(values: Array) -> MPI.Datatype:
    """A whole row as one item, so that numbers of items stay below MPI's limit."""
    size = values.dtype.itemsize * int(np.prod(values.shape[1:]))
    return MPI.BYTE.Create_contiguous(size).Commit()
