# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rows of arrays and of functions, in an order that does not depend on the number of ranks."""

from __future__ import annotations

import hashlib
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx._host.nodes import original_nodes
from dolfinx import fem

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


class FunctionRows:
    """Values of a function: a row a node of Lagrange spaces of degree 1 or 2, or a row a cell.

    The latter have all their dofs inside of cells: quadrature and discontinuous elements. Mixed and
    enriched spaces have a row a dof, where no edge or face has several that its direction would
    have to tell apart. On one rank there are rows of all spaces, by the numbers of their dofs.

    Attributes:
        rows: The rows, by the nodes' numbers in the mesh as it was made.
    """

    def __init__(self, function: fem.Function, name: str):
        """Find the rows; all ranks must take part.

        Args:
            function: The function.
            name: What it is called in errors.

        Raises:
            ValueError: If its space is of another kind, on more than one rank.
        """
        self._function = function
        V = function.function_space
        keys, dofs = _nodal(V) or _cellwise(V) or _entitywise(V) or _all(V, name)
        self._dofs = dofs
        self.rows = Rows(V.mesh.comm, keys)

    def gather(self) -> Array | None:
        """Values of all ranks, shape (n,) or (n, width); None but on rank 0."""
        return self.rows.gather(self._function.x.array[self._dofs])

    def scatter(self, values: Array | None) -> None:
        """Set the function, its ghosts included.

        Args:
            values: What ``gather`` gave; None but on rank 0.
        """
        self._function.x.array[self._dofs] = self.rows.scatter(values)
        self._function.x.scatter_forward()


type _Keyed = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]


def cell_nodes(V: fem.FunctionSpace) -> npt.NDArray[np.int64]:
    """Nodes of each owned cell by their numbers in the mesh as it was made, shape (n, k)."""
    domain = V.mesh
    owned = domain.topology.index_map(domain.topology.dim).size_local
    numbers: npt.NDArray[np.int64] = domain.geometry.input_global_indices
    nodes: npt.NDArray[np.int64] = numbers[domain.geometry.dofmaps[0][:owned]]
    return nodes


def _nodal(V: fem.FunctionSpace) -> _Keyed | None:
    """Keys and dofs of owned nodes of continuous Lagrange spaces of degree 1 or 2."""
    dofmap, index_map = V.dofmap, V.dofmap.index_map
    element = V.ufl_element()
    is_lagrange = (
        not isinstance(element, basix.ufl._MixedElement)
        and element.element_family == basix.ElementFamily.P
        and not element.discontinuous
    )
    if not is_lagrange or element.degree not in (1, 2):
        return None
    owned = index_map.size_local
    return original_nodes(V)[:owned, None], _scalars(np.arange(owned)[:, None], dofmap.bs)


def _cellwise(V: fem.FunctionSpace) -> _Keyed | None:
    """Keys and dofs of owned cells, where all dofs lie inside of cells."""
    layout = V.dofmap.dof_layout
    if len(layout.entity_dofs(V.mesh.topology.dim, 0)) != layout.num_dofs:
        return None
    nodes = cell_nodes(V)
    return nodes, _scalars(V.dofmap.list[: len(nodes)], V.dofmap.bs)


def _entitywise(V: fem.FunctionSpace) -> _Keyed | None:
    """Keys and dofs of owned dofs by the vertices, edges, faces and cells that they are of."""
    leaves = _leaves(V)
    domain = V.mesh
    numbers = domain.geometry.input_global_indices
    tdim = domain.topology.dim
    topology = basix.topology(domain.basix_cell())
    num_vertices = len(topology[0])
    vertices = numbers[domain.geometry.dofmaps[0][:, :num_vertices]]
    keys: list[npt.NDArray[np.int64]] = []
    dofs: list[npt.NDArray[np.int64]] = []
    owned = V.dofmap.index_map.size_local * V.dofmap.index_map_bs
    for leaf, (W, parent) in enumerate(leaves):
        layout, block = W.dofmap.dof_layout, W.dofmap.bs
        for dim, entities in enumerate(topology):
            for number, corners in enumerate(entities):
                own = layout.entity_dofs(dim, number)
                if len(own) > 1 and dim < tdim:
                    return None
                at = vertices[:, corners]
                if dim < tdim:
                    at = np.sort(at, axis=1)
                for k, dof in enumerate(own):
                    for component in range(block):
                        found = parent[block * W.dofmap.list[:, dof].astype(np.int64) + component]
                        rows = np.full((len(found), 4 + num_vertices), -1, dtype=np.int64)
                        rows[:, :4] = leaf, component, dim, k
                        rows[:, 4 : 4 + len(corners)] = at
                        keys.append(rows[found < owned])
                        dofs.append(found[found < owned])
    every, first = np.unique(np.concatenate(dofs), return_index=True)
    return np.concatenate(keys)[first], every


def _leaves(V: fem.FunctionSpace) -> list[tuple[fem.FunctionSpace, npt.NDArray[np.int64]]]:
    """Parts of a mixed space, each with the dofs of V at its own scalar ones."""
    if not isinstance(V.ufl_element(), basix.ufl._MixedElement):
        count = (V.dofmap.index_map.size_local + V.dofmap.index_map.num_ghosts) * V.dofmap.bs
        return [(V, np.arange(count, dtype=np.int64))]
    leaves = []
    for i in range(V.num_sub_spaces):
        W, parent = V.sub(i).collapse()
        whole = np.asarray(parent, dtype=np.int64).ravel()
        leaves += [(leaf, whole[own]) for leaf, own in _leaves(W)]
    return leaves


def _all(V: fem.FunctionSpace, name: str) -> _Keyed:
    """Keys and dofs of one rank."""
    if V.mesh.comm.size > 1:
        raise ValueError(
            f"{name} is of {V.ufl_element()}, which a checkpoint of several ranks cannot hold: "
            "take a Lagrange space of degree 1 or 2, a mixed one of such, a quadrature or a "
            "discontinuous space, or one rank"
        )
    dofs = np.arange(V.dofmap.index_map.size_local * V.dofmap.index_map_bs)
    return dofs[:, None], dofs


def _scalars(blocks: npt.NDArray[np.integer], size: int) -> npt.NDArray[np.int64]:
    """Dofs of blocks, shape (n, k * size); (n,) where that is one dof."""
    dofs = (blocks[:, :, None] * size + np.arange(size)).reshape(
        len(blocks), blocks.shape[1] * size
    )
    return dofs[:, 0] if dofs.shape[1] == 1 else dofs
