# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Steps that end in partial slip: some nodes stick, others slip on, others slip back."""

import pytest

import contactx as cx
from dolfinx.mesh import CellType

from scenes.covering import BOTH, covering
from scenes.driven import DrivenBlock

pytestmark = pytest.mark.usefixtures("method")


@covering(
    cell=(CellType.quadrilateral, CellType.hexahedron),
    base=("plane", "elastic"),
    friction=(0.3, 1.0),
    **{"sliding,method": BOTH},
)
def test_every_reversal_converges(friction, cell, base, sliding):
    """Between a full slide on and a full slide back there are all mixtures of them."""
    gdim, n = (2, 8) if cell == CellType.quadrilateral else (3, 3)
    up = (0.0,) * (gdim - 1) + (1.0,)
    plane = cx.Plane((0.0,) * gdim, up) if base == "plane" else None
    across = (0.0,) * (gdim - 2)
    iterations, mixed = [], 0
    scene = DrivenBlock(
        cell, plane=plane, sliding=sliding, friction=friction, n_upper=n, n_lower=2 * n
    )
    scene.step(0.0, *across, -0.02)
    for back in (0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.04, 0.06):
        scene.step(0.15, *across, -0.02)
        scene.step(0.15 - back, *across, -0.02)
        iterations.append(scene.iterations[-1])
        mixed += scene.count["stick"] > 0 and scene.count["slip"] > 0
    print(iterations, f"{mixed} mixed, most {max(scene.iterations)}")
    assert mixed > 0
    assert max(scene.iterations) <= 12
