# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem in units of one linear solve of its mesh without contact.

The unit is what DOLFINx and PETSc take to assemble the bulk and to solve it once by CG with GAMG,
its rigid modes and a relative residual of 1e-8. All four ways are in finite sliding; runs take
turns, each in a process of its own, and the medians of their CPU seconds count. Memory is the peak
resident size of a process, with imports and mesh, and what of it comes on top of the read mesh.

    python tools/bench/bench_units.py 0.02 0.01
"""

from __future__ import annotations

import statistics
import sys
from collections.abc import Sequence
from typing import Any

import hertz_case
import numpy as np
import runner
import tables

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import apply_lifting, assemble_matrix, assemble_vector, set_bc

import scenes

SIZES = (0.02, 0.01, 0.005)
RUNS = 5
MORTAR = {"method": "surface-to-surface"}
WAYS: dict[str, dict[str, Any]] = {
    "node-to-surface": {},
    "surface-to-surface": MORTAR,
    "friction 0.3": {"friction": 0.3},
    "surface-to-surface, friction 0.3": {"friction": 0.3, **MORTAR},
}
COLUMNS = [
    ("h", "h", "g"),
    ("way", "way", "s"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("CPU s", "cpu", ".2f"),
    ("units", "units", ".2f"),
    ("peak MB", "peak", ".0f"),
    ("MB on the mesh", "memory", ".0f"),
]


def contact(path: str, way: str) -> dict[str, Any]:
    """Solve with contact.

    Args:
        path: File of the mesh.
        way: One of ``WAYS``.
    """
    data = hertz_case.read_mesh(path)
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, "finite", **WAYS[way])
    scene.problem.solve()
    report = scene.problem.report
    return {
        **meter.read(),
        "peak": runner.memory("VmHWM"),
        "iterations": report.iterations,
        "krylov": report.krylov,
    }


def linear(path: str) -> dict[str, Any]:
    """Solve once without contact.

    Args:
        path: File of the mesh.
    """
    # Only once contactx has loaded the wheels' MPI
    from petsc4py import PETSc

    data = hertz_case.read_mesh(path)
    scene = scenes.HertzSphere(data, "finite")
    u, bcs = scene.problem.u, scene.bcs
    meter = runner.Meter()
    a = fem.form(ufl.derivative(scene.F, u))
    A = assemble_matrix(a, bcs=bcs)
    A.assemble()
    b = assemble_vector(fem.form(scene.F))
    x0 = u.x.petsc_vec.copy()
    apply_lifting(b, [a], bcs=[bcs], x0=[x0], alpha=-1.0)
    set_bc(b, bcs, x0, -1.0)
    A.setBlockSize(3)
    nodes = u.function_space.tabulate_dof_coordinates()[: A.getLocalSize()[0] // 3]
    x = PETSc.Vec().createWithArray((nodes - nodes.mean(axis=0)).ravel(), bsize=3)
    A.setNearNullSpace(PETSc.NullSpace().createRigidBody(x))
    ksp = PETSc.KSP().create()
    ksp.setOperators(A)
    ksp.setType("cg")
    ksp.getPC().setType("gamg")
    ksp.setTolerances(rtol=1e-8)
    dx = b.duplicate()
    ksp.solve(b, dx)
    assert ksp.getConvergedReason() > 0
    assert np.isfinite(dx.norm())
    return {
        **meter.read(),
        "peak": runner.memory("VmHWM"),
        "iterations": 1,
        "krylov": ksp.getIterationNumber(),
    }


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    rows = []
    for h in [float(h) for h in argv] or SIZES:
        path = str(hertz_case.mesh_file(h))
        seen: dict[str, list[dict[str, Any]]] = {"linear": [], **{way: [] for way in WAYS}}
        for _ in range(RUNS):
            seen["linear"].append(runner.alone("bench_units:linear", path=path))
            for way in WAYS:
                seen[way].append(runner.alone("bench_units:contact", path=path, way=way))
        medians = {
            way: {
                name: statistics.median(run[name] for run in runs)
                for name in ("cpu", "peak", "memory", "iterations", "krylov")
            }
            for way, runs in seen.items()
        }
        unit = medians["linear"]["cpu"]
        for way, values in medians.items():
            rows.append({"h": h, "way": way, **values, "units": values["cpu"] / unit})
    tables.show(f"contactx {cx.__version__}", COLUMNS, rows, runner.OUTPUT / "units.csv")
    return rows


if __name__ == "__main__":
    sys.exit(0 if main(sys.argv[1:]) else 1)
