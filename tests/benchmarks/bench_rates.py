# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rates of convergence in h of both methods, where the exact solution is known, beside theory.

Errors are relative: the displacement's gradient and the displacement in L2, the nodal pressures,
raw multipliers and contact.pressure, in L2 weighted by area. Each is followed by its rate, the
power of h since the mesh before.

    python tests/benchmarks/bench_rates.py 12 24
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import runner
import tables

import story
from scenes import exact_blocks

# Cells along a unit of length of the slave, multiples of 3
PLANE, SPACE = (12, 24, 48, 96), (6, 12, 18, 24)
CASES = {
    ("smooth", "triangle"): PLANE,
    ("smooth", "quadrilateral"): PLANE,
    ("smooth", "tetrahedron"): SPACE,
    ("smooth", "hexahedron"): SPACE,
    ("hertz", "triangle"): PLANE,
    ("hertz", "quadrilateral"): PLANE,
}
ERRORS = ("H1", "L2", "raw", "best")
# Linear elements. Dual multipliers reproduce constants: their error in L2 is of order h for a
# smooth pressure, and hardly less for Hertz's, which ends as a square root. His displacement, in
# H^(5/2 - eps), may lose half a power in L2 at the edge of the contact. Node to surface fails the
# patch test where nodes do not match: its pressure does not converge, and its displacement only
# as the bodies feel less of a pressure the finer it swings. There is no theory of what recovery
# makes of it.
THEORY = {
    ("smooth", "surface-to-surface"): ("1", "2", ">= 1", ">= 1"),
    ("smooth", "node-to-surface"): (">= 1/2", ">= 1", "0", "none"),
    ("hertz", "surface-to-surface"): ("1", "3/2 to 2", "1 - eps", "1 - eps"),
    ("hertz", "node-to-surface"): (">= 1/2", ">= 1", "0", "none"),
}
NAMES = {"H1": "grad u", "L2": "u", "raw": "p raw", "best": "p"}
COLUMNS: list[tables.Column] = [
    ("solution", "solution", "s"),
    ("cells", "cells", "s"),
    ("method", "method", "s"),
    ("1/h", "n", "s"),
    ("dofs", "dofs", "s"),
    *(
        column
        for key in ERRORS
        for column in ((NAMES[key], key, "s"), ("rate", f"{key} rate", "s"))
    ),
]


def measure(solution: str, cells: str, method: str, n: int) -> dict[str, Any]:
    """Solve in this process and return the errors."""
    solve = {"smooth": exact_blocks.smooth, "hertz": exact_blocks.hertz}[solution]
    return solve(cells, n, method)


def run(sizes: Sequence[int]) -> list[dict[str, Any]]:
    """Measure all cases with their rates.

    Args:
        sizes: Cells along a unit of length; those of each case if empty.
    """
    rows = []
    for (solution, cells), of_case in CASES.items():
        for method in story.METHODS:
            job = {"solution": solution, "cells": cells, "method": method}
            before: dict[str, Any] = {}
            for n in sizes or of_case:
                row = runner.alone("bench_rates:measure", **job, n=n)
                for key in ERRORS:
                    if key in before and key in row:
                        row[f"{key} rate"] = float(
                            np.log(before[key] / row[key]) / np.log(n / before["n"])
                        )
                rows.append(row)
                before = row
    return rows


def printed(rows: Sequence[dict[str, Any]]) -> list[dict[str, str]]:
    """Rows as text, with theory below those of each case."""
    lines = []
    for k, row in enumerate(rows):
        line = {key: f"{value}" for key, value in row.items()}
        for key in ERRORS:
            for name, form in ((key, ".2e"), (f"{key} rate", ".2f")):
                if name in row:
                    line[name] = format(row[name], form)
        lines.append(line)
        case = [row[key] for key in ("solution", "cells", "method")]
        if k + 1 == len(rows) or case != [
            rows[k + 1][key] for key in ("solution", "cells", "method")
        ]:
            theory = THEORY[row["solution"], row["method"]]
            rates = {f"{key} rate": rate for key, rate in zip(ERRORS, theory, strict=True)}
            lines.append({"solution": "", "cells": "", "method": "theory", **rates})
    return lines


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    rows = run([int(n) for n in argv])
    tables.show("Rates of convergence", COLUMNS, printed(rows), runner.OUTPUT / "rates.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
