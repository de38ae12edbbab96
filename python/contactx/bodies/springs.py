# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Springs at the free modes of bodies, which would make the Jacobian singular."""

from __future__ import annotations

import numpy as np

from contactx.bodies.modes import Array
from contactx.bulk import Bulk
from contactx.parallel import reduce
from contactx.parallel.halo import Halo

# Relative difference of what is equal but for rounding
_TIE = 1e-9


def independent_springs(field: Array, bulk: Bulk, halo: Halo) -> Array:
    """Springs at as many dofs as there are modes, where they are most independent.

    All ranks must take part; on any number of ranks the springs are at the same dofs.

    Args:
        field: Displacements by the modes at owned dofs, shape (num_owned * gdim, k).
        bulk: The bulk, whose diagonal the springs have.
        halo: Nodes on this rank.

    Returns:
        Stiffness at owned dofs, force/length, shape (num_owned * gdim,).
    """
    comm, gdim = halo.comm, halo.gdim
    diagonal = np.abs(bulk.matrix().getDiagonal().array)
    springs = np.zeros(len(field))
    left = np.where(bulk.markers[: len(field), None] == 1, 0.0, field)
    for _ in range(field.shape[1]):
        size = np.einsum("ij,ij->i", left, left)
        most = reduce.largest(comm, float(size.max(initial=0.0)))
        dofs = np.flatnonzero(size >= (1 - _TIE) * most)
        numbers = halo.original[dofs // gdim] * gdim + dofs % gdim
        first = reduce.least(comm, int(numbers.min(initial=np.iinfo(np.int64).max)))
        dof = dofs[numbers == first]
        # No row, and a sum of zero, but on the rank that owns the dof
        direction = reduce.total(comm, left[dof].sum(axis=0))
        direction = direction / np.linalg.norm(direction)
        left = left - np.outer(left @ direction, direction)
        springs[dof] = diagonal[dof]
    return springs
