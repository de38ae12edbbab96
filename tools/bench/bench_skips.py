# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What skipping what a scene does not need saves: each rule on and off, on the Hertz problem.

python tools/bench/bench_skips.py 0.02
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import bench_hertz
import hertz_case
import runner
import skips
import tables

SIZES = (0.01,)
_COUNTED = {
    "iterations": "it",
    "krylov": "krylov",
    "hierarchies": "hierarchies",
    "assemblies": "assemblies",
    "pairs": "pairs",
}
TITLE = "What each rule saves (with it : without it)"

COLUMNS = [
    ("h", "h", "g"),
    ("rule", "rule", "s"),
    ("without it", "instead", "s"),
    ("dofs", "dofs", "d"),
    ("it", "it", "s"),
    ("Krylov", "krylov", "s"),
    ("hier.", "hierarchies", "s"),
    ("pairs", "pairs", "s"),
    ("CPU s", "cpu", ".2f"),
    ("without", "cpu_off", ".2f"),
    ("ratio", "ratio", ".2f"),
    ("part", "part", "s"),
    ("s", "part_cpu", ".3f"),
    ("without", "part_cpu_off", ".3f"),
    ("ratio", "part_ratio", ".2f"),
]


def measure(path: str, h: float, rule: str, off: bool) -> dict[str, Any]:
    """Solve in this process."""
    skip = skips.SKIPS[rule]
    data = hertz_case.read_mesh(path)
    with (skip.replaced if off else skips.nullcontext)():
        meter = runner.Meter()
        problem = skip.problem(data, max(2, round(0.14 / h)), off=off)
        problem.solve()
        cpu = meter.read()["cpu"]
    part = {"part_cpu": problem.report.times[skip.part]} if skip.part else {}
    return {
        **hertz_case.counts(problem),
        "cpu": cpu,
        "pairs": problem.report.pairs,
        "assemblies": problem.assembler.bulk.assemblies,
        "instead": skip.instead,
        "part": skip.part,
        **part,
    }


def both(h: float, path: str, rule: str) -> dict[str, Any]:
    """A row with the rule and without it."""
    job = {"path": path, "h": h, "rule": rule}
    on, off = (runner.alone("bench_skips:measure", **job, off=o) for o in (False, True))
    if "failed" in on or "failed" in off:
        why = on.get("failed") or f"without it: {off['failed']}"
        return {"h": h, "rule": rule, "failed": why}
    row = {key: on[key] for key in ("h", "rule", "instead", "part", "dofs", "cpu")}
    for key, name in _COUNTED.items():
        row[name] = f"{on[key]} : {off[key]}"
    row |= {"cpu_off": off["cpu"], "ratio": off["cpu"] / on["cpu"]}
    if "part_cpu" in on:
        first, second = on["part_cpu"], off["part_cpu"]
        row |= {"part_cpu": first, "part_cpu_off": second, "part_ratio": second / first}
    return row


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    bench_hertz.warm_up()
    rows = [
        both(h, str(hertz_case.mesh_file(h)), rule)
        for h in [float(h) for h in argv] or SIZES
        for rule in skips.SKIPS
    ]
    tables.show(TITLE, COLUMNS, rows, runner.OUTPUT / "skips.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
