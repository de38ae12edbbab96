# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where the time of the common Hertz problem goes, and the share of everything that is contact.

python tests/benchmarks/bench_parts.py 0.02 0.01
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import bench_hertz
import hertz_case
import parts
import runner
import tables

import scenes

SIZES = (0.02, 0.01, 0.005)


def measure(path: str, sliding: str) -> dict[str, Any]:
    """Solve in this process, watched."""
    data = hertz_case.read_mesh(path)
    clock = parts.Clock()
    meter = runner.Meter()
    with clock.watching():
        scene = scenes.HertzSphere(data, sliding)
        scene.problem.solve()
    measured = meter.read()
    seconds = clock.seconds
    contact = sum(seconds[part] for part in parts.OF_CONTACT)
    dearest = clock.dearest(parts.OF_CONTACT, 6)
    return {
        **hertz_case.counts(scene.problem),
        **measured,
        "share": 100 * contact / sum(seconds.values()),
        **seconds,
        "dearest": ", ".join(f"{name} {s:.2f}" for name, s in dearest.items()),
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    bench_hertz.warm_up()
    rows = []
    for h in [float(h) for h in argv] or SIZES:
        path = str(hertz_case.mesh_file(h))
        for sliding in ("small", "finite"):
            row = runner.alone("bench_parts:measure", path=path, sliding=sliding)
            del row["path"]
            rows.append({"h": h, **row})
    columns = [
        ("h", "h", "g"),
        ("sliding", "sliding", "s"),
        ("dofs", "dofs", "d"),
        ("CPU s", "cpu", ".2f"),
        *((name.replace(" ", "\n", 1), name, ".2f") for name in parts.PARTS),
        ("contact\n%", "share", ".1f"),
    ]
    title = "Where the time goes, CPU seconds; contact is " + ", ".join(parts.OF_CONTACT)
    tables.show(title, columns, rows, runner.OUTPUT / "parts.csv")
    for row in rows:
        if "dearest" in row:
            tables.note(f"h = {row['h']:g}, {row['sliding']}, dearest of contact: {row['dearest']}")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
