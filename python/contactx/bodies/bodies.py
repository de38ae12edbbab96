# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies: the connected parts of a mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from dolfinx import fem


class Bodies:
    """Connected parts of a mesh; bodies share no nodes.

    Attributes:
        V: Linear Lagrange space of vectors, whose blocks are the nodes.
        x: Positions of the nodes, shape (num_nodes, gdim).
        of_node: Body of each node, named by its smallest node, shape (num_nodes,).
        of_cell: Body of each cell, shape (num_cells,).
    """

    def __init__(self, V: fem.FunctionSpace, x: npt.NDArray[np.float64]):
        """Find the bodies.

        Args:
            V: Linear Lagrange space of vectors.
            x: Positions of its nodes, shape (num_nodes, gdim).
        """
        self.V = V
        self.x = x
        cells = V.dofmap.list
        body = np.arange(len(x))
        # Cells whose nodes have several names; once they have one it stays so
        mixed = cells
        while len(mixed) > 0:
            there = body[mixed]
            least = there.min(axis=1, keepdims=True)
            several = there.max(axis=1) > least[:, 0]
            mixed = mixed[several]
            np.minimum.at(body, there[several], least[several])
            # Names lead to smaller ones, down to the smallest
            while not np.array_equal(body, body[body]):
                body = body[body]
        self.of_node = body
        self.of_cell = body[cells[:, 0]]

    def carrying(self, nodes: npt.NDArray[np.int32]) -> npt.NDArray[np.int64]:
        """Bodies that some nodes belong to."""
        return np.unique(self.of_node[nodes])

    def nodes(self, body: int) -> npt.NDArray[np.int64]:
        """Nodes of a body."""
        return np.flatnonzero(self.of_node == body)

    def cells(self, body: int) -> npt.NDArray[np.int32]:
        """Cells of a body."""
        return np.flatnonzero(self.of_cell == body).astype(np.int32)

    def boxes(self, bodies: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
        """Bounding boxes: lowest and highest corner, shape (2, num_bodies, gdim)."""
        low = np.full(self.x.shape, np.inf)
        high = np.full(self.x.shape, -np.inf)
        np.minimum.at(low, self.of_node, self.x)
        np.maximum.at(high, self.of_node, self.x)
        return np.stack([low[bodies], high[bodies]])
