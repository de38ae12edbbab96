# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies, the connected parts of a mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.nodes import linear_cells, parts_of_cells
from contactx._host.parallel.halo import Halo
from dolfinx import fem


class Bodies(core.Bodies):
    """Connected parts of a mesh, on any number of ranks; bodies share no nodes.

    A body is named by the smallest number that a node of it has in the mesh as it was made.

    Attributes:
        V: Lagrange space of vectors of degree 1 or 2, whose blocks are the nodes.
        linear_cells: Linear cells between the nodes, shape (num_cells, num_vertices).
        halo: Nodes on this rank.
    """

    def __init__(self, V: fem.FunctionSpace, halo: Halo):
        """Find the bodies; all ranks must take part.

        Args:
            V: Lagrange space of vectors of degree 1 or 2.
            halo: Nodes on this rank.
        """
        topology = V.mesh.topology
        self.linear_cells = linear_cells(V)
        super().__init__(
            self.linear_cells,
            topology.index_map(topology.dim).size_local * parts_of_cells(V),
            halo.original[: halo.num_bulk],
            halo.nodes,
        )
        self.V = V
        self.halo = halo

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Reference positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.x
