# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Several ranks: how much faster two of them are, and what a rank sends on up to 64.

Strong scaling: the common Hertz problem, wall seconds from the read mesh to the converged solution
on one and two ranks, beside those of one linear solve of its mesh. Weak scaling: a slab dragged
along a base, both as long as there are ranks; what the rank that sends most sends in a search, and
in an iteration besides, with the halo that it has. Boxes around the surfaces of ranks that have
facets are gathered by all, so that they pass through every rank; all else goes to neighbours. The
counts need no cores of their own, so that ranks may share them; times are those of the ranks that
have one. In the partition "shifted" all ranks have as much to do and the base below a rank's part
of the slab belongs to two; "default" is that of DOLFINx.

    python tools/bench/bench_scaling.py 0.02 0.01
"""

from __future__ import annotations

import os
import statistics
import sys
from collections.abc import Iterable, Sequence
from itertools import product
from typing import Any

import bench_limit
import hertz_case
import runner
import tables

SIZES = (0.01, 0.005)
RANKS = (1, 2, 4, 8, 16, 32, 64)
RUNS = 5
METHODS = ("node-to-surface", "surface-to-surface")

STRONG = [
    ("h", "h", "g"),
    ("scene", "scene", "s"),
    ("friction", "friction", "g"),
    ("shared\nout", "shared", ""),
    ("dofs", "dofs", ",d"),
    ("it", "iterations", "d"),
    ("of two", "iterations of two", "d"),
    ("Krylov", "krylov", "d"),
    ("of two", "krylov of two", "d"),
    ("wall s", "wall", ".2f"),
    ("of two", "wall of two", ".2f"),
    ("one: two", "ratio", ".2f"),
    ("over that\nof the solve", "efficiency", ".2f"),
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
    sizes: Iterable[float],
    methods: Sequence[str] = METHODS,
    frictions: Sequence[float] = bench_limit.FRICTION,
    partitions: Sequence[bool] = (False, True),
) -> list[dict[str, Any]]:
    """Measure the common Hertz problem on one and two ranks in turn, and a linear solve.

    Each by DOLFINx's partition and by one that gives both ranks a part of the contact. Wall seconds
    are medians. "efficiency" is how often two ranks are as fast as one, over how often
    they are in the linear solve with PETSc's defaults. On one rank these take long for products of
    three matrices; as contactx has the faster way, a solve with that stands beside it.
    """
    rows = []
    for h in sizes:
        path = str(hertz_case.mesh_file(h))
        jobs: list[tuple[str, dict[str, Any]]] = [("linear", {}), ("linear", {"in_turn": True})]
        jobs += [
            ("contact", {"method": m, "friction": f, "shared": s})
            for m, f, s in product(methods, frictions, partitions)
        ]
        runs = [
            [
                [runner.on_ranks(f"bench_limit:{name}", n, path=path, **job) for n in (1, 2)]
                for name, job in jobs
            ]
            for _ in range(RUNS)
        ]
        of_solve = 0.0
        for k, (_, job) in enumerate(jobs):
            solve = bench_limit.LIMIT + (", products in turn" if "in_turn" in job else "")
            row = {"h": h, "scene": job.get("method", solve), **job}
            found = [one for run in runs for one in run[k]]
            failed = [one["failed"] for one in found if "failed" in one]
            if failed:
                rows.append({**row, "failed": failed[0]})
                continue
            one, two = found[-2:]
            walls = [statistics.median(each["wall"] for each in found[n::2]) for n in (0, 1)]
            for name in ("dofs", "iterations", "krylov"):
                row |= {name: one[name]} if name in one else {}
            for name in ("iterations", "krylov"):
                row |= {f"{name} of two": two[name]} if name in two else {}
            row |= {"wall": walls[0], "wall of two": walls[1], "ratio": walls[0] / walls[1]}
            of_solve = of_solve or row["ratio"]
            rows.append({**row, "efficiency": row["ratio"] / of_solve})
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
    title = "Strong scaling, common Hertz problem"
    rows = strong([float(h) for h in argv] or SIZES)
    tables.show(title, STRONG, rows, runner.OUTPUT / "scaling_strong.csv")
    more = weak(RANKS)
    title = "Weak scaling, a slab dragged along a base: the rank that sends most"
    tables.show(title, WEAK, more, runner.OUTPUT / "scaling_weak.csv")
    return rows + more


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
