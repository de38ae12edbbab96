# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells that a displacement turns inside out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel import reduce
from contactx.refined import linear_cells, parts_of_cells, reference_positions
from dolfinx import fem


class Squeezed(NamedTuple):
    """Smallest det F of the cells of all ranks, and the number of cells turned inside out.

    Attributes:
        smallest: Smallest det F, at the points that ``deformed_cells.h`` names.
        inverted: Number of cells with det F <= 0 somewhere.
        at: Midpoint of the cell with the smallest det F in the reference configuration, shape
            (gdim,).
    """

    smallest: float
    inverted: int
    at: npt.NDArray[np.float64]


class DeformedCells:
    """The cells of a mesh, looked at under any displacement of degree 1 or 2.

    They are taken as those with straight edges between their nodes: of a quadratic displacement the
    linear cells that it has the nodes of, each of which counts for itself.
    """

    def __init__(self, V: fem.FunctionSpace):
        """Take the cells that this rank owns, each looked at once.

        Args:
            V: Space of the displacement.
        """
        domain = V.mesh
        self._comm = domain.comm
        owned = domain.topology.index_map(domain.topology.dim).size_local
        self._cells = linear_cells(V)[: owned * parts_of_cells(V)]
        self._X = reference_positions(V)

    def look(self, u: npt.NDArray[np.float64]) -> Squeezed:
        """Look at all cells; all ranks must take part.

        Args:
            u: Displacements of this rank's nodes, ghosts included, shape (num_nodes * gdim,) or
                longer.

        Returns:
            What the cells of all ranks are like, on every rank the same.
        """
        smallest, cell, inverted = core.deformed_cells(self._cells, self._X, u, self._X.shape[1])
        mine = []
        if cell >= 0:
            at = self._X[self._cells[cell]].mean(axis=0)
            mine.append((smallest, at))
        keys = [(value, tuple(place)) for value, place in mine]
        smallest, at = reduce.first(self._comm, keys, mine)
        return Squeezed(smallest, reduce.total(self._comm, inverted), at)
