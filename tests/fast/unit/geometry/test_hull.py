# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points in convex hulls, against coordinates that are known and against SciPy."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from contactx.geometry.hull import in_hulls

SQUARE = np.array([[i, j] for j in (0.0, 1) for i in (0.0, 1)])
CUBE = np.array([[i, j, k] for k in (0.0, 1) for j in (0.0, 1) for i in (0.0, 1)])
SIMPLICES = [np.vstack([np.zeros(d), np.eye(d)]) for d in (2, 3)]
PRISM = CUBE[[0, 1, 2, 4, 5, 6]]


@pytest.mark.parametrize("cell", [SQUARE, CUBE, *SIMPLICES])
@pytest.mark.parametrize("thinnest", [0, -3, -6])
def test_affine_cells(cell, thinnest):
    """Flat and tiny cells in any direction; points on corners, edges and faces are inside."""
    n, gdim = 400, cell.shape[1]
    rng = np.random.default_rng(1)
    maps = rng.standard_normal((n, gdim, gdim)) * 10.0 ** rng.uniform(thinnest, 0, (n, 1, gdim))
    maps *= 10.0 ** rng.uniform(-12, 6, (n, 1, 1))
    xi = rng.uniform(-0.5, 1.5, (n, gdim))
    xi[: n // 4] = cell[rng.integers(len(cell), size=n // 4)]
    xi[n // 4 : n // 2] = cell[:2].mean(axis=0)
    xi[n // 2 : n // 2 + 20] = cell.mean(axis=0)
    simplex = len(cell) == gdim + 1
    excess = np.maximum((-xi).max(axis=1), xi.sum(axis=1) - 1 if simplex else xi.max(axis=1) - 1)
    shift = maps @ rng.uniform(-2, 2, gdim)
    points = np.einsum("nij,nj->ni", maps, xi) + shift
    cells = np.einsum("nij,vj->nvi", maps, cell) + shift[:, None]
    found = in_hulls(points, cells, 1e-8)
    np.testing.assert_array_equal(found[np.abs(excess) > 1e-6], (excess < 0)[np.abs(excess) > 1e-6])
    assert found[excess <= 0].all()
    assert (~found).sum() > n // 10


@pytest.mark.parametrize("cell", [SQUARE, CUBE, PRISM])
def test_general_cells(cell):
    """Warped hexahedra too, as convex hulls."""
    rng = np.random.default_rng(2)
    for _ in range(20):
        corners = cell + rng.uniform(-0.3, 0.3, cell.shape)
        points = rng.uniform(-0.3, 1.3, (200, cell.shape[1]))
        wanted = Delaunay(corners).find_simplex(points) >= 0
        found = in_hulls(points, np.tile(corners, (len(points), 1, 1)), 1e-8)
        np.testing.assert_array_equal(found, wanted)
        assert 0 < wanted.sum() < len(points)
