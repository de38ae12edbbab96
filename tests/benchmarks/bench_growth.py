# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Growth of time and memory with the common Hertz problem, 10,000 to 1,000,000 displacements.

Default settings. The exponents are those of least squares in logarithms, of all sizes and of those
from 30,000 on, where what does not grow no longer counts.

    python tests/benchmarks/bench_growth.py 0.0165 0.0098 0.0065
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import bench_hertz
import pictures
import runner
import tables

SIZES = (0.0165, 0.0098, 0.0065, 0.0046, 0.0034, 0.0026)
SLIDING = "small"
FROM = 30_000

COLUMNS = [
    ("h", "h", "g"),
    ("dofs", "dofs", ",d"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("hier.", "hierarchies", "d"),
    ("CPU s", "cpu", ".2f"),
    ("us a dof", "each", ".0f"),
    ("MB", "memory", ".0f"),
    ("kB a dof", "each_memory", ".2f"),
    ("4F", "force", ".7f"),
    ("p_l2", "p_l2", ".4f"),
]


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure, print, fit and draw."""
    bench_hertz.warm_up()
    rows = bench_hertz.run([float(h) for h in argv] or SIZES, slidings=(SLIDING,), compared=False)
    whole = [row for row in rows if "failed" not in row]
    for row in whole:
        row["each"] = 1e6 * row["cpu"] / row["dofs"]
        row["each_memory"] = 1024 * row["memory"] / row["dofs"]
    title = f"Growth, common Hertz problem, {SLIDING} sliding"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "growth.csv")
    for name, least in (("all", 0), (f"{FROM:,} on", FROM)):
        # A mesh is as good as of that size
        some = [row for row in whole if row["dofs"] > 0.95 * least]
        powers = {
            word: tables.exponent([r["dofs"] for r in some], [r[key] for r in some])
            for word, key in (("time", "cpu"), ("memory", "memory"))
        }
        found = ", ".join(f"{word} as dofs^{power:.2f}" for word, power in powers.items())
        tables.note(f"exponents, {name} ({len(some)} sizes): {found}")
    path = runner.OUTPUT / "growth.png"
    pictures.lines(
        {f"contactx, {SLIDING} sliding": whole},
        path,
        ours=1,
        axes=(("dofs", "cpu"), ("dofs", "memory")),
        words={
            "dofs": "displacements",
            "cpu": "process CPU seconds, one thread",
            "memory": "memory above the read mesh, MB",
        },
        title=title,
    )
    tables.note(f"see {path}")
    return rows


if __name__ == "__main__":
    main(sys.argv[1:])
