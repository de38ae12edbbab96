# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the core asks of other ranks."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx.parallel.agreement import agreed

if TYPE_CHECKING:
    from contactx.parallel.halo import Halo

_OPERATIONS = {"sum": MPI.SUM, "least": MPI.MIN, "largest": MPI.MAX}


class Adapter:
    """Ranks and nodes, as the core's ``Ranks`` and ``NodeMap`` describe them.

    Attributes:
        rank: Number of this rank.
        size: Number of ranks.
    """

    def __init__(self, halo: Halo):
        """Take the nodes of this rank, which are not kept alive."""
        # The nodes keep what keeps this
        self._halo = weakref.ref(halo)
        self._comm = halo.comm
        self._exchange = halo.exchange
        self.rank: int = halo.comm.rank
        self.size: int = halo.comm.size

    def reduce(self, values: npt.NDArray[Any], how: str) -> None:
        """Reduce numbers over the ranks, in place."""
        self._comm.Allreduce(MPI.IN_PLACE, values, op=_OPERATIONS[how])

    def exchange(self, outgoing: dict[int, bytes]) -> dict[int, bytes]:
        """Send bytes and receive those of others."""
        return self._exchange(outgoing)

    def agree(self, work: Callable[[], None]) -> None:
        """Do something, and raise what is raised on any rank on all of them."""
        with agreed(self._comm):
            work()

    @property
    def num_owned(self) -> int:
        """Number of nodes that this rank owns."""
        return self._nodes.num_owned

    @property
    def num_nodes(self) -> int:
        """Number of all nodes on this rank."""
        return self._nodes.num_nodes

    def forward(self, values: npt.NDArray[Any], width: int) -> None:
        """Give nodes of other ranks the values of their owners, in place."""
        rows = values.reshape(-1, width)
        rows[:] = self._nodes.scatter_forward(rows)

    def reverse(self, values: npt.NDArray[np.float64], width: int) -> None:
        """Add what all ranks have for a node on its owner, in place."""
        rows = values.reshape(-1, width)
        rows[: self.num_owned] = self._nodes.scatter_reverse(rows)

    @property
    def _nodes(self) -> Halo:
        halo = self._halo()
        assert halo is not None
        return halo
