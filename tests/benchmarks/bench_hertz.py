# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Error against time on the common Hertz problem, beside what peers measured on it.

Process CPU seconds on one thread from the read mesh to the converged solution, and the largest
memory above the read mesh; each run in a process of its own, on the same mesh. Small and finite
sliding with the solver that contactx takes by itself; MUMPS on the saddle point up to h = 0.01, and
how far its answer is.

    python tests/benchmarks/bench_hertz.py 0.02 0.01
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import runner
import tables

import numpy as np

SIZES = (0.04, 0.02, 0.01, 0.005)
# MUMPS takes minutes and gigabytes below
SMALLEST_DIRECT = 0.01
PEERS = Path(__file__).with_name("peers.csv")

COLUMNS = [
    ("h", "h", "g"),
    ("sliding", "sliding", "s"),
    ("solver", "solver", "s"),
    ("dofs", "dofs", "d"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("hier.", "hierarchies", "d"),
    ("CPU s", "cpu", ".2f"),
    (": MUMPS", "ratio", ".2f"),
    ("MB", "memory", ".0f"),
    ("4F", "force", ".7f"),
    ("p0_err", "p0_err", ".3f"),
    ("p_l2", "p_l2", ".4f"),
    ("pen", "pen", ".1e"),
    ("u - MUMPS", "u_difference", ".1e"),
    ("F - MUMPS", "force_difference", ".1e"),
]


def measure(path: str, sliding: str, solver: str, keep: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        path: File of the mesh.
        sliding: "finite" or "small".
        solver: "default" or "MUMPS".
        keep: File to write displacement and force to.
    """
    import hertz_case
    import scenes

    data = hertz_case.read_mesh(path)
    options = {"petsc_options": {"pc_type": "lu"}} if solver == "MUMPS" else {}
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, sliding, **options)
    scene.problem.solve()
    measured = meter.read()
    problem, contact = scene.problem, scene.contact
    np.savez(keep, u=problem.u.x.array, x=data.mesh.geometry.x, force=contact.force)
    return {**hertz_case.counts(problem), **measured, **hertz_case.errors(problem, contact)}


def compare(row: dict[str, Any], direct: dict[str, Any], folder: Path) -> None:
    """Add to a row how far its answer is from another one on the same mesh."""
    ours, theirs = (np.load(_answer(r, folder)) for r in (row, direct))
    if not np.array_equal(ours["x"], theirs["x"]):
        raise RuntimeError("the nodes of the same mesh came in another order")
    row["ratio"] = row["cpu"] / direct["cpu"]
    for name, key in (("u", "u_difference"), ("force", "force_difference")):
        size = np.linalg.norm(theirs[name])
        row[key] = float(np.linalg.norm(ours[name] - theirs[name]) / size)


def run(sizes: Sequence[float]) -> list[dict[str, Any]]:
    """Measure all sizes."""
    import hertz_case

    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for h in sizes:
            path = str(hertz_case.mesh_file(h))
            for sliding in ("small", "finite"):
                solvers = ("MUMPS", "default") if h >= SMALLEST_DIRECT else ("default",)
                found = []
                for solver in solvers:
                    job = {"path": path, "sliding": sliding, "solver": solver}
                    keep = str(_answer({"h": h, **job}, folder))
                    row = runner.alone("bench_hertz:measure", **job, keep=keep)
                    found.append({"h": h, **row})
                if len(found) == 2 and not any("failed" in row for row in found):
                    compare(found[1], found[0], folder)
                rows += found
    for row in rows:
        row.pop("path"), row.pop("keep")
    return rows


def draw(rows: Sequence[dict[str, Any]], path: Path) -> None:
    """Picture of ours and the peers' time over error and size."""
    import pictures

    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if "failed" not in row:
            groups.setdefault(f"contactx, {row['sliding']} sliding, {row['solver']}", []).append(row)
    ours = len(groups)
    for row in tables.read(PEERS):
        groups.setdefault(f"{row['peer']}, {row['setting']}", []).append(row)
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
    tables.show("Common Hertz problem", COLUMNS, rows, runner.OUTPUT / "hertz.csv")
    draw(rows, runner.OUTPUT / "hertz.png")
    return rows


def warm_up() -> None:
    """Let the forms be compiled, once for all runs."""
    import hertz_case

    path = str(hertz_case.mesh_file(0.2))
    with tempfile.TemporaryDirectory() as name:
        keep = str(Path(name) / "answer.npz")
        job = {"path": path, "sliding": "small", "solver": "default", "keep": keep}
        result = runner.alone("bench_hertz:measure", **job)
    if "failed" in result:
        raise RuntimeError(f"not even a coarse mesh is solved: {result['failed']}")


def _answer(row: dict[str, Any], folder: Path) -> Path:
    return folder / f"{row['h']:g}_{row['sliding']}_{row['solver']}.npz"


if __name__ == "__main__":
    main(sys.argv[1:])
