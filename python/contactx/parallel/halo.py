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
from contactx.parallel import reduce
from contactx.parallel.adapter import Adapter
from contactx.parallel.exchange import Exchange
from dolfinx import cpp, fem, la

type Array = npt.NDArray[np.float64]

_TAG = 7090


class Halo:
    """The bulk's nodes on this rank, followed by nodes of other ranks that contact needs here.

    The bulk's own numbers stay as they are: its owned nodes come first, then its ghosts, then those
    of the contact halo. Arrays "of all nodes" have a row for each of them. The halo grows as pairs
    are found, by nodes that are appended, and shrinks at a step's start. On one rank there is none,
    and the arrays are the bulk's.

    Attributes:
        comm: Communicator.
        gdim: Geometric dimension.
        num_owned: Number of the bulk's nodes that this rank owns.
        num_bulk: Number of the bulk's nodes here, ghosts included.
        original: Number of each node in the mesh as it was made: the same on any number of ranks,
            shape (num_nodes,).
        displacement: Displacement of all nodes, as of the last ``update_ghosts``.
        position: Reference position of all nodes.
        version: Counts how often the halo has changed.
        exchange: Messages to other ranks.
        nodes: The nodes as the core sees them.
    """

    displacement: la.Vector
    position: la.Vector

    def __init__(self, u: fem.Function, X: Array):
        """Start with the bulk's nodes alone.

        Args:
            u: Displacement, in a linear Lagrange space.
            X: Reference positions of its nodes, ghosts included, shape (num_bulk, gdim).
        """
        V = u.function_space
        self._u = u
        self._bulk_map = bulk = V.dofmap.index_map
        self.comm: MPI.Comm = V.mesh.comm
        self.gdim = X.shape[1]
        self.num_owned: int = bulk.size_local
        self.num_bulk: int = bulk.size_local + bulk.num_ghosts
        self.exchange = Exchange(self.comm)
        self.version = 0
        self._observers: list[weakref.WeakMethod[Callable[[], None]]] = []
        self._bulk_original = original_nodes(V)
        self._reference = X
        # Global numbers and owners of the halo, and how many of them stay for good
        self._ghosts = np.zeros(0, dtype=np.int64)
        self._owners = np.zeros(0, dtype=np.int32)
        self._kept = 0
        self.nodes = core.PythonNodes(Adapter(self))
        self._rebuild()

    @property
    def num_nodes(self) -> int:
        """Number of nodes on this rank, those of the halo included."""
        return self.num_bulk + len(self._ghosts)

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
        if self.comm.size > 1:
            owned = self._u.x.array.reshape(-1, self.gdim)[: self.num_owned]
            values = self.scatter_forward(owned)
            self.displacement.array[:] = values.ravel()
            self._u.x.array[:] = values[: self.num_bulk].ravel()

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
        width = 1 if values.ndim == 1 else values.shape[1]
        vector = self._vector(width, dtype)
        vector.array[: self.num_owned * width] = values[: self.num_owned].ravel()
        vector.scatter_forward()
        everywhere: npt.NDArray[Any] = vector.array.reshape(-1, *values.shape[1:])
        return everywhere.astype(values.dtype)

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
        width = 1 if values.ndim == 1 else values.shape[1]
        vector = self._vector(width, np.float64)
        vector.array[:] = values.ravel()
        vector.scatter_reverse(la.InsertMode.add)
        sums: Array = vector.array.reshape(-1, *values.shape[1:])[: self.num_owned].copy()
        return sums

    def numbers(self, nodes: npt.NDArray[np.integer]) -> npt.NDArray[np.int64]:
        """Global numbers of some nodes, as the bulk's index map has them."""
        result: npt.NDArray[np.int64] = self._global[nodes]
        return result

    def owners(self, nodes: npt.NDArray[np.integer]) -> npt.NDArray[np.int32]:
        """Ranks that own some nodes."""
        result: npt.NDArray[np.int32] = self._owner[nodes]
        return result

    def find(self, numbers: npt.NDArray[np.int64]) -> npt.NDArray[np.int32]:
        """Nodes by their global numbers.

        Args:
            numbers: Global numbers of nodes that are here, of any shape.

        Returns:
            Nodes, of the same shape.
        """
        if self.comm.size == 1:
            return numbers.astype(np.int32)
        place = np.searchsorted(self._sorted, numbers)
        nodes: npt.NDArray[np.int32] = self._order[place]
        return nodes

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
        if self.comm.size == 1:
            return
        numbers, first = np.unique(numbers, return_index=True)
        new = ~np.isin(numbers, self._sorted)
        if self.comm.allreduce(bool(new.any()), MPI.LOR):
            self._ghosts = np.concatenate([self._ghosts, numbers[new]])
            self._owners = np.concatenate([self._owners, owners[first][new]]).astype(np.int32)
            self._rebuild()
        if for_good:
            self._kept = len(self._ghosts)

    def shrink(self) -> None:
        """Drop what was not appended for good; all ranks must take part."""
        if self.comm.size > 1:
            self._ghosts, self._owners = self._ghosts[: self._kept], self._owners[: self._kept]
            self._rebuild()

    def on_change(self, observer: Callable[[], None]) -> None:
        """Call a method whenever the halo has changed, on all ranks, while its object lives."""
        self._observers.append(weakref.WeakMethod(observer))

    def _rebuild(self) -> None:
        bulk = self._bulk_map
        self._map = bulk
        if self.comm.size > 1:
            ghosts = np.concatenate([bulk.ghosts, self._ghosts])
            owners = np.concatenate([bulk.owners, self._owners]).astype(np.int32)
            self._map = cpp.common.IndexMap(self.comm, bulk.size_local, ghosts, owners, _TAG)
        every = np.arange(self.num_nodes, dtype=np.int32)
        self._global = self._map.local_to_global(every)
        self._owner = np.concatenate(
            [np.full(self.num_owned, self.comm.rank), self._map.owners]
        ).astype(np.int32)
        self._order = every
        if self.comm.size > 1:
            self._order = np.argsort(self._global).astype(np.int32)
        self._sorted = self._global[self._order]
        self._vectors: dict[tuple[int, Any], la.Vector] = {}
        self.original = self.scatter_forward(self._bulk_original)
        # Forms are assembled rank by rank
        serial = cpp.common.IndexMap(MPI.COMM_SELF, self.num_nodes)
        self.index_map = serial
        self.position = la.vector(serial, self.gdim)
        self.position.array[:] = self.scatter_forward(self._reference).ravel()
        self.displacement = self._u.x if self.comm.size == 1 else la.vector(serial, self.gdim)
        self.update_ghosts()
        self.version += 1
        for reference in self._observers:
            observer = reference()
            if observer is not None:
                observer()

    def _vector(self, width: int, dtype: Any) -> la.Vector:
        if (width, dtype) not in self._vectors:
            self._vectors[width, dtype] = la.vector(self._map, width, dtype)
        return self._vectors[width, dtype]


