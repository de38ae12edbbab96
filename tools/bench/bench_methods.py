# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Both methods on the common Hertz problem: error against time and against h, and unlike bodies.

On tetrahedra, and on hexahedra of a sphere's part on the same block. Process CPU seconds on one
thread from the read mesh to the converged solution, the least of some runs, each in a process of
its own; the methods take turns, so that both see the same machine. Errors are those of the raw
multipliers and of contact.pressure. Last, one body is 1e4 times stiffer than the other.

    python tools/bench/bench_methods.py 0.02 0.01
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import hertz_case
import pictures
import runner
import tables

import measured
import scenes
import story
from meshes import Tag

SIZES = {"tetrahedra": (0.04, 0.02, 0.01, 0.005), "hexahedra": (0.04, 0.02, 0.01)}
SLIDINGS = ("finite", "small")
RUNS = 3
# Young's modulus of the stiff body over that of the soft one, and the size
STIFFER, STIFF_SIZE = 1e4, 0.02
BODIES = {"sphere": Tag.UPPER, "block": Tag.LOWER}

ERRORS: list[tables.Column] = [
    ("p0 raw", "p0_err", ".4f"),
    ("p0", "p0_best", ".4f"),
    ("p_l2 raw", "p_l2", ".4f"),
    ("p_l2", "p_l2_best", ".4f"),
    ("dF", "force_best", "+.0e"),
    ("pen", "pen", ".1e"),
    ("gap", "gap", ".0e"),
]
SIZE: list[tables.Column] = [
    ("dofs", "dofs", "d"),
    ("it", "iterations", "d"),
]
COLUMNS: list[tables.Column] = [
    ("cells", "cells", "s"),
    ("h", "h", "g"),
    ("sliding", "sliding", "s"),
    ("method", "method", "s"),
    *SIZE,
    ("CPU s", "cpu", ".2f"),
    (": n", "ratio", ".2f"),
    ("4F", "force", ".7f"),
    *ERRORS,
]
STIFF_COLUMNS: list[tables.Column] = [
    ("stiff", "stiff", "s"),
    ("h", "h", "g"),
    ("method", "method", "s"),
    *SIZE,
    ("4F", "force", ".7f"),
    *ERRORS,
]


def measure(path: str, sliding: str, method: str, stiff: str | None = None) -> dict[str, Any]:
    """Solve in this process.

    Args:
        path: File of the mesh.
        sliding: "finite" or "small".
        method: Method of the contact.
        stiff: The stiffer body, one of ``BODIES``; none if None.
    """
    young = {} if stiff is None else {BODIES[stiff]: STIFFER}
    data = hertz_case.read_mesh(path)
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, sliding, method=method, young=young)
    scene.problem.solve()
    measured = meter.read()
    errors = hertz_case.errors(scene.problem, scene.contact, young)
    return {**hertz_case.counts(scene.problem), **measured, **errors}


def both(
    sizes: dict[str, Sequence[float]], slidings: Sequence[str], runs: int
) -> Iterator[dict[str, Any]]:
    """Measure both methods on all meshes, with the ratio of their times."""
    for cells, of_cells in sizes.items():
        for h in of_cells:
            job = {"path": str(hertz_case.mesh_file(h, cells))}
            for sliding in slidings:
                found: dict[str, list[dict[str, Any]]] = {method: [] for method in story.METHODS}
                for _ in range(runs):
                    for method, rows in found.items():
                        rows.append(_run(**job, sliding=sliding, method=method))
                least = [min(rows, key=lambda row: row.get("cpu", 0)) for rows in found.values()]
                for row in least:
                    if "cpu" in row and "cpu" in least[0]:
                        row["ratio"] = row["cpu"] / least[0]["cpu"]
                    yield {"cells": cells, "h": h, **row}


def unlike(h: float) -> Iterator[dict[str, Any]]:
    """Measure both methods with either body much stiffer."""
    path = str(hertz_case.mesh_file(h))
    for stiff in BODIES:
        for method in story.METHODS:
            yield {"h": h, **_run(path=path, sliding="finite", method=method, stiff=stiff)}


def _run(**job: Any) -> dict[str, Any]:
    row = runner.alone("bench_methods:measure", **job)
    del row["path"]
    return row


def draw(rows: Sequence[dict[str, Any]], path: Path, **words: str) -> None:
    """Picture of the errors in finite sliding over time and size, raw ones with thin lines.

    Args:
        rows: What was measured.
        path: The image file.
        words: Note and source of the picture.
    """
    groups: dict[str, list[dict[str, Any]]] = {}
    raw: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if "cells" in row and row["sliding"] == SLIDINGS[0] and "cpu" in row:
            name = f"{row['method']}, {row['cells']}"
            groups.setdefault(name, []).append(row)
            multipliers = {"p_l2_best": row["p_l2"], "p0_best": row["p0_err"]}
            raw.setdefault(f"{name}, raw", []).append({**row, **multipliers})
    pictures.lines(
        {**groups, **raw},
        path,
        ours=len(groups),
        axes=(("cpu", "p_l2_best"), ("h", "p_l2_best"), ("h", "p0_best")),
        words={
            "cpu": "process CPU seconds, one thread",
            "h": "cell size in the contact / R",
            "p_l2_best": "relative L2 error of the pressure",
            "p0_best": "relative error of the peak pressure",
        },
        title="The common Hertz problem by both methods",
        **words,
    )
    tables.note(f"see {path}")


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure, print and draw."""
    given = [float(h) for h in argv]
    warm_up()
    sizes = {cells: given or of_cells for cells, of_cells in SIZES.items()}
    rows = list(both(sizes, SLIDINGS, RUNS))
    title = "Common Hertz problem, raw multipliers and contact.pressure"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "methods.csv")
    draw(rows, runner.OUTPUT / "methods.png")
    stiff = list(unlike(given[0] if given else STIFF_SIZE))
    title = f"One body {STIFFER:g} times stiffer, finite sliding"
    tables.show(title, STIFF_COLUMNS, stiff, runner.OUTPUT / "methods_stiff.csv")
    return rows + stiff


def warm_up() -> None:
    """Let the forms be compiled, once for all runs."""
    for row in both({cells: (0.2,) for cells in SIZES}, SLIDINGS, runs=1):
        if "failed" in row:
            raise RuntimeError(f"not even a coarse mesh is solved: {row['failed']}")


if __name__ == "__main__":
    sys.exit(measured.run("methods", main, sys.argv[1:]))
