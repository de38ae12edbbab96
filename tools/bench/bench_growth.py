# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Growth of time and memory with the common Hertz problem, 10,000 to 1,000,000 displacements.

Default settings. The exponents are those of least squares in logarithms, of all sizes and of those
from 30,000 on, where what does not grow no longer counts.

    python tools/bench/bench_growth.py 0.0165 0.0098 0.0065
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import bench_hertz
import pictures
import runner
import tables

import measured

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


FITS = [
    ("sizes", "sizes", "s"),
    ("number", "number", "d"),
    ("time", "time", ".2f"),
    ("memory", "memory", ".2f"),
]


def fit(rows: Sequence[dict[str, Any]]) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Fit powers to time and memory.

    Args:
        rows: Measurements.

    Returns:
        Exponents of all sizes and of the large ones, and the curve of the latter.
    """
    fits, curve = [], []
    for name, least in (("all", 0), (f"{FROM:,} on", FROM)):
        # A mesh is as good as of that size
        some = [row for row in rows if row["dofs"] > 0.95 * least]
        dofs = [row["dofs"] for row in some]
        time, memory = (
            tables.power_law(dofs, [row[key] for row in some]) for key in ("cpu", "memory")
        )
        fits.append({"sizes": name, "number": len(some), "time": time[0], "memory": memory[0]})
        curve = [
            {"dofs": n, "cpu": time[1] * n ** time[0], "memory": memory[1] * n ** memory[0]}
            for n in dofs
        ]
    return fits, curve


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
    fits, curve = fit(whole)
    tables.show("Exponents of dofs", FITS, fits, runner.OUTPUT / "growth_fit.csv")
    path = runner.OUTPUT / "growth.png"
    pictures.lines(
        {
            f"contactx, {SLIDING} sliding": whole,
            f"least squares from {FROM:,} on: time as dofs^{fits[-1]['time']:.2f}, "
            f"memory as dofs^{fits[-1]['memory']:.2f}": curve,
        },
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
    sys.exit(measured.run("growth", main, sys.argv[1:]))
