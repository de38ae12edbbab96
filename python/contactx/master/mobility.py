# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How much Dirichlet conditions leave of a relative movement."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import Array, Weights


def pair_weights(pairs: Pairs, xi: Array) -> Array:
    """1 for the slave node and -N_l at local coordinates, shape (num_pairs, 1 + num_nodes)."""
    N = core.shape_functions(pairs.num_nodes, np.ascontiguousarray(xi))
    return np.column_stack([np.ones(len(N)), -N])


def free_squares(pairs: Pairs, xi: Array, free: npt.NDArray[np.bool_]) -> Array:
    """Sums of the squared weights of what may move, shape (num_pairs, gdim)."""
    weight = pair_weights(pairs, xi)
    squares: Array = ((weight[:, :, None] * free[pairs.nodes]) ** 2).sum(axis=1)
    return squares


def constrained_squares(
    weights: Weights, free: npt.NDArray[np.bool_], paired: npt.NDArray[np.bool_]
) -> Array:
    """The same for slave nodes whose constraints gather from several facets.

    Args:
        weights: Relative movement of the slave nodes.
        free: Which displacements of all nodes are not prescribed, shape (num_nodes, gdim).
        paired: Whether each slave node has a pair, shape (n,).

    Returns:
        Sums, one where nothing is prescribed, shape (n, gdim).
    """
    n = len(paired)
    constrained = np.zeros(n, dtype=bool)
    constrained[weights.slaves[~free.all(axis=1)[weights.nodes]]] = True
    some = constrained[weights.slaves]
    weights = Weights(*(a[some] for a in vars(weights).values()))
    # Parts of several facets with the same node add up
    key = weights.slaves * np.int64(len(free)) + weights.nodes
    key, place = np.unique(key, return_inverse=True)
    slaves, nodes = np.divmod(key, len(free))
    moves = np.bincount(place, weights.values)[:, None] * free[nodes]
    squares: Array = np.stack([np.bincount(slaves, m**2, n) for m in moves.T], axis=1)
    squares[~(paired & constrained)] = 1
    return squares
