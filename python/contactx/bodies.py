# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies, the connected parts of a mesh, and the bulk as free ones of the core see it."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.bulk import Bulk
from contactx.parallel.halo import Halo
from dolfinx import fem

type Array = npt.NDArray[np.float64]


class Bodies(core.Bodies):
    """Connected parts of a mesh, on any number of ranks; bodies share no nodes.

    A body is named by the smallest number that a node of it has in the mesh as it was made.

    Attributes:
        V: Linear Lagrange space of vectors, whose blocks are the nodes.
        halo: Nodes on this rank.
    """

    def __init__(self, V: fem.FunctionSpace, halo: Halo):
        """Find the bodies; all ranks must take part.

        Args:
            V: Linear Lagrange space of vectors.
            halo: Nodes on this rank.
        """
        topology = V.mesh.topology
        super().__init__(
            V.dofmap.list,
            topology.index_map(topology.dim).size_local,
            halo.original[: halo.num_bulk],
            halo.nodes,
        )
        self.V = V
        self.halo = halo

    @property
    def x(self) -> npt.NDArray[np.float64]:
        """Reference positions of all nodes, shape (num_nodes, gdim)."""
        return self.halo.x

    def boxes(self, bodies: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
        """Bounding boxes of bodies on all ranks, which must take part.

        Args:
            bodies: Names, the same on all ranks.

        Returns:
            Lowest and highest corner, shape (2, num_bodies, gdim).
        """
        return self.boxes_of(bodies, self.x, self.halo.gdim)


class BulkSide:
    """The bulk, as the core's ``Bulk`` describes it."""

    def __init__(self, bulk: Bulk, halo: Halo):
        """Take the bulk and its nodes."""
        self._bulk = bulk
        self._halo = halo
        self.gdim = halo.gdim

    @property
    def is_linear(self) -> bool:
        """Whether the stiffness does not depend on the displacement."""
        return self._bulk.is_linear

    @property
    def reference(self) -> Array:
        """Reference positions of all nodes."""
        return self._halo.x

    def positions(self) -> Array:
        """Current positions of all nodes."""
        return self._halo.positions()

    @property
    def displacements(self) -> Array:
        """Displacements at owned dofs."""
        u: Array = self._bulk.u.x.array[: self._halo.num_owned * self.gdim]
        return u

    @property
    def markers(self) -> npt.NDArray[np.int8]:
        """1 at owned dofs with a Dirichlet condition."""
        return self._bulk.markers[: self._halo.num_owned * self.gdim]

    def diagonal(self) -> Array:
        """Diagonal of the stiffness at owned dofs."""
        diagonal: Array = self._bulk.matrix().getDiagonal().array
        return diagonal

    def products(self, fields: Array) -> Array:
        """Products of the stiffness with fields at owned dofs, shape (count, num_dofs)."""
        K = self._bulk.matrix()
        x, y = K.createVecs()
        results = np.empty_like(fields)
        for field, result in zip(fields, results, strict=True):
            x.array[:] = field
            K.mult(x, y)
            result[:] = y.array
        return results
