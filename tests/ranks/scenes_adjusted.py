# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies whose meshes do not fit."""

from __future__ import annotations

from collections.abc import Iterator

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks


def adjusted() -> Iterator[cx.ContactProblem]:
    """Blocks that overlap in the mesh, which counts as none."""
    scene = Blocks(CellType.quadrilateral, gap=-0.02, n_upper=7, n_lower=8)
    problem = scene.problem(scene.contact(friction=0.1, adjust=0.03))
    problem.solve()
    yield problem
