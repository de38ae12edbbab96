# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Communication that the core asks for."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterator, Mapping
from itertools import cycle
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx._host.nodes import original_nodes
from contactx._host.parallel.reduce import agreed
from dolfinx import cpp, fem, la

type Array = npt.NDArray[np.float64]

_TAG = 7090
# Tags in turn, so that a message never ends up in the exchange before its own
_FIRST, _COUNT = 7100, 16
_TAGS = MPI.Comm.Create_keyval()
_OPERATIONS = {"sum": MPI.SUM, "least": MPI.MIN, "largest": MPI.MAX}


class MPIRanks:
    """Ranks, as the core's ``Ranks`` describes them.

    Attributes:
        comm: Communicator.
        rank: Number of this rank.
        size: Number of ranks.
    """

    def __init__(self, comm: MPI.Comm):
        """Take the ranks of a communicator."""
        self.comm: MPI.Comm = comm
        self.rank: int = comm.rank
        self.size: int = comm.size
        self._exchange = Exchange(comm)

    def reduce(self, values: npt.NDArray[Any], how: str) -> None:
        """Reduce numbers over the ranks, in place."""
        self.comm.Allreduce(MPI.IN_PLACE, values, op=_OPERATIONS[how])

    def gather(self, mine: bytes) -> bytes:
        """Bytes of all ranks, one rank's after the other's."""
        sizes = np.empty(self.size, dtype=np.int64)
        self.comm.Allgather(np.array([len(mine)]), sizes)
        every = bytearray(sizes.sum())
        self.comm.Allgatherv([mine, MPI.BYTE], [every, sizes, MPI.BYTE])
        return bytes(every)

    def exchange(self, outgoing: dict[int, bytes]) -> dict[int, bytes]:
        """Send bytes and receive those of others."""
        return self._exchange(outgoing)

    def agree(self, work: Callable[[], None]) -> None:
        """Do something, and raise what is raised on any rank on all of them."""
        with agreed(self.comm):
            work()


