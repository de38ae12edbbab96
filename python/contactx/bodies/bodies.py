# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies: the connected parts of a mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.parallel import reduce
from contactx.parallel.halo import Halo
from dolfinx import fem

type Index = npt.NDArray[np.int64]


class Bodies:
    """Connected parts of a mesh, on any number of ranks; bodies share no nodes.

    Attributes:
        V: Linear Lagrange space of vectors, whose blocks are the nodes.
        halo: Nodes on this rank.
        names: Names of all bodies, ascending, the same on all ranks: a body is named by the
            smallest number that a node of it has in the mesh as it was made, shape (num_bodies,).
        of_node: Body of each node by its name, shape (num_nodes,).
        number: Body of each node by its place among the names, shape (num_nodes,).
        of_cell: Body of each cell of this rank by its name, ghosts included, shape (num_cells,).
    """

    def __init__(self, V: fem.FunctionSpace, halo: Halo):
        """Find the bodies; all ranks must take part.

        Args:
            V: Linear Lagrange space of vectors.
            halo: Nodes on this rank.
        """
        self.V = V
        self.halo = halo
        cells = V.dofmap.list
        part = _parts(cells, halo.num_bulk)
        original = halo.original[: halo.num_bulk]
        least = original.copy()
        np.minimum.at(least, part, original)
        self.of_node = least[part]
        here = np.sort(least[part == np.arange(len(part))])
        self.names = here
        if halo.comm.size > 1:
            self.names, known = self._across_ranks(here)
            self.of_node = known[np.searchsorted(here, self.of_node)]
        self.of_cell = self.of_node[cells[:, 0]]
        self._halo_changed()
        halo.on_change(self._halo_changed)

    def _across_ranks(self, here: Index) -> tuple[Index, Index]:
        """Names of all bodies, and of those that the parts of bodies on this rank belong to.

        Args:
            here: Smallest number of a node of each part, ascending.
        """
        halo = self.halo
        # What a ghost belongs to here and on its owner is one body
        ghosts = slice(halo.num_owned, halo.num_bulk)
        both = np.column_stack([self.of_node[ghosts], halo.scatter_forward(self.of_node)[ghosts]])
        links = np.concatenate([np.column_stack([here, here]), np.unique(both, axis=0)])
        numbers, ends = np.unique(reduce.gathered(halo.comm, links), return_inverse=True)
        part = _parts(ends.reshape(-1, 2), len(numbers))
        return numbers[np.unique(part)], numbers[part[np.searchsorted(numbers, here)]]

    def _halo_changed(self) -> None:
        """Give the nodes of the halo their bodies."""
        self.of_node = self.halo.scatter_forward(self.of_node)
        self.number = np.searchsorted(self.names, self.of_node)

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Reference positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.x

    def carrying(self, nodes: npt.NDArray[np.int32]) -> Index:
        """Bodies that some nodes of any rank belong to; all ranks must take part."""
        here = np.unique(self.of_node[nodes])
        if self.halo.comm.size == 1:
            return here
        return np.unique(reduce.gathered(self.halo.comm, here))

    def nodes(self, body: int) -> Index:
        """Nodes of a body that this rank owns."""
        return np.flatnonzero(self.of_node[: self.halo.num_owned] == body)

    def count(self, body: int) -> int:
        """Number of nodes of a body on all ranks, which must take part."""
        return int(reduce.total(self.halo.comm, len(self.nodes(body))))

    def cells(self, body: int) -> npt.NDArray[np.int32]:
        """Cells of a body that this rank owns."""
        topology = self.V.mesh.topology
        owned = self.of_cell[: topology.index_map(topology.dim).size_local]
        return np.flatnonzero(owned == body).astype(np.int32)

    def boxes(self, bodies: Index) -> npt.NDArray[np.float64]:
        """Bounding boxes of bodies on all ranks, which must take part.

        Args:
            bodies: Names, the same on all ranks.

        Returns:
            Lowest and highest corner, shape (2, num_bodies, gdim).
        """
        owned = slice(self.halo.num_owned)
        x, number = self.x[owned], self.number[owned]
        # The largest of x and of its opposite
        corners = np.full((2, len(self.names), x.shape[1]), -np.inf)
        np.maximum.at(corners[0], number, -x)
        np.maximum.at(corners[1], number, x)
        corners = reduce.largest(self.halo.comm, corners)
        which = np.searchsorted(self.names, bodies)
        return np.stack([-corners[0, which], corners[1, which]])


def _parts(cells: npt.NDArray[np.integer], count: int) -> Index:
    """Smallest of the nodes that each node is connected to by cells.

    Args:
        cells: Nodes of the cells, shape (num_cells, k).
        count: Number of nodes.
    """
    part = np.arange(count)
    # Cells whose nodes have several names; once they have one it stays so
    mixed = cells
    while len(mixed) > 0:
        there = part[mixed]
        least = there.min(axis=1, keepdims=True)
        several = there.max(axis=1) > least[:, 0]
        mixed = mixed[several]
        np.minimum.at(part, there[several], least[several])
        # Names lead to smaller ones, down to the smallest
        while not np.array_equal(part, part[part]):
            part = part[part]
    return part
