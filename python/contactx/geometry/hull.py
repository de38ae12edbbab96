# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points in the convex hulls of cells.

DOLFINx has this as a distance, which is of no use here: its collision of points and cells has an
absolute tolerance of 1e-6, and the algorithm below it (GJK) crashes on very flat hexahedra.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
import numpy.typing as npt

_ROUNDING = 1e-12


def in_hulls(
    points: npt.NDArray[np.float64], cells: npt.NDArray[np.float64], tolerance: float
) -> npt.NDArray[np.bool_]:
    """Whether points are in convex hulls, one hull a point, the boundary included.

    By Caratheodory a point of the hull is in the simplex of some of its vertices, whatever the
    cell type.

    Args:
        points: Points, shape (m, gdim).
        cells: Vertices, shape (m, num_vertices, gdim).
        tolerance: How negative a barycentric coordinate may be.

    Returns:
        Whether they are, shape (m,).
    """
    gdim = points.shape[1]
    d = cells - points[:, None]
    # Volumes that the point spans with gdim vertices, taken in ascending order
    faces = list(combinations(range(cells.shape[1]), gdim))
    place = {face: i for i, face in enumerate(faces)}
    volumes = np.linalg.det(d[:, faces])
    simplices = list(combinations(range(cells.shape[1]), gdim + 1))
    opposite = [[place[s[:k] + s[k + 1 :]] for k in range(gdim + 1)] for s in simplices]
    # Their sum with alternating signs is the simplex's own: the shares are the coordinates
    parts = volumes[:, opposite] * (-1.0) ** np.arange(gdim + 1)
    whole = parts.sum(axis=2, keepdims=True)
    flat = np.abs(whole) <= _ROUNDING * np.abs(parts).max(axis=2, keepdims=True)
    shares = parts / np.where(flat, 1, whole)
    inside: npt.NDArray[np.bool_] = (~flat & (shares >= -tolerance)).all(axis=2).any(axis=1)
    return inside
