# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which rank has which cell, by the middles of the cells."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from dolfinx.cpp.mesh import cell_num_vertices
from dolfinx.graph import adjacencylist

type Points = npt.NDArray[np.float64]
type Ranks = npt.NDArray[np.int32]


def by_middles(ranks_of: Callable[[Points, int], Ranks], x: Points) -> Callable[..., Any]:
    """A partitioner of a mesh all of whose cells are on one rank.

    Args:
        ranks_of: Gives the ranks of cells by their middles and the number of ranks.
        x: Positions of the nodes on the rank that has the cells, empty elsewhere.
    """

    def partitioner(comm: MPI.Comm, size: int, cell_types: Any, cells: Any) -> Any:
        width = cell_num_vertices(cell_types[0])
        nodes = np.asarray(cells[0], dtype=np.int64).reshape(-1, width)
        ranks = ranks_of(x[nodes].mean(axis=1), size) if len(nodes) else np.zeros(0, np.int32)
        return adjacencylist(ranks.reshape(-1, 1))._cpp_object

    return partitioner


def strips(x: Points, size: int) -> Ranks:
    """Strips along x of about as many cells each."""
    return parts(x[:, 0], size)


def parts(value: npt.NDArray[np.float64], size: int) -> Ranks:
    """Parts of about as many cells each, in the order of a value."""
    ranks = np.empty(len(value), dtype=np.int32)
    ranks[np.argsort(value, kind="stable")] = np.arange(len(value)) * size // len(value)
    return ranks
