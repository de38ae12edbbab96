# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From how many displacements on the condensed solver is faster than the direct one.

Blocks pressed on each other and pushed aside in four steps, finite sliding, without friction and
with it: process CPU seconds by MUMPS over those of the condensed solver, on one thread, the least
of some runs. ``contactx.options`` has the rule that follows from it.

    python tools/bench/bench_solvers.py 2
    python tools/bench/bench_solvers.py 3
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables

import contactx as cx
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag

# Cells along a side of the upper block
SIZES = {2: (10, 20, 30, 40, 60, 100), 3: (4, 5, 6, 7, 9, 12)}
FRICTION, STEPS, RUNS = (0.0, 0.3), 4, 2
COLUMNS: list[tables.Column] = [
    ("dim", "dim", "d"),
    ("dofs", "dofs", "d"),
    ("friction", "friction", "g"),
    ("it", "iterations", "d"),
    ("MUMPS, s", "direct", ".3f"),
    ("condensed, s", "condensed", ".3f"),
    ("ratio", "ratio", ".2f"),
]


def measure(dim: int, n: int, friction: float, pc: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        dim: Dimension of space.
        n: Cells along a side of the upper block.
        friction: Coefficient.
        pc: "lu" or "condensed".
    """
    cell = CellType.quadrilateral if dim == 2 else CellType.hexahedron
    wide = (1.4,) * (dim - 1) + (1.0,)
    data = meshes.blocks(cell, (n,) * dim, (round(1.2 * n),) * dim, size_lower=wide)
    tags, u = data.facet_tags, story.displacement(data.mesh)
    bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
    top = [story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(dim)]
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT),
        cx.Surface(tags, Tag.LOWER_CONTACT),
        friction=friction,
    )
    meter = runner.Meter()
    problem = cx.ContactProblem(
        story.elasticity(u, 1.0, 0.3), u, contacts=[contact], bcs=bcs + top,
        petsc_options_prefix="solvers_", petsc_options={"pc_type": pc},
    )  # fmt: skip
    iterations = 0
    for step in range(1, STEPS + 1):
        top[-1].g.value[...] = -0.02
        top[0].g.value[...] = 0.04 * step / STEPS
        problem.solve()
        iterations += problem.report.iterations
    return {"dofs": len(u.x.array), "iterations": iterations, **meter.read()}


def main(argv: Sequence[str], sizes: Sequence[int] = ()) -> list[dict[str, Any]]:
    """Measure and print.

    Args:
        argv: Dimensions; both if empty.
        sizes: Numbers of cells; those of the dimension if empty.
    """
    rows = []
    for dim in [int(text) for text in argv] or list(SIZES):
        for n in sizes or SIZES[dim]:
            for friction in FRICTION:
                job = {"dim": dim, "n": n, "friction": friction}
                found = {
                    pc: min(
                        (runner.alone("bench_solvers:measure", **job, pc=pc) for _ in range(RUNS)),
                        key=lambda row: row.get("cpu", 0),
                    )
                    for pc in ("lu", "condensed")
                }
                row = {**job, **found["condensed"]}
                if all("cpu" in one for one in found.values()):
                    row["direct"], row["condensed"] = (found[pc]["cpu"] for pc in found)
                    row["ratio"] = row["direct"] / row["condensed"]
                rows.append(row)
    title = "Direct and condensed solver: blocks pressed and pushed"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "solvers.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
