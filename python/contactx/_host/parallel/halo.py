# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes of the bulk that contact needs on a rank."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.parallel.mpi_host import MPIHost
from dolfinx import fem, la

type Array = npt.NDArray[np.float64]


class Halo:
    """The bulk's nodes on this rank, followed by nodes of other ranks that contact needs here.

    The core keeps the books of them (``nodes``), and vectors of DOLFINx follow. The bulk's own
    numbers stay as they are: its owned nodes come first, then its ghosts, then those of the contact
    halo. Arrays "of all nodes" have a row for each of them. The halo grows as pairs are found, by
    nodes that are appended, and shrinks at a step's start. On one rank there is none, and the
    arrays are the bulk's.

    Attributes:
        comm: Communicator.
        gdim: Geometric dimension.
        num_owned: Number of the bulk's nodes that this rank owns.
        num_bulk: Number of the bulk's nodes here, ghosts included.
        original: Number of each node in the mesh as it was made: the same on any number of ranks,
            shape (num_nodes,).
        position: Reference position of all nodes.
        host: What the core asks of other ranks.
        nodes: The nodes as the core has them.
    """

    original: npt.NDArray[np.int64]
    position: la.Vector

    def __init__(self, u: fem.Function, X: Array):
        """Start with the bulk's nodes alone.

        Args:
            u: Displacement, in a linear Lagrange space.
            X: Reference positions of its nodes, ghosts included, shape (num_bulk, gdim).
        """
        self.host = MPIHost(u, X)
        self.comm: MPI.Comm = self.host.comm
        self.nodes = core.PythonNodes(self.host)
        self.gdim = self.nodes.gdim
        self.num_owned = self.nodes.num_owned
        self.num_bulk = self.nodes.num_bulk
        self._observers: list[weakref.WeakMethod[Callable[[], None]]] = []
        self.host.on_change(self._changed)
        self._changed()

    @property
    def num_nodes(self) -> int:
        """Number of nodes on this rank, those of the halo included."""
        return self.nodes.num_nodes

    @property
    def version(self) -> int:
        """Counts how often the halo has changed."""
        return self.nodes.version

    @property
    def index_map(self) -> Any:
        """Index map of all nodes, on this rank alone."""
        return self.host.index_map

    @property
    def displacement(self) -> la.Vector:
        """Displacement of all nodes, as of the last ``update_ghosts``."""
        return self.host.displacement

    @property
    def x(self) -> Array:
        """Reference positions of all nodes, shape (num_nodes, gdim)."""
        x: Array = self.position.array.reshape(-1, self.gdim)
        return x

    def positions(self) -> Array:
        """Positions of all nodes as of the last ``update_ghosts``, shape (num_nodes, gdim)."""
        x: Array = self.position.array + self.displacement.array
        return x.reshape(-1, self.gdim)

    def update_ghosts(self) -> None:
        """Give ghosts the owners' displacements: those of the bulk and of the contact halo."""
        self.host.update_ghosts()

    def scatter_forward(self, values: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Give all nodes the values that their owners have; all ranks must take part.

        Args:
            values: Values, of which the rows of the owned nodes count, shape (n,) or (n, k).

        Returns:
            Values of all nodes, of the same type, shape (num_nodes,) or (num_nodes, k).
        """
        if self.comm.size == 1:
            return values
        dtype = np.int64 if values.dtype.kind in "iub" else np.float64
        every = np.zeros((self.num_nodes, *values.shape[1:]), dtype=dtype)
        every[: self.num_owned] = values[: self.num_owned]
        self.host.forward(every, 1 if values.ndim == 1 else values.shape[1])
        return every.astype(values.dtype)

    def updated(self, values: npt.NDArray[Any], version: int) -> npt.NDArray[Any]:
        """Values of all nodes that were made before the halo changed, for its nodes of now.

        Args:
            values: Values of all nodes, shape (n, k).
            version: Version at which they were made.
        """
        return values if version == self.version else self.scatter_forward(values[: self.num_owned])

    def scatter_reverse(self, values: Array) -> Array:
        """Add what all ranks have for a node on its owner; all ranks must take part.

        Args:
            values: Values of all nodes, shape (num_nodes,) or (num_nodes, k).

        Returns:
            Sums at the owned nodes, shape (num_owned,) or (num_owned, k).
        """
        if self.comm.size == 1:
            return values
        every = np.array(values, dtype=np.float64)
        self.host.reverse(every, 1 if values.ndim == 1 else values.shape[1])
        return every[: self.num_owned]

    def numbers(self, nodes: npt.NDArray[np.integer]) -> npt.NDArray[np.int64]:
        """Global numbers of some nodes, as the bulk's index map has them, shape (n,)."""
        return self.nodes.numbers(np.ascontiguousarray(nodes, dtype=np.int32))

    def owners(self, nodes: npt.NDArray[np.integer]) -> npt.NDArray[np.int32]:
        """Ranks that own some nodes, shape (n,)."""
        return self.nodes.owners(np.ascontiguousarray(nodes, dtype=np.int32))

    def grow(
        self,
        numbers: npt.NDArray[np.int64],
        owners: npt.NDArray[np.int32],
        *,
        for_good: bool = False,
    ) -> None:
        """Append the nodes of these numbers that are not here yet; all ranks must take part.

        Args:
            numbers: Global numbers, in any order and more than once.
            owners: Ranks that own them.
            for_good: Whether they stay when the halo shrinks.
        """
        self.nodes.grow(numbers, owners, for_good=for_good)

    def shrink(self) -> None:
        """Drop what was not appended for good; all ranks must take part."""
        self.nodes.shrink()

    def on_change(self, observer: Callable[[], None]) -> None:
        """Call a method whenever the halo has changed, on all ranks, while its object lives."""
        self._observers.append(weakref.WeakMethod(observer))

    def _changed(self) -> None:
        self.original = self.nodes.original
        self.position = la.vector(self.index_map, self.gdim)
        self.position.array[:] = self.nodes.reference.ravel()
        for reference in self._observers:
            observer = reference()
            if observer is not None:
                observer()
