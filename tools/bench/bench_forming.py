# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear solves of a strip of steel that a punch bends by 30 mm over a round support.

python tools/bench/bench_forming.py 30
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables

from scenes.forming import BentStrip

COLUMNS: list[tables.Column] = [
    ("mm", "way", "g"),
    ("mu", "mu", "g"),
    ("it", "it", "d"),
    ("failed", "discarded", "d"),
    ("force [N/mm]", "force", ".4f"),
    ("support [N/mm]", "support", ".4f"),
]


def bend(way: float, mu: float) -> dict[str, Any]:
    """Bend the strip, in steps of half a millimetre."""
    scene = BentStrip(friction=mu)
    solves, failed = scene.bend(way, round(2 * way))
    return {
        "it": solves,
        "discarded": failed,
        "force": -scene.punch.force[1],
        "support": scene.support.force[1],
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    ways = [float(way) for way in argv] or [30.0]
    scenes = [{"way": way, "mu": mu} for way in ways for mu in (0.0, 0.1)]
    rows = [s | runner.alone("bench_forming:bend", **s) for s in scenes]
    tables.show("Bent strip", COLUMNS, rows, runner.OUTPUT / "forming.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