def first_node(
    halo: Halo, nodes: npt.NDArray[np.integer], x: Array
) -> tuple[int, npt.NDArray[np.float64]]:
    """The first of some nodes of any rank in the mesh as it was made; all ranks must take part.

    Args:
        halo: Nodes of this rank.
        nodes: Nodes on this rank; some rank has one.
        x: Positions of all nodes, shape (num_nodes, gdim).

    Returns:
        Its number there, and its position, shape (gdim,).
    """
    numbers = halo.original[nodes].tolist()
    first: tuple[int, npt.NDArray[np.float64]] = reduce.first(
        halo.comm, numbers, list(zip(numbers, x[nodes], strict=True))
    )
    return first


def original_nodes(V: fem.FunctionSpace) -> npt.NDArray[np.int64]:
    """Number of each node in the mesh as it was made; of owned nodes first, then of ghosts.

    Args:
        V: Linear Lagrange space.

    Returns:
        Numbers, the same on any number of ranks, shape (num_nodes,).
    """
    geometry = V.mesh.geometry
    dofs, index_map = V.dofmap.list, V.dofmap.index_map
    original = np.full(index_map.size_local + index_map.num_ghosts, -1, dtype=np.int64)
    # Vertices come first in the geometry of a cell
    vertices = geometry.dofmaps[0][:, : dofs.shape[1]]
    original[dofs.ravel()] = geometry.input_global_indices[vertices.ravel()]
    return original
