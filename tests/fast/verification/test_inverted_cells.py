# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells whose nodes come in the inverted order: their Jacobians are negative."""

import numpy as np
import pytest

import meshes
from meshes import Tag
from scenes import CELLS, dimension
from scenes.transforms import Support, differences, jacobians, numbered, oriented, solve


@pytest.mark.parametrize("sliding", ["finite", "small"])
@pytest.mark.parametrize(
    "cell",
    CELLS,
    ids=lambda c: c.name,
)
def test_inverted_cells_have_the_same_contact(cell, sliding):
    """Facets point outward by where their cells are, whatever the order of nodes."""
    gdim = dimension(cell)
    first = numbered(
        meshes.blocks(
            cell,
            (3,) * gdim,
            (4,) * gdim,
            size_lower=(1.5,) * (gdim - 1) + (1.0,),
            shift=(0.217, 0.243)[: gdim - 1],
            gap=0.01,
        )
    )
    supports = (
        Support((Tag.LOWER_BOTTOM,), tuple(range(gdim)), (0.0,) * gdim),
        Support((Tag.UPPER_TOP,), tuple(range(gdim)), (0.0,) * (gdim - 1) + (-0.06,)),
    )
    answer = {}
    for sign in (1, -1):
        scene = oriented(first, sign)
        assert np.all(jacobians(scene) == sign)
        answer[sign] = solve(scene, supports, sliding=sliding)
    assert (answer[1].pressure > 0).sum() > 3
    assert answer[-1].iterations == answer[1].iterations
    np.testing.assert_array_equal(answer[-1].status, answer[1].status)
    off = differences(answer[-1], answer[1])
    print(off)
    assert max(off.values()) <= 1e-9
