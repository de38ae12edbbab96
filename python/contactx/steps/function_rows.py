# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Values of functions as rows of nodes or cells, the same on any number of ranks."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import basix.ufl
from contactx.refined import original_nodes
from contactx.steps.rows import Array, Rows
from dolfinx import fem


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
