# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the condensed solver's numbers cost where they are others.

Each number of ``condense/solver/tuning.h`` is a half and twice of what it is, or about that, while
the others stay. On five slabs of a dam's face, solved by blocks of bodies, in three stages; on a
rubber block that a ball presses in, in four steps, whose hierarchies and factors age with its
stiffness; on the common Hertz problem, surface-to-surface, whose nodes open one iterate after the
other.

    python tools/bench/bench_tuning.py
    python tools/bench/bench_tuning.py max_change
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import hertz_case
import runner
import tables

import contactx as cx  # isort: skip

from mpi4py import MPI

import numpy as np

import ufl
from dolfinx import fem, mesh

from dam_scene import Dam, DamSetting, run
from meshes import DamFace
from scenes import HertzSphere
from scenes.tuning import tuned

VALUES: dict[str, tuple[float, ...]] = {
    "renewal_cost": (10, 20, 80),
    "slow_rate": (6, 24),
    "max_iterations": (60, 240),
    "max_change": (0.0, 0.05, 0.075, 0.3),
    "short_wave_exponent": (0.0, 0.2, 0.5),
}
SCENES = ("slabs", "rubber", "sphere")
SPHERE = 0.005
SLABS = DamFace(slabs=5, height=24.0, rows=20, layers=2, rockfill_cells=4, rockfill_rows=14)
STAGES = 3
COLUMNS: list[tables.Column] = [
    ("scene", "scene", "s"),
    ("number", "number", "s"),
    ("value", "value", ".3g"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("hierarchies", "hierarchies", "d"),
    ("factorisations", "factorisations", "d"),
    ("CPU s", "cpu", ".2f"),
    ("ratio", "ratio", ".2f"),
]


def measure(scene: str, number: str, value: float) -> dict[str, Any]:
    """Solve in this process.

    Args:
        scene: One of ``SCENES``.
        number: Name of a number; empty to leave all as they are.
        value: Its value.
    """
    others = {number: value if number.startswith(("max_change", "short")) else int(value)}
    with tuned(**(others if number else {})):
        return {"slabs": slabs, "rubber": rubber, "sphere": sphere}[scene]()


def totals(reports: Sequence[cx.Report]) -> dict[str, Any]:
    """Sums over steps."""
    names = ("iterations", "krylov", "hierarchies", "factorisations")
    return {name: sum(getattr(report, name) for report in reports) for name in names}


def slabs() -> dict[str, Any]:
    """A dam's face, see ``measure``."""
    meter = runner.Meter()
    reports: list[cx.Report] = []
    dam = Dam(DamSetting(SLABS))

    def each(dam: Dam, _: Any) -> None:
        reports.append(dam.problem.report)

    run(dam, STAGES, creep=False, each=each, progress=False)
    return {**totals(reports), **meter.read()}


def sphere() -> dict[str, Any]:
    """The common Hertz problem, see ``measure``."""
    data = hertz_case.read_mesh(hertz_case.mesh_file(SPHERE))
    meter = runner.Meter()
    scene = HertzSphere(data, "finite", method="surface-to-surface")
    scene.problem.solve()
    return {**totals([scene.problem.report]), **meter.read()}


def rubber() -> dict[str, Any]:
    """A block of rubber and a ball, see ``measure``."""
    domain = mesh.create_unit_cube(MPI.COMM_WORLD, 16, 16, 16, mesh.CellType.hexahedron)
    V = fem.functionspace(domain, ("Lagrange", 1, (3,)))
    u = fem.Function(V)
    F = ufl.Identity(3) + ufl.grad(u)
    J = ufl.det(F)
    energy = (ufl.tr(F.T * F) - 3 - 2 * ufl.ln(J)) / 2 + ufl.ln(J) ** 2
    bottom, top = (
        mesh.locate_entities_boundary(domain, 2, lambda x, z=z: np.isclose(x[2], z)) for z in (0, 1)
    )
    bcs = [fem.dirichletbc(np.zeros(3), fem.locate_dofs_topological(V, 2, bottom), V)]
    tags = mesh.meshtags(domain, 2, np.sort(top), np.ones(len(top), dtype=np.int32))
    centre = fem.Constant(domain, (0.5, 0.5, 1.5))
    contact = cx.Contact(cx.Surface(tags, 1), cx.Sphere(centre, radius=0.5), friction=0.3)
    meter = runner.Meter()
    problem = cx.ContactProblem(
        ufl.derivative(energy * ufl.dx(degree=2), u), u, contacts=[contact], bcs=bcs,
        petsc_options_prefix="tuning_", petsc_options={"pc_type": "condensed"},
    )  # fmt: skip
    reports = []
    for step in range(1, 5):
        centre.value[2] = 1.5 - 0.08 * step
        problem.solve()
        reports.append(problem.report)
    return {**totals(reports), **meter.read()}


def main(
    argv: Sequence[str], scenes: Sequence[str] = SCENES, most: int = 9
) -> list[dict[str, Any]]:
    """Measure and print.

    Args:
        argv: Names of numbers; all if empty.
        scenes: Scenes.
        most: Most other values of a number.
    """
    rows = []
    for scene in scenes:
        usual = runner.alone("bench_tuning:measure", scene=scene, number="", value=0)
        rows.append({**usual, "ratio": 1.0})
        for number in argv or VALUES:
            for value in VALUES[number][:most]:
                row = runner.alone("bench_tuning:measure", scene=scene, number=number, value=value)
                if "cpu" in row and "cpu" in usual:
                    row["ratio"] = row["cpu"] / usual["cpu"]
                rows.append(row)
    tables.show("Tuning of the condensed solver", COLUMNS, rows, runner.OUTPUT / "tuning.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
