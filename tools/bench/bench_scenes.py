# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Condensed against direct where there is friction, and bodies that contact alone holds.

python tools/bench/bench_scenes.py 0.02
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from typing import Any

import bench_hertz
import hertz_case
import numpy as np
import runner
import skips
import stacked_blocks
import tables

import scenes

SIZES = (0.01,)
FRICTION = 0.3
SCENES = {
    "Hertz, friction": ("small",),
    "two blocks": ("small", "finite"),
    "two blocks, friction": ("small", "finite"),
    "five free blocks, friction": ("small",),
}

COLUMNS = [
    ("scene", "scene", "s"),
    *tables.SOLVER,
    ("not condensed", "uncondensed", "d"),
    *tables.COST,
    *tables.DIFFERENCE,
]


def measure(
    scene: str, path: str, h: float, sliding: str, solver: str, keep: str
) -> dict[str, Any]:
    """Solve in this process.

    Args:
        scene: One of ``SCENES``.
        path: File of the Hertz problem's mesh.
        h: Its cell size; the other scenes have about as many displacements.
        sliding: "finite" or "small".
        solver: "default", "direct" or "condensed".
        keep: File to write displacement and forces to.
    """
    options: dict[str, Any] = {"petsc_options": bench_hertz.OPTIONS[solver]}
    law = {"friction": FRICTION} if "friction" in scene else {}
    data = hertz_case.read_mesh(path) if "Hertz" in scene else None
    meter = runner.Meter()
    if data is not None:
        problem = scenes.HertzSphere(data, sliding, **law, **options).problem
    elif "free" in scene:
        problem, _, load = stacked_blocks.create(h / 0.24, sliding, 3, **options)
        load.value[:] = (stacked_blocks.SHEAR, 0.0, -stacked_blocks.PRESSURE)
    else:
        problem = skips.blocks(None, max(2, round(0.14 / h)), sliding, **law, **options)
    problem.solve()
    measured = meter.read()
    x = problem.u.function_space.mesh.geometry.x
    np.savez(keep, u=problem.u.x.array, x=x, force=np.array(problem.report.force))
    reasons = "; ".join(sorted(set(problem.report.uncondensed)))
    return {**hertz_case.counts(problem), **measured, "reasons": reasons}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    bench_hertz.warm_up()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for h in [float(h) for h in argv] or SIZES:
            path = str(hertz_case.mesh_file(h))
            for scene, slidings in SCENES.items():
                for sliding in slidings:
                    pair = [
                        runner.alone(
                            "bench_scenes:measure",
                            **{"scene": scene, "path": path, "h": h, "sliding": sliding},
                            **{"solver": solver, "keep": f"{folder}/{solver}.npz"},
                        )
                        for solver in ("direct", "condensed")
                    ]
                    if not any("failed" in row for row in pair):
                        bench_hertz.compare(*pair)
                    rows += pair
    for row in rows:
        del row["path"], row["keep"]
    tables.show("Condensed against direct", COLUMNS, rows, runner.OUTPUT / "scenes.csv")
    for row in rows:
        if row.get("reasons"):
            tables.note(f"{row['scene']}, {row['sliding']}: not condensed: {row['reasons']}")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
