# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Ironing by both methods: iterations, forces, and how they swing as facets pass under the die.

Quadrilaterals and hexahedra, without friction and with mu = 0.3, either body as the slave. Swings
are largest deviations from a cubic along the drag over the mean vertical force; the band is the
largest one of a table. See ``demos/ironing.py``.

    python tools/bench/bench_ironing.py 2 0.05
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables
from ironing import FRICTIONS, Ironing

import story

# Dimension and cell size of the block
SCENES = ((2, 1 / 12), (2, 1 / 24), (3, 0.13))
COLUMNS: list[tables.Column] = [
    ("dim", "dim", "d"),
    ("h", "h", ".3f"),
    ("slave", "slave", "s"),
    ("mu", "friction", "g"),
    ("method", "method", "s"),
    ("dofs", "dofs", "d"),
    ("steps", "steps", "d"),
    ("it, all", "total", "d"),
    ("most", "most", "d"),
    ("frozen", "frozen", "d"),
    ("CPU s", "cpu", ".1f"),
    ("vertical", "down", ".5f"),
    (": other", "apart", "+.4f"),
    ("along", "along", ".5f"),
    ("swing, along", "swing_along", ".4f"),
    ("vertical", "swing_down", ".4f"),
]


def measure(dim: int, h: float, slave: str, friction: float, method: str) -> dict[str, Any]:
    """Iron in this process."""
    run = Ironing(h, dim, friction, method, slave)
    meter = runner.Meter()
    run.run()
    along, down = run.means()
    return {
        **meter.read(),
        "dofs": len(run.u.x.array),
        "steps": len(run.iterations),
        "total": sum(run.iterations),
        "most": max(run.iterations),
        "frozen": run.frozen_steps,
        "down": down,
        "along": along,
        "swing_along": run.swing(0) / down,
        "swing_down": run.swing(-1) / down,
    }


def run(scenes: Sequence[tuple[int, float]]) -> list[dict[str, Any]]:
    """Measure scenes by all methods, and how far the vertical forces are apart."""
    rows = []
    for dim, h in scenes:
        for slave in ("die", "block"):
            for friction in FRICTIONS:
                job = {"dim": dim, "h": h, "slave": slave, "friction": friction}
                found = [
                    runner.alone("bench_ironing:measure", **job, method=method)
                    for method in story.METHODS
                ]
                for row in found[1:]:
                    if "down" in row and "down" in found[0]:
                        row["apart"] = row["down"] / found[0]["down"] - 1
                rows += found
    return rows


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print; arguments are a dimension and a cell size."""
    rows = run([(int(argv[0]), float(argv[1]))] if argv else SCENES)
    tables.show("Ironing", COLUMNS, rows, runner.OUTPUT / "ironing.csv")
    for method in story.METHODS:
        swings = [
            row[key]
            for row in rows
            for key in ("swing_along", "swing_down")
            if row["method"] == method and key in row
        ]
        if swings:
            tables.note(f"{method}: all forces within {100 * max(swings):.1f} % of a smooth curve")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
