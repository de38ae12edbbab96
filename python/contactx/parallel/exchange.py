# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Messages to few ranks that do not know of them yet."""

from __future__ import annotations

from collections.abc import Mapping

from mpi4py import MPI

# Tags in turn, so that a message never ends up in the exchange before its own
_FIRST, _COUNT = 7100, 16


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
        self._turn = 0

    def __call__(self, outgoing: Mapping[int, bytes]) -> dict[int, bytes]:
        """Send bytes and receive those of others; all ranks must take part.

        Args:
            outgoing: Bytes by the rank that they go to.

        Returns:
            Bytes by the rank that sent them, in ascending order.
        """
        comm, tag = self.comm, _FIRST + self._turn
        self._turn = (self._turn + 1) % _COUNT
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
