# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the eliminations of all ranks are together."""

from __future__ import annotations

import numpy as np

from contactx.condensed.blocks import NotCondensable
from contactx.condensed.elimination import Elimination
from contactx.condensed.numbering import Numbering
from contactx.parallel import reduce


def check_chains(elimination: Elimination, numbering: Numbering, gdim: int) -> None:
    """Check that no elimination needs another one; all ranks must take part.

    Args:
        elimination: That of this rank.
        numbering: Displacements on this rank.
        gdim: Geometric dimension.

    Raises:
        NotCondensable: On all ranks, where a node is slave in one contact and master in another.
    """
    left, right = elimination.left, elimination.right
    mark = numbering.marks(elimination.recovered)
    taken = numbering.marks(elimination.eliminated)
    # A row that is taken over must not get one, nor a displacement follow from another
    crossed = mark[left.rows] & mark[left.columns]
    within = left.rows // gdim == left.columns // gdim
    chained = taken[right.columns] & (right.rows != right.columns)
    if reduce.anywhere(numbering.comm, np.any(crossed & ~within) or np.any(chained)):
        raise NotCondensable("a node is slave in one contact and master in another")


def is_symmetric(elimination: Elimination, numbering: Numbering) -> bool:
    """Whether ``left`` is the transpose of ``right`` and there is no law; all must take part.

    But for eliminated rows and rounding.

    Args:
        elimination: That of this rank.
        numbering: Displacements on this rank.
    """
    taken = numbering.marks(elimination.eliminated)
    # Both entries of a slave node are on its own rank
    left = elimination.left.select(~taken[elimination.left.rows])
    right = elimination.right.select(elimination.right.rows != elimination.right.columns)
    a = np.lexsort((left.rows, left.columns))
    b = np.lexsort((right.columns, right.rows))
    same = (
        len(a) == len(b)
        and np.array_equal(left.rows[a], right.columns[b])
        and np.array_equal(left.columns[a], right.rows[b])
        and np.allclose(left.values[a], right.values[b], rtol=0, atol=1e-8)
    )
    return reduce.everywhere(numbering.comm, same and not elimination.slips)
