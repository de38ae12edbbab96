# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The face of a dam, by its number of slabs: time, memory, iterations, and how they grow.

Weight, then water in stages, on one rank or several; process CPU seconds of rank 0, set-up and
solves, and its memory. The dam's height grows with its length, up to 178 m.

    python tools/bench/bench_dam_face.py               # 5 and 10 slabs, coarse, all stages
    python tools/bench/bench_dam_face.py 5 10 20 40 --fine --stages 2 --ranks 1 2
    python tools/bench/bench_dam_face.py 20 --fine --growth 2.2 --ranks 2   # 521,217 unknowns
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from typing import Any

import runner
import tables

import dam_face
from dam_results import laws
from dam_scene import Dam, DamSetting, run
from meshes import DamFace

COARSE: dict[str, Any] = {"layers": 3, "rows": 40, "rockfill_rows": 28, "rockfill_cells": 5}
FINE: dict[str, Any] = {"layers": 3, "rows": 104, "rockfill_rows": 70, "rockfill_cells": 5}
COLUMNS = [
    ("slabs", "slabs", "d"),
    ("ranks", "ranks", "d"),
    ("dofs", "dofs", "d"),
    ("slaves", "slaves", "d"),
    ("iterations", "iterations", "s"),
    ("Krylov a solve", "krylov", ".1f"),
    ("fact.", "factorisations", "d"),
    ("CPU s", "cpu", ".0f"),
    ("wall s", "wall", ".0f"),
    ("MB", "memory", ".0f"),
    ("balance", "balance", ".0e"),
    ("Coulomb", "coulomb", ".0e"),
]
# What grows with the displacements, by which power
EXPONENTS = ("cpu", "memory", "krylov")


def measure(slabs: int, cells: dict[str, Any], stages: int, of: int) -> dict[str, Any]:
    """Load a dam in this process.

    Args:
        slabs: Number of slabs.
        cells: Numbers of cells.
        stages: Stages of the water that are run.
        of: Stages of the full reservoir.
    """
    meter, begin = runner.Meter(), time.perf_counter()
    dam = Dam(DamSetting(dam_face.model_of(slabs, **cells)))
    reports = []

    class EndError(Exception):
        """The stages that are asked for are done."""

    def each(dam: Dam, step: Any) -> None:
        reports.append(dam.problem.report)
        if step.t >= 1 + stages:
            raise EndError

    try:
        run(dam, of, creep=False, each=each, progress=False)
    except EndError:
        pass
    solves = sum(report.iterations for report in reports)
    found = laws(dam)
    comm = dam.mesh.comm
    V = dam.u.function_space.dofmap
    return {
        "dofs": V.index_map.size_global * V.index_map_bs,
        "slaves": comm.allreduce(sum(len(c.slave_nodes) for c in dam.problem.contacts)),
        "iterations": " ".join(str(report.iterations) for report in reports),
        "krylov": sum(report.krylov for report in reports) / solves,
        "factorisations": sum(report.factorisations for report in reports),
        **meter.read(),
        "wall": time.perf_counter() - begin,
        "balance": found.balance,
        "coulomb": found.coulomb,
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("slabs", type=int, nargs="*", default=[5, 10])
    parser.add_argument("--fine", action="store_true", help="cells of half a million displacements")
    parser.add_argument(
        "--growth", type=float, default=DamFace.growth, help="of slabs' cells off a joint"
    )
    parser.add_argument("--stages", type=int, default=10, help="stages of the water that are run")
    parser.add_argument("--of", type=int, default=10, help="stages of the full reservoir")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1])
    args = parser.parse_args(argv)
    cells = {**(FINE if args.fine else COARSE), "growth": args.growth}
    rows = []
    for slabs in args.slabs:
        for ranks in args.ranks:
            job = {"slabs": slabs, "cells": cells, "stages": args.stages, "of": args.of}
            row = runner.on_ranks("bench_dam_face:measure", ranks, limit=36_000.0, **job)
            rows.append({"slabs": slabs, **row})
    tables.show("Face of a dam", COLUMNS, rows, runner.OUTPUT / "dam_face.csv")
    good = [row for row in rows if row["ranks"] == 1 and "failed" not in row]
    if len(good) > 1:
        for key in EXPONENTS:
            power, _ = tables.power_law([r["dofs"] for r in good], [r[key] for r in good])
            tables.note(f"{key} grows with the displacements to the power {power:.2f}")
    return rows


if __name__ == "__main__":
    main(sys.argv[1:])