class MPIHost(MPIRanks):
    """Ranks and nodes, as the core's ``Ranks`` and ``HaloAdapter`` describe them.

    Attributes:
        num_owned: Number of the bulk's nodes that this rank owns.
        num_bulk: Number of the bulk's nodes here, ghosts included.
        full_map: Index map of all nodes, over the ranks.
        index_map: The same on this rank alone, by which forms are assembled.
        displacement: Displacement of all nodes, as of the last ``update_ghosts``.
        space: Space of the displacement.
    """

    displacement: la.Vector

    def __init__(self, u: fem.Function, X: Array):
        """Start with the bulk's nodes alone.

        Args:
            u: Displacement, in a linear Lagrange space.
            X: Reference positions of its nodes, ghosts included, shape (num_bulk, gdim).
        """
        V = self.space = u.function_space
        super().__init__(V.mesh.comm)
        self._u, self._X = u, X
        self._bulk_map = self.full_map = V.dofmap.index_map
        self._gdim = X.shape[1]
        self.num_owned: int = self.full_map.size_local
        self.num_bulk: int = self.full_map.size_local + self.full_map.num_ghosts
        self._observer: weakref.WeakMethod[Callable[[], None]] | None = None
        none = np.zeros(0, dtype=np.int64)
        self.set_ghosts(none, none.astype(np.int32))

    def on_change(self, observer: Callable[[], None]) -> None:
        """Call a method, whose object is not kept alive, whenever the nodes have changed."""
        self._observer = weakref.WeakMethod(observer)

    def bulk(self) -> dict[str, Any]:
        """The bulk's nodes on this rank, as the core's ``BulkNodes`` describe them."""
        every = np.arange(self.num_bulk, dtype=np.int32)
        own = np.full(self.num_owned, self.rank, dtype=np.int32)
        return {
            "gdim": self._gdim,
            "num_owned": self.num_owned,
            "numbers": self._bulk_map.local_to_global(every).astype(np.int64),
            "owners": np.concatenate([own, self._bulk_map.owners]).astype(np.int32),
            "original": original_nodes(self._u.function_space),
            "reference": np.ascontiguousarray(self._X, dtype=np.float64),
        }

    def set_ghosts(self, numbers: npt.NDArray[np.int64], owners: npt.NDArray[np.int32]) -> None:
        """Follow the bulk's nodes by these of other ranks; all ranks must take part.

        Args:
            numbers: Numbers of the nodes, as the bulk's index map has them.
            owners: Ranks that own them.
        """
        bulk = self._bulk_map
        if self.size > 1:
            ghosts = np.concatenate([bulk.ghosts, numbers])
            every = np.concatenate([bulk.owners, owners]).astype(np.int32)
            self.full_map = cpp.common.IndexMap(self.comm, bulk.size_local, ghosts, every, _TAG)
        self._vectors: dict[tuple[int, Any], la.Vector] = {}
        self.index_map = cpp.common.IndexMap(MPI.COMM_SELF, self.num_bulk + len(numbers))
        self.displacement = self._u.x if self.size == 1 else la.vector(self.index_map, self._gdim)
        self.update_ghosts()

    def changed(self) -> None:
        """The core knows the nodes again."""
        observer = self._observer() if self._observer is not None else None
        if observer is not None:
            observer()

    def current_displacement(self) -> Array:
        """Displacement of all nodes, as of the last ``update_ghosts``."""
        values: Array = self.displacement.array
        return values

    def update_ghosts(self) -> None:
        """Give ghosts the owners' displacements: those of the bulk and of the contact halo."""
        if self.size > 1:
            values = self.displacement.array.reshape(-1, self._gdim)
            owned = self._u.x.array.reshape(-1, self._gdim)[: self.num_owned]
            values[: self.num_owned] = owned
            self.forward(values, self._gdim)
            self._u.x.array[:] = values[: self.num_bulk].ravel()

    def forward(self, values: npt.NDArray[Any], width: int) -> None:
        """Give nodes of other ranks the values of their owners, in place.

        Args:
            values: Values of all nodes, of which those of the owned nodes count, row-major.
            width: Values a node.
        """
        vector = self._vector(width, values.dtype.type)
        rows, size = values.reshape(-1), self.num_owned * width
        vector.array[:size] = rows[:size]
        vector.scatter_forward()
        rows[size:] = vector.array[size:]

    def reverse(self, values: Array, width: int) -> None:
        """Add what all ranks have for a node on its owner, in place.

        Args:
            values: Values of all nodes, row-major.
            width: Values a node.
        """
        vector = self._vector(width, np.float64)
        rows, size = values.reshape(-1), self.num_owned * width
        vector.array[:] = rows
        vector.scatter_reverse(la.InsertMode.add)
        rows[:size] = vector.array[:size]

    def _vector(self, width: int, dtype: Any) -> la.Vector:
        if (width, dtype) not in self._vectors:
            self._vectors[width, dtype] = la.vector(self.full_map, width, dtype)
        return self._vectors[width, dtype]


class Exchange:
    """Sparse exchange by nonblocking consensus (Hoefler, Siebert, Lumsdaine 2010).

    What it costs a rank goes with the ranks that it writes to, not with how many there are.
    """

    def __init__(self, comm: MPI.Comm):
        """Create an exchange.

        Args:
            comm: Communicator.
        """
        self.comm = comm
        # Of all exchanges of a communicator, which is where MPI keeps them
        tags: Any = comm.Get_attr(_TAGS)
        if tags is None:
            tags = cycle(range(_FIRST, _FIRST + _COUNT))
            comm.Set_attr(_TAGS, tags)
        self._tags: Iterator[int] = tags

    def __call__(self, outgoing: Mapping[int, bytes]) -> dict[int, bytes]:
        """Send bytes and receive those of others; all ranks must take part.

        Args:
            outgoing: Bytes by the rank that they go to.

        Returns:
            Bytes by the rank that sent them, in ascending order.
        """
        comm, tag = self.comm, next(self._tags)
        received = {}
        sending = []
        for rank, data in outgoing.items():
            if rank == comm.rank:
                received[rank] = data
                continue
            sending.append(comm.Issend([data, MPI.BYTE], dest=rank, tag=tag))
        if comm.size == 1:
            return received
        barrier = None
        status = MPI.Status()
        while barrier is None or not barrier.Test():
            if comm.Iprobe(MPI.ANY_SOURCE, tag, status):
                buffer = bytearray(status.Get_count(MPI.BYTE))
                comm.Recv([buffer, MPI.BYTE], source=status.source, tag=tag)
                received[status.source] = bytes(buffer)
            if barrier is None and MPI.Request.Testall(sending):
                barrier = comm.Ibarrier()
        return dict(sorted(received.items()))
