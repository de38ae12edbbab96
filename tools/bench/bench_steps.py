# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Load steps: ten of them against one, for the same load.

A block pressed on a wider one by a pressure, whose status settles in the first step, and the common
Hertz problem, whose contact grows in every step. Process CPU seconds from the mesh on.

    python tools/bench/bench_steps.py 0.02
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import Any

import hertz_case
import runner
import tables

import contactx as cx
from dolfinx import fem
from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import CellType

import meshes
import scenes
import story
from meshes import Tag

SIZES = (0.01,)
STEPS = 10

COLUMNS = [
    ("scene", "scene", "s"),
    ("sliding", "sliding", "s"),
    ("dofs", "dofs", "d"),
    ("solves", "solves", "s"),
    ("in each of the ten", "each", "s"),
    ("Krylov", "krylov", "s"),
    ("hier.", "hierarchies", "s"),
    ("not condensed", "uncondensed", "s"),
    ("one step, CPU s", "cpu_one", ".2f"),
    ("ten", "cpu", ".2f"),
    ("ratio", "ratio", ".2f"),
]


def measure(scene: str, h: float, path: str, sliding: str, steps: int) -> dict[str, Any]:
    """Solve in this process.

    Args:
        scene: "Hertz" or "pressed block".
        h: Cell size of the Hertz problem; the block has about as many displacements.
        path: File of its mesh.
        sliding: "finite" or "small".
        steps: Number of load steps.
    """
    problem: cx.ContactProblem
    update: Callable[[float], None]
    if scene == "Hertz":
        data = hertz_case.read_mesh(path)
        meter = runner.Meter()
        sphere = scenes.HertzSphere(data, sliding)
        problem, update = sphere.problem, sphere.update
    else:
        data = _block_mesh(max(2, round(0.13 / h)))
        meter = runner.Meter()
        problem, update = _pressed_block(data, sliding)
    done = []
    for _ in cx.LoadSteps(problem, steps, update=update, progress=False):
        done.append({**hertz_case.counts(problem), "discarded": problem.report.discarded})
    cpu = meter.read()["cpu"]
    names = ("iterations", "discarded", "krylov", "hierarchies", "uncondensed")
    return {
        "dofs": done[0]["dofs"],
        "each": [step["iterations"] for step in done],
        "cpu": cpu,
        **{name: sum(step[name] for step in done) for name in names},
    }


def _block_mesh(n: int) -> MeshData:
    lower = (n + 3, n + 3, n)
    return meshes.blocks(CellType.tetrahedron, (n, n, n), lower, size_lower=(1.5, 1.5, 1.0))


def _pressed_block(
    data: MeshData, sliding: str
) -> tuple[cx.ContactProblem, Callable[[float], None]]:
    """A quarter of a block on a quarter of a wider one, under a pressure on its top."""
    tags, u = data.facet_tags, story.displacement(data.mesh)
    load = fem.Constant(data.mesh, (0.0, 0.0, 0.0))
    F = story.elasticity(u, 1.0, scenes.NU) + story.traction(u, tags, Tag.UPPER_TOP, load)
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT), sliding=sliding
    )
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        *(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
    ]
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="pressed_")

    def update(t: float) -> None:
        load.value[2] = -0.02 * t

    return problem, update


def both(scene: str, h: float, path: str, sliding: str) -> dict[str, Any]:
    """A row of one step and ten."""
    job = {"scene": scene, "h": h, "path": path, "sliding": sliding}
    one, ten = (runner.alone("bench_steps:measure", **job, steps=n) for n in (1, STEPS))
    if "failed" in one or "failed" in ten:
        why = one.get("failed") or f"in {STEPS} steps: {ten['failed']}"
        return {"scene": scene, "sliding": sliding, "failed": why}
    row = {key: ten[key] for key in ("scene", "h", "sliding", "dofs", "cpu")}
    for name in ("krylov", "hierarchies", "uncondensed"):
        row[name] = f"{one[name]} : {ten[name]}"
    cut = f" ({ten['discarded']} discarded)" if ten["discarded"] else ""
    row["solves"] = f"{one['iterations']} : {ten['iterations']}{cut}"
    row["each"] = " ".join(map(str, ten["each"]))
    return {**row, "cpu_one": one["cpu"], "ratio": ten["cpu"] / one["cpu"]}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    sizes = [float(h) for h in argv] or SIZES
    rows = []
    for h in sizes:
        path = str(hertz_case.mesh_file(h))
        for scene in ("pressed block", "Hertz"):
            # The forms are compiled once for all
            coarse = {"scene": scene, "h": 0.2, "path": str(hertz_case.mesh_file(0.2))}
            runner.alone("bench_steps:measure", **coarse, sliding="small", steps=1)
            rows += [both(scene, h, path, sliding) for sliding in ("small", "finite")]
    title = f"{STEPS} load steps against one (one : {STEPS})"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "steps.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
