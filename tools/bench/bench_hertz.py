# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Error against time on the common Hertz problem, beside what peers measured on it.

Process CPU seconds on one thread from the read mesh to the converged solution, and the largest
memory above the read mesh; each run in a process of its own, on the same mesh. Small and finite
sliding with the solver that contactx takes by itself; up to h = 0.01 with the other one too, MUMPS
on the saddle point or the condensed one, and how far apart their answers are.

    python tools/bench/bench_hertz.py 0.02 0.01
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import hertz_case
import numpy as np
import pictures
import runner
import tables
from peers import table

import measured
import scenes

SIZES = (0.04, 0.02, 0.01, 0.005)
# MUMPS takes minutes and gigabytes below
SMALLEST_COMPARED = 0.01

# Marks the solver that contactx takes by itself
DEFAULT = " *"
OPTIONS = {"default": {}, "direct": {"pc_type": "lu"}, "condensed": {"pc_type": "condensed"}}

COLUMNS = [
    ("h", "h", "g"),
    *tables.SOLVER,
    *tables.COST,
    ("4F", "force", ".7f"),
    ("p0_err", "p0_err", ".3f"),
    ("p_l2", "p_l2", ".4f"),
    ("pen", "pen", ".1e"),
    *tables.DIFFERENCE,
]


def measure(path: str, sliding: str, solver: str, keep: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        path: File of the mesh.
        sliding: "finite" or "small".
        solver: "default", "direct" or "condensed".
        keep: File to write displacement and force to.
    """
    data = hertz_case.read_mesh(path)
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, sliding, petsc_options=OPTIONS[solver])
    scene.problem.solve()
    measured = meter.read()
    problem, contact = scene.problem, scene.contact
    np.savez(keep, u=problem.u.x.array, x=data.mesh.geometry.x, force=contact.force)
    return {**hertz_case.counts(problem), **measured, **hertz_case.errors(problem, contact)}


def compare(one: dict[str, Any], other: dict[str, Any]) -> None:
    """Add to both rows how far apart their answers on the same mesh are, and the ratio of times."""
    first, second = (np.load(row["keep"]) for row in (one, other))
    if not np.array_equal(first["x"], second["x"]):
        raise RuntimeError("the nodes of the same mesh came in another order")
    direct = one if one["took"] == "direct" else other
    for row in (one, other):
        row["ratio"] = row["cpu"] / direct["cpu"]
        for name, key in (("u", "u_difference"), ("force", "force_difference")):
            size = np.linalg.norm(first[name])
            row[key] = float(np.linalg.norm(first[name] - second[name]) / size)


def run(
    sizes: Sequence[float], *, slidings: Sequence[str] = ("small", "finite"), compared: bool = True
) -> list[dict[str, Any]]:
    """Measure all sizes.

    Args:
        sizes: Cell sizes.
        slidings: Kinematics.
        compared: Whether the other solver runs too where that does not take too long.
    """
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for h in sizes:
            path = str(hertz_case.mesh_file(h))
            for sliding in slidings:
                row = _run_one(h, path, sliding, "default", folder)
                rows.append(row)
                if not compared or h < SMALLEST_COMPARED or "failed" in row:
                    continue
                other = "condensed" if row["took"] == "direct" else "direct"
                rows.append(_run_one(h, path, sliding, other, folder))
                if "failed" not in rows[-1]:
                    compare(row, rows[-1])
    for row in rows:
        for name in ("path", "keep"):
            del row[name]
    return rows


def _run_one(h: float, path: str, sliding: str, solver: str, folder: str) -> dict[str, Any]:
    keep = f"{folder}/{h:g}_{sliding}_{solver}.npz"
    job = {"path": path, "sliding": sliding, "solver": solver, "keep": keep}
    row = runner.alone("bench_hertz:measure", **job)
    if solver == "default" and "took" in row:
        row["solver"] = row["took"] + DEFAULT
    return {"h": h, **row}


def draw(rows: Sequence[dict[str, Any]], path: Path) -> None:
    """Picture of ours and the peers' time over error and size."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for row in sorted((r for r in rows if "took" in r), key=lambda r: r["took"]):
        name = f"contactx, {row['sliding']} sliding, {row['took']}"
        groups.setdefault(name, []).append(row)
    ours = len(groups)
    groups |= table.others()
    pictures.lines(
        groups,
        path,
        ours=ours,
        axes=(("cpu", "p_l2"), ("dofs", "cpu")),
        words={
            "cpu": "process CPU seconds, one thread",
            "p_l2": "relative L2 error of the pressure",
            "dofs": "displacements",
        },
        title="The common Hertz problem",
    )
    tables.note(f"see {path}")


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure, print and draw."""
    warm_up()
    rows = run([float(h) for h in argv] or SIZES)
    tables.show(
        f"Common Hertz problem;{DEFAULT} by default", COLUMNS, rows, runner.OUTPUT / "hertz.csv"
    )
    draw(rows, runner.OUTPUT / "hertz.png")
    return rows


def warm_up() -> None:
    """Let the forms be compiled, once for all runs."""
    path = str(hertz_case.mesh_file(0.2))
    with tempfile.TemporaryDirectory() as name:
        result = _run_one(0.2, path, "small", "default", name)
    if "failed" in result:
        raise RuntimeError(f"not even a coarse mesh is solved: {result['failed']}")


if __name__ == "__main__":
    sys.exit(measured.run("hertz", main, sys.argv[1:]))
