# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""All axes at once, at random."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dolfinx.mesh import CellType

from stress.families.grid import ALL_CELLS, block_case, scenes
from stress.scene import METHODS, SLIDINGS, Scene

_ROWS, _COLUMNS = 20, 20


def mixture() -> Iterator[Scene]:
    """Random scenes: each axis is drawn by itself."""
    rows = [{"row": row} for row in range(_ROWS)]
    yield from scenes("all at random", range(_COLUMNS), rows, _draw)


def _draw(column, row):
    rng = np.random.default_rng(1000 + _COLUMNS * row + column)
    cell: CellType = ALL_CELLS[rng.integers(4)]
    most = 12 if cell in (CellType.quadrilateral, CellType.triangle) else 5

    def cells():
        return int(rng.integers(1, most + 1)), int(rng.integers(1, most // 2 + 1))

    gap = rng.choice([0.0, 0.0, 1e-9, 1e-3, 0.05, -1e-6, -0.02])
    is_small = rng.random() < 0.3
    return block_case(
        cell=cell,
        n_upper=cells(),
        n_lower=cells(),
        shift=float(rng.uniform(0, 0.4)),
        gap=float(gap),
        radius=None if rng.random() < 0.5 else float(rng.uniform(1.5, 10)),
        young=(1.0, 10.0 ** rng.uniform(-6, 6)),
        nu=tuple(rng.choice([0.0, 0.3, 0.45, 0.4999], 2)),
        friction=float(rng.choice([0.0, 0.05, 0.3, 1.0, 5.0])),
        method=METHODS[rng.integers(2)],
        sliding=SLIDINGS[int(is_small)],
        material=["linear", "neo-hooke"][rng.integers(2)],
        down=float(gap + 10.0 ** rng.uniform(-4, -0.7)),
        side=float(rng.choice([0.0, 0.0, 0.01, 0.1, 0.3])),
        swapped=bool(rng.random() < 0.3),
        noise=float(rng.choice([0.0, 0.0, 0.2])),
        turn=int(rng.integers(100)) if rng.random() < 0.5 else None,
        away=float(rng.choice([0.0, 0.0, 10.0, 1000.0])),
        length=float(10.0 ** rng.uniform(-3, 3)),
        modulus=float(10.0 ** rng.uniform(-3, 9)),
        steps=int(rng.choice([1, 1, 3])),
        options={"pc_type": "condensed"} if rng.random() < 0.25 else None,
    )
