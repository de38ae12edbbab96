# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Iterations of a cantilever bent over a circle, and of a leaf spring, by the number of cells.

python tools/bench/bench_path.py 60 120 360 1000
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables
from bench_globalisation import SCENE

import contactx as cx

from scenes import bent
from scenes.materials import st_venant_kirchhoff
from story import METHODS, elasticity

SIZES = (60, 120, 360, 1000)
# Material and Poisson's ratio
MATERIALS = {
    "linear": (elasticity, 0.0),
    "svk": (st_venant_kirchhoff, 0.0),
    "svk, nu 0.3": (st_venant_kirchhoff, 0.3),
}
COLUMNS: list[tables.Column] = [
    *SCENE,
    ("it", "it", "d"),
    ("failed", "discarded", "d"),
    ("on the path", "interior", "d"),
]


def _row(report: cx.Report) -> dict[str, Any]:
    return {
        "it": report.iterations,
        "discarded": report.discarded,
        "interior": report.interior,
    }


def bend(method: str, material: str, mu: float, cells: int) -> dict[str, Any]:
    """Bend the cantilever."""
    law, nu = MATERIALS[material]
    return _row(bent.cantilever(cells, law, nu, method=method, friction=mu))


def press(method: str, cells: int) -> dict[str, Any]:
    """Press the leaves."""
    return _row(bent.leaves(cells, method=method))


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    sizes = [int(n) for n in argv] or SIZES
    rows = []
    for material in MATERIALS:
        for method in METHODS:
            for mu in (0.0, 0.3):
                for n in sizes:
                    scene = {"method": method, "material": material, "mu": mu, "cells": n}
                    rows.append(
                        {"scene": "cantilever", **scene, **runner.alone("bench_path:bend", **scene)}
                    )
    for method in METHODS:
        scene = {"method": method, "cells": 60}
        row = {"scene": "leaves", "material": "svk", "mu": 0.0, **scene}
        rows.append({**row, **runner.alone("bench_path:press", **scene)})
    tables.show("Interior point", COLUMNS, rows, runner.OUTPUT / "path.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
