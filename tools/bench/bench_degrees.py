# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Linear and quadratic displacements by both methods: error of the pressure against time.

The common Hertz problem on the same straight meshes, and on curved ones. Process CPU seconds on one
thread from the read mesh to the converged solution, the least of some runs, each in a process of
its own. The error is integrated over the slave's facets.

    python tools/bench/bench_degrees.py 0.04 0.02
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import hertz_case
import pictures
import runner
import tables

import measured
import scenes
import story

SIZES = (0.08, 0.04, 0.02)
RUNS = 3
# Degrees of the displacement with the meshes that they are solved on
KINDS = ((1, "tetrahedra"), (2, "tetrahedra"), (2, "curved"))
COLUMNS: list[tables.Column] = [
    ("degree", "degree", "d"),
    ("cells", "cells", "s"),
    ("h", "h", "g"),
    ("method", "method", "s"),
    ("dofs", "dofs", "d"),
    ("it", "iterations", "d"),
    ("CPU s", "cpu", ".2f"),
    ("4F", "force", ".7f"),
    ("p_l2", "error", ".4f"),
]


def measure(path: str, degree: int, method: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        path: File of the mesh.
        degree: Degree of the displacement.
        method: Method of the contact.
    """
    data = hertz_case.read_mesh(path)
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, "finite", method=method, degree=degree)
    scene.problem.solve()
    measured = meter.read()
    error = scenes.integrated_error(scene.contact, data.facet_tags)
    force = 4 * float(scene.contact.force[2])
    return {**hertz_case.counts(scene.problem), **measured, "error": error, "force": force}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure all and draw it."""
    rows = []
    for h in map(float, argv or SIZES):
        for method in story.METHODS:
            for degree, cells in KINDS:
                path = str(hertz_case.mesh_file(h, cells))
                job = {"path": path, "degree": degree, "method": method}
                found = [runner.alone("bench_degrees:measure", **job) for _ in range(RUNS)]
                row = min(found, key=lambda row: row.get("cpu", 0))
                rows.append({"h": h, "cells": cells, **job, **row})
    title = "Common Hertz problem, linear and quadratic displacement"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "degrees.csv")
    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if "cpu" in row:
            kind = "curved" if row["cells"] == "curved" else f"degree {row['degree']}"
            groups.setdefault(f"{kind}, {row['method']}", []).append(row)
    pictures.lines(
        groups,
        runner.OUTPUT / "degrees.png",
        ours=len(groups),
        axes=(("cpu", "error"), ("dofs", "error")),
        words={
            "cpu": "process CPU seconds, one thread",
            "dofs": "displacements",
            "error": "relative L2 error of the pressure",
        },
        title="Common Hertz problem, linear and quadratic displacement",
    )
    return rows


if __name__ == "__main__":
    sys.exit(measured.run("degrees", main, sys.argv[1:]))
