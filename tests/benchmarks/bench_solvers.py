# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The condensed solver beside the direct one on the common Hertz problem.

Process CPU seconds on one thread from the read mesh to the converged solution, and the largest
memory above the read mesh; each run in a process of its own.

    python tests/benchmarks/bench_solvers.py 0.02 0.01
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOLVERS = ("lu", "condensed")


def measure(h: float, sliding: str, solver: str) -> dict[str, float]:
    """Solve once, in this process."""
    sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "demos")]
    import scenes

    from contactx import meshes

    marks = {}
    mesh_sphere = meshes.hertz_sphere

    def read(size: float) -> object:
        data = mesh_sphere(size)
        marks["cpu"], marks["memory"] = time.process_time(), _memory()
        return data

    meshes.hertz_sphere = read
    problem, contact = scenes.hertz_sphere(h, sliding, petsc_options={"pc_type": solver})
    problem.solve()
    report = problem.report
    return {
        "dofs": len(problem.u.x.array),
        "iterations": report.iterations,
        "krylov": report.krylov,
        "hierarchies": report.hierarchies,
        "cpu": time.process_time() - marks["cpu"],
        "memory": _memory() - marks["memory"],
        "force": float(4 * contact.force[2]),
    }


def _memory() -> float:
    """Largest memory so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main(sizes: list[float]) -> None:
    """Run every solver in a process of its own and print a table."""
    from rich.console import Console
    from rich.table import Table

    names = ("h", "dofs", "sliding", "solver", "it", "Krylov", "hier.", "CPU s", "MB", "4F")
    table = Table(*names, "CPU : direct")
    for h in sizes:
        for sliding in ("small", "finite"):
            direct = 0.0
            for solver in SOLVERS:
                run = subprocess.run(
                    [sys.executable, __file__, "--one", str(h), sliding, solver],
                    env={**os.environ, "OMP_NUM_THREADS": "1"},
                    capture_output=True,
                    text=True,
                    check=True,
                )
                r = json.loads(run.stdout.splitlines()[-1])
                direct = direct or r["cpu"]
                table.add_row(
                    *(str(h), str(r["dofs"]), sliding, solver, str(r["iterations"])),
                    *(str(r["krylov"]), str(r["hierarchies"]), f"{r['cpu']:.2f}"),
                    *(f"{r['memory']:.0f}", f"{r['force']:.9f}", f"{r['cpu'] / direct:.2f}"),
                )
    Console(width=110).print(table)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        print(json.dumps(measure(float(sys.argv[2]), sys.argv[3], sys.argv[4])))
    else:
        main([float(h) for h in sys.argv[1:]] or [0.04, 0.02, 0.01])
