# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the audit of the converged iterate costs on the common Hertz problem, by the report's timer.

python tools/bench/bench_audit.py 0.02 0.01
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import hertz_case
import runner
import tables

import scenes
import story

SIZES = (0.02, 0.01)
COLUMNS: list[tables.Column] = [
    ("h", "h", "g"),
    ("method", "method", "s"),
    ("sliding", "sliding", "s"),
    ("dofs", "dofs", "d"),
    ("it", "it", "d"),
    ("all s", "total", ".2f"),
    ("audit s", "audit", ".4f"),
    ("%", "percent", ".2f"),
    ("of what the mesh explains", "excess", ".3f"),
]


def measure(h: float, sliding: str, method: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        h: Cell size in the contact.
        sliding: "finite" or "small".
        method: Method of the contact.
    """
    data = hertz_case.read_mesh(hertz_case.mesh_file(h))
    problem = scenes.HertzSphere(data, sliding, method=method).problem
    problem.solve()
    report = problem.report
    total, audit = report.times["total"], report.times["audit"]
    return {
        "h": h,
        "sliding": sliding,
        "method": method,
        "dofs": hertz_case.counts(problem)["dofs"],
        "it": report.iterations,
        "total": total,
        "audit": audit,
        "percent": 100 * audit / total,
        "excess": report.audit.excess,
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    rows = [
        runner.alone("bench_audit:measure", h=h, sliding=sliding, method=method)
        for h in [float(h) for h in argv] or SIZES
        for sliding in ("finite", "small")
        for method in story.METHODS
    ]
    tables.show("Audit of a Hertz run", COLUMNS, rows, runner.OUTPUT / "audit.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
