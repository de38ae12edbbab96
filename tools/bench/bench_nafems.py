# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Problems 1 and 2 of NAFEMS R0094 by both methods, on straight and curved cells.

The roller in plane strain; the rounded punch by its section, and as a quarter in 3D. What is
compared is the vertical displacement of the foundation under the middle. The gallery has the first
row of each problem and friction.

    python tools/bench/bench_nafems.py 0.5
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables

import measured
import story
from scenes import nafems

COLUMNS: list[tables.Column] = [
    ("problem", "problem", "s"),
    ("friction", "friction", "g"),
    ("model", "model", "s"),
    ("h, mm", "h", "g"),
    ("method", "method", "s"),
    ("dofs", "dofs", ",d"),
    ("it", "iterations", "d"),
    ("published", "published", ".5g"),
    ("contactx", "value", ".5g"),
    ("error", "error", "+.2%"),
]
# Model, size of cells in mm, order of the cells
ROLLER = (("half, straight cells", 0.5, 1), ("half, curved cells", 0.5, 2))
PUNCH = (("section", 1.0, 1), ("section", 0.5, 1), ("quarter in 3D, curved cells", 2.0, 2))
FRICTION = (0.0, 0.1)


def roller(h: float, order: int, method: str) -> dict[str, Any]:
    """Problem 1, in this process."""
    return _solved(nafems.roller(h, order=order, method=method), nafems.ROLLER)


def punch(h: float, order: int, method: str, friction: float) -> dict[str, Any]:
    """Problem 2, in this process: in 3D where cells are curved."""
    dim = 3 if order > 1 else 2
    benchmark = nafems.punch(h, dim=dim, order=order, method=method, friction=friction)
    return _solved(benchmark, nafems.PUNCH[friction])


def _solved(benchmark: nafems.Benchmark, published: float) -> dict[str, Any]:
    problem = benchmark.problem
    problem.solve()
    value = benchmark.depth()
    counts = {"dofs": len(problem.u.x.array), "iterations": problem.report.iterations}
    return {**counts, "published": published, "value": value, "error": value / published - 1}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print, with cells of all sizes times the first argument."""
    factor = float(argv[0]) if argv else 1.0
    rows = []
    for model, h, order in ROLLER:
        for method in story.METHODS:
            job = {"h": factor * h, "order": order, "method": method}
            row = {"problem": "roller", "friction": 0.0, "model": model}
            rows.append({**row, **runner.alone("bench_nafems:roller", **job)})
    for friction in FRICTION:
        for model, h, order in PUNCH:
            # The quarter takes minutes: by surface-to-surface alone, as its test
            for method in story.METHODS[order - 1 :]:
                job = {"h": factor * h, "order": order, "method": method, "friction": friction}
                row = {"problem": "punch", "model": model}
                rows.append({**row, **runner.alone("bench_nafems:punch", **job)})
    title = "NAFEMS R0094: vertical displacement under the middle, mm"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "nafems.csv")
    return rows


if __name__ == "__main__":
    sys.exit(measured.run("nafems", main, sys.argv[1:]))
