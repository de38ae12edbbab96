# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""From how many displacements on the condensed solver is faster than the direct one.

Blocks pressed on each other and pushed aside in four steps, finite sliding, without friction and
with it: process CPU seconds by MUMPS over those of the condensed solver, on one thread, the least
of some runs. The same with other fields: an incompressible block of Taylor-Hood elements pressed
on a rigid ball. ``contactx._host.options`` has the rule that follows from it. Blocks that are
pushed by a side, with friction, have multipliers that stay unknowns at its edge: there the other
solver is that by blocks of bodies.

    python tools/bench/bench_solvers.py 2
    python tools/bench/bench_solvers.py 3
    python tools/bench/bench_solvers.py mixed-2
    python tools/bench/bench_solvers.py mixed-3
    python tools/bench/bench_solvers.py side-3
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import runner
import tables

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np

import basix.ufl
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag

# Cells along a side of the upper block; of the block of Taylor-Hood elements
SIZES = {
    "2": (10, 20, 30, 40, 60, 100),
    "3": (4, 5, 6, 7, 9, 12),
    "mixed-2": (25, 50, 100, 200),
    "mixed-3": (4, 6, 8, 12, 22),
    "side-3": (8, 16, 24),
}
FRICTION, STEPS, RUNS = (0.0, 0.3), 4, 2
# Repeating what takes a minute says no more
LARGE = 100_000
COLUMNS: list[tables.Column] = [
    ("case", "case", "s"),
    ("dofs", "dofs", ",d"),
    ("friction", "friction", "g"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("other", "other", "s"),
    ("other, s", "direct", ".3f"),
    ("condensed, s", "condensed", ".3f"),
    ("ratio", "ratio", ".2f"),
    ("other, MB", "direct_peak", ".0f"),
    ("condensed, MB", "peak", ".0f"),
]


def measure(case: str, n: int, friction: float, pc: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        case: One of ``SIZES``.
        n: Cells along a side of a block.
        friction: Coefficient.
        pc: "lu", "condensed", or "bodies" for the condensed solver by blocks of bodies.
    """
    dim = int(case[-1])
    options = {"pc_type": "condensed" if pc == "bodies" else pc}
    if pc == "bodies":
        options["condensed_pc_type"] = pc
    if case.startswith("mixed"):
        return mixed(dim, n, friction, options)
    return blocks(dim, n, friction, options, by_a_side=case.startswith("side"))


def blocks(
    dim: int, n: int, friction: float, options: dict[str, str], by_a_side: bool = False
) -> dict[str, Any]:
    """Blocks pressed on each other, then pushed aside at the top or by a side, see ``measure``."""
    cell = CellType.quadrilateral if dim == 2 else CellType.hexahedron
    wide = (1.4,) * (dim - 1) + (1.0,)
    data = meshes.blocks(cell, (n,) * dim, (round(1.2 * n),) * dim, size_lower=wide)
    tags, u = data.facet_tags, story.displacement(data.mesh)
    bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)]
    top = [story.fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(dim)]
    if by_a_side:
        top[0] = story.fix(u, tags, 0, 0.0, Tag.UPPER_X0)
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT),
        cx.Surface(tags, Tag.LOWER_CONTACT),
        friction=friction,
    )
    meter = runner.Meter()
    problem = cx.ContactProblem(
        story.elasticity(u, 1.0, 0.3), u, contacts=[contact], bcs=bcs + top,
        petsc_options_prefix="solvers_", petsc_options=options,
    )  # fmt: skip
    iterations = krylov = 0
    for step in range(1, STEPS + 1):
        top[-1].g.value[...] = -0.02
        top[0].g.value[...] = 0.04 * step / STEPS
        problem.solve()
        iterations += problem.report.iterations
        krylov += problem.report.krylov
    return {
        "dofs": len(u.x.array),
        "iterations": iterations,
        "krylov": krylov,
        **meter.read(),
    }


def mixed(dim: int, n: int, friction: float, options: dict[str, str]) -> dict[str, Any]:
    """Incompressible block on a ball, Taylor-Hood elements, see ``measure``."""
    if dim == 2:
        domain = mesh.create_unit_square(MPI.COMM_WORLD, n, n)
    else:
        domain = mesh.create_unit_cube(MPI.COMM_WORLD, n, n, n)
    cell = domain.basix_cell()
    parts = [basix.ufl.element("Lagrange", cell, 2, shape=(dim,))]
    parts.append(basix.ufl.element("Lagrange", cell, 1))
    W = fem.functionspace(domain, basix.ufl.mixed_element(parts))
    w = fem.Function(W)
    (u, p), (v, q) = ufl.split(w), ufl.TestFunctions(W)
    strain, volume = ufl.sym(ufl.grad(u)), ufl.div(u)
    F = (2 * ufl.inner(strain, ufl.grad(v)) - p * ufl.div(v) - q * volume) * ufl.dx
    bottom, top = (
        mesh.locate_entities_boundary(domain, dim - 1, lambda x, z=z: np.isclose(x[dim - 1], z))
        for z in (0, 1)
    )
    V, _ = W.sub(0).collapse()
    held = fem.locate_dofs_topological((W.sub(0), V), dim - 1, bottom)
    bcs = [fem.dirichletbc(fem.Function(V), held, W.sub(0))]
    tags = mesh.meshtags(domain, dim - 1, np.sort(top), np.ones(len(top), dtype=np.int32))
    ball = cx.Sphere((0.5,) * (dim - 1) + (1.95,), radius=1.0)
    meter = runner.Meter()
    problem = cx.ContactProblem(
        F, w, contacts=[cx.Contact(cx.Surface(tags, 1), ball, friction=friction)], bcs=bcs,
        displacement=0, petsc_options_prefix="solvers_", petsc_options=options,
    )  # fmt: skip
    problem.solve()
    report = problem.report
    assert not report.uncondensed
    dofs = W.dofmap.index_map.size_global * W.dofmap.index_map_bs
    return {
        "dofs": dofs,
        "iterations": report.iterations,
        "krylov": report.krylov,
        **meter.read(),
    }


def main(argv: Sequence[str], sizes: Sequence[int] = ()) -> list[dict[str, Any]]:
    """Measure and print.

    Args:
        argv: Cases; all if empty.
        sizes: Numbers of cells; those of the case if empty.
    """
    rows = []
    for case in argv or list(SIZES):
        other = "bodies" if case.startswith("side") else "lu"
        for n in sizes or SIZES[case]:
            for friction in FRICTION:
                job = {"case": case, "n": n, "friction": friction}
                found = {pc: _least(job, pc) for pc in (other, "condensed")}
                row = {**job, "other": other, **found["condensed"]}
                if all("cpu" in one for one in found.values()):
                    row["direct"], row["condensed"] = (found[pc]["cpu"] for pc in found)
                    row["ratio"] = row["direct"] / row["condensed"]
                    row["direct_peak"] = found[other]["peak"]
                rows.append(row)
    title = "Condensed solver by multigrid and another one: blocks pressed and pushed"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "solvers.csv")
    return rows


def _least(job: dict[str, Any], pc: str) -> dict[str, Any]:
    """The fastest of some runs."""
    rows = [runner.alone("bench_solvers:measure", **job, pc=pc)]
    while len(rows) < RUNS and rows[0].get("dofs", LARGE) < LARGE:
        rows.append(runner.alone("bench_solvers:measure", **job, pc=pc))
    return min(rows, key=lambda row: row.get("cpu", 0))


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
