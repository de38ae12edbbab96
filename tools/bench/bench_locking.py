# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How much elements lock where a material hardly changes its volume.

Force of the rigid disc of demos/incompressible.py over that of Taylor and Hood's elements on the
finest mesh of the list.

    python tools/bench/bench_locking.py 16 32 64 128
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner  # isort: skip, it finds the demos

import incompressible
import tables

SIZES = (16, 32, 64, 128)


def measure(kind: str, n: int) -> dict[str, Any]:
    """Solve in this process."""
    square = incompressible.Square(kind, n)
    square.problem.solve()
    return {"force": square.force, "iterations": square.problem.report.iterations}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    sizes = [int(n) for n in argv] or list(SIZES)
    found = {
        (kind, n): runner.alone("bench_locking:measure", kind=kind, n=n)
        for kind in incompressible.KINDS
        for n in sizes
    }
    finest = found["Taylor-Hood", max(sizes)]["force"]
    rows = [
        {"elements": kind, **{f"n = {n}": found[kind, n]["force"] / finest for n in sizes}}
        for kind in incompressible.KINDS
    ]
    columns: list[tables.Column] = [
        ("elements", "elements", "s"),
        *((f"n = {n}", f"n = {n}", ".3f") for n in sizes),
    ]
    title = "Force over that of the finest Taylor-Hood elements, nu = 0.4999"
    tables.show(title, columns, rows, runner.OUTPUT / "locking.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
