# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rates of convergence in h of both methods, where the exact solution is known, beside theory.

Errors are relative: the displacement's gradient and the displacement in L2, the nodal pressures,
raw multipliers and contact.pressure, in L2 weighted by area, and contact.pressure integrated as a
function. Each is followed by its rate, the power of h since the mesh before. Of Hertz's pressure
the error lies where it ends, and depends on where that is in a facet: the root of the mean square
over contacts at several places is given.

    python tools/bench/bench_rates.py 12 24
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import runner
import tables

import story
from scenes import exact, exact_blocks

# Cells along a unit of length of the slave, multiples of 3
PLANE, SPACE = (12, 24, 48, 96), (6, 12, 18, 24)
# With quadratic displacements
SQUARE, CUBE = (6, 12, 24, 48), (3, 6, 9, 12)
CASES = {
    ("smooth", "triangle", 1): PLANE,
    ("smooth", "quadrilateral", 1): PLANE,
    ("smooth", "tetrahedron", 1): SPACE,
    ("smooth", "hexahedron", 1): SPACE,
    ("hertz", "triangle", 1): PLANE,
    ("hertz", "quadrilateral", 1): PLANE,
    ("smooth", "triangle", 2): SQUARE,
    ("smooth", "quadrilateral", 2): SQUARE,
    ("smooth", "tetrahedron", 2): CUBE,
    ("smooth", "hexahedron", 2): CUBE,
    ("tied", "triangle", 2): SQUARE,
    ("tied", "quadrilateral", 2): SQUARE,
    ("tied", "tetrahedron", 2): CUBE,
    ("tied", "hexahedron", 2): CUBE,
    ("hertz", "triangle", 2): PLANE,
    ("hertz", "quadrilateral", 2): PLANE,
}
# Places of Hertz's contact along the face
PLACES = 6
ERRORS = ("H1", "L2", "raw", "best", "field")
# Linear elements. Dual multipliers reproduce constants: their error in L2 is of order h for a
# smooth pressure, and hardly less for Hertz's, which ends as a square root. His displacement, in
# H^(5/2 - eps), may lose half a power in L2 at the edge of the contact. Node to surface fails the
# patch test where nodes do not match: its pressure does not converge, and its displacement only
# as the bodies feel less of a pressure the finer it swings. There is no theory of what recovery
# makes of it.
# Quadratic elements. Dual multipliers, of a transformed basis on triangles of 6 nodes, and parts of
# linear facets for nodes; Hertz's displacement allows no more than 3/2 and 2.
_NODES = (">= 1/2", ">= 1", "0", "none", "none")
THEORY = {
    ("smooth", "surface-to-surface", 1): ("1", "2", ">= 1", ">= 1", ">= 1"),
    ("hertz", "surface-to-surface", 1): ("1", "3/2 to 2", "1 - eps", "1 - eps", "1 - eps"),
    ("smooth", "surface-to-surface", 2): ("2", "3", ">= 3/2", ">= 3/2", ">= 3/2"),
    ("tied", "surface-to-surface", 2): ("2", "3", ">= 3/2", ">= 3/2", ">= 3/2"),
    ("hertz", "surface-to-surface", 2): ("3/2", "2", "1 - eps", "1 - eps", "1 - eps"),
    **{
        (solution, "node-to-surface", degree): _NODES
        for solution in ("smooth", "tied", "hertz")
        for degree in (1, 2)
    },
}
NAMES = {"H1": "grad u", "L2": "u", "raw": "p raw", "best": "p", "field": "p(x)"}
COLUMNS: list[tables.Column] = [
    ("solution", "solution", "s"),
    ("degree", "degree", "s"),
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


def measure(solution: str, cells: str, method: str, n: int, degree: int) -> dict[str, Any]:
    """Solve in this process and return the errors."""
    if solution != "hertz":
        return exact_blocks.smooth(cells, n, method, degree=degree, tied=solution == "tied")
    found = [
        exact_blocks.hertz(cells, n, method, degree=degree, middle=exact.MIDDLE + place / 73)
        for place in range(PLACES)
    ]
    means = {key: float(np.sqrt(np.mean([f[key] ** 2 for f in found]))) for key in ERRORS}
    return {**found[0], **means}


def run(sizes: Sequence[int]) -> list[dict[str, Any]]:
    """Measure all cases with their rates.

    Args:
        sizes: Cells along a unit of length; those of each case if empty.
    """
    rows = []
    for (solution, cells, degree), of_case in CASES.items():
        for method in story.METHODS:
            job = {"solution": solution, "cells": cells, "method": method, "degree": degree}
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
        names = ("solution", "cells", "method", "degree")
        case = [row[key] for key in names]
        if k + 1 == len(rows) or case != [rows[k + 1][key] for key in names]:
            theory = THEORY[row["solution"], row["method"], row["degree"]]
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
