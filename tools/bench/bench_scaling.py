# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Several ranks: how much faster two of them are, and what a rank sends on up to 64.

Strong scaling: the common Hertz problem, wall seconds from the read mesh to the converged solution
on one and two ranks. Weak scaling: a slab dragged along a base, both as long as there are ranks;
what the rank that sends most sends in a search, and in an iteration besides, with the halo that it
has. Boxes around the ranks' surfaces are gathered by all, so that they pass through every rank; all
else goes to neighbours. The counts need no cores of their own, so that ranks may share them; times
are those of the ranks that have one. In the partition "shifted" all ranks have as much to do and
the base below a rank's part of the slab belongs to two; "default" is that of DOLFINx.

    python tools/bench/bench_scaling.py 0.02 0.01
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from typing import Any

import hertz_case
import runner
import tables

SIZES = (0.01, 0.005, 0.0035)
RANKS = (1, 2, 4, 8, 16, 32, 64)
RUNS = 3
METHODS = ("node-to-surface", "surface-to-surface")

STRONG = [
    ("h", "h", "g"),
    ("sliding", "sliding", "s"),
    ("ranks", "ranks", "d"),
    ("dofs", "dofs", ",d"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("wall s", "wall", ".2f"),
    ("one: n", "ratio", ".2f"),
    ("set-up s", "setup", ".2f"),
    ("settle s", "settle s", ".2f"),
    ("residual s", "residual s", ".2f"),
    ("Jacobian s", "Jacobian s", ".2f"),
    ("linear s", "linear solve s", ".2f"),
    ("4F", "force", ".9f"),
]
WEAK = [
    ("dim", "dim", "d"),
    ("method", "method", "s"),
    ("partition", "partition", "s"),
    ("ranks", "ranks", "d"),
    ("dofs", "dofs", ",d"),
    ("it", "iterations", "d"),
    ("messages\na search", "messages a search", ".1f"),
    ("bytes\na search", "bytes a search", ",.0f"),
    ("of\nboxes", "of boxes", ",.0f"),
    ("messages\nan iteration", "messages an iteration", ".1f"),
    ("bytes\nan iteration", "bytes an iteration", ",.0f"),
    ("collectives\nan iteration", "collectives an iteration", ".1f"),
    ("Krylov", "krylov", "d"),
    ("PETSc's\nmessages", "PETSc's messages an iteration", ".0f"),
    ("PETSc's\nkB", "PETSc's kB", ".1f"),
    ("halo\nnodes", "halo", "d"),
    ("wall s", "wall", ".2f"),
    ("F a rank", "force", ".9f"),
]


def strong(
    sizes: Iterable[float], slidings: Sequence[str] = ("small", "finite")
) -> list[dict[str, Any]]:
    """Measure the common Hertz problem on one and two ranks; the best of some runs counts."""
    rows = []
    for h in sizes:
        path = str(hertz_case.mesh_file(h))
        for sliding in slidings:
            alone = 0.0
            for ranks in (1, 2):
                job = {"path": path, "sliding": sliding}
                runs = [runner.on_ranks("scaling_case:strong", ranks, **job) for _ in range(RUNS)]
                whole = [run for run in runs if "failed" not in run]
                row = min(whole, key=lambda run: run["wall"]) if whole else runs[0]
                del row["path"]
                if "failed" not in row:
                    alone = row["wall"] if ranks == 1 else alone
                    row["ratio"] = alone / row["wall"]
                rows.append({"h": h, **row})
    return rows


def weak(
    ranks: Iterable[int],
    *,
    dims: Sequence[int] = (2, 3),
    methods: Sequence[str] = METHODS,
    partitions: Sequence[str] = ("shifted", "default"),
) -> list[dict[str, Any]]:
    """Drag the long slab on numbers of ranks."""
    cores = len(os.sched_getaffinity(0))
    rows = []
    for dim in dims:
        for method in methods:
            for partition in partitions:
                for n in ranks:
                    job = {"dim": dim, "method": method, "partition": partition}
                    row = runner.on_ranks("scaling_case:weak", n, **job)
                    if "failed" not in row:
                        row["PETSc's kB"] = row["PETSc's bytes an iteration"] / 1024
                    if n > cores:
                        row.pop("wall", None)
                    rows.append(row)
    return rows


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    # Forms are compiled before anything is on the clock
    rows = strong([0.2])
    title = "Strong scaling, common Hertz problem, default solver"
    rows = strong([float(h) for h in argv] or SIZES)
    tables.show(title, STRONG, rows, runner.OUTPUT / "scaling_strong.csv")
    more = weak(RANKS)
    title = "Weak scaling, a slab dragged along a base: the rank that sends most"
    tables.show(title, WEAK, more, runner.OUTPUT / "scaling_weak.csv")
    return rows + more


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
