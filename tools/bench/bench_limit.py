# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem in linear solves: how far contact is from the limit.

The limit is one linear elastic solve of the same mesh without contact: assembly, and CG with GAMG
to 1e-8 with the rigid modes. Process CPU seconds on one thread, each run in a process of its own,
all in turn, medians; finite sliding, both methods, without friction and with it. Memory is the peak
resident size of a process, with imports and mesh, and what of it comes on top of the read mesh.
Beside it the fastest peer, as ``peers.csv`` and ``peers_friction.csv`` have it.

    python tools/bench/bench_limit.py 0.02 0.01
"""

from __future__ import annotations

import contextlib
import statistics
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import hertz_case
import pictures
import runner
import tables
from peers import table

import contactx as cx
import ufl
from contactx._host.options import product_options
from dolfinx import fem
from dolfinx.fem.petsc import apply_lifting, assemble_matrix, assemble_vector, set_bc

import measured
import scenes
import story
from meshes import Tag

SIZES = (0.02, 0.01, 0.005)
FRICTION, RUNS = (0.0, 0.3), 5
PEERS = {
    0.0: table.FILE,
    0.3: Path(__file__).with_name("peers_friction.csv"),
}
LIMIT = "one linear solve"
COLUMNS: list[tables.Column] = [
    ("h", "h", "g"),
    ("dofs", "dofs", "d"),
    ("scene", "scene", "s"),
    ("mu", "friction", "g"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("CPU s", "cpu", ".2f"),
    ("linear solves", "ratio", ".2f"),
    ("peak MB", "peak", ".0f"),
    ("MB on the mesh", "memory", ".0f"),
]


def contact(path: str, method: str, friction: float, shared: bool = False) -> dict[str, Any]:
    """Solve in this process.

    Args:
        path: File of the mesh.
        method: That of the contact.
        friction: Coefficient.
        shared: Whether each rank has a part of the contact.
    """
    data = hertz_case.read_mesh(path, shared)
    meter = runner.Meter()
    scene = scenes.HertzSphere(data, "finite", method=method, friction=friction)
    scene.problem.solve()
    return {**hertz_case.counts(scene.problem), **meter.read()}


def linear(path: str, in_turn: bool = False) -> dict[str, Any]:
    """Press on the same mesh without contact, in this process.

    Args:
        path: File of the mesh.
        in_turn: Whether the hierarchy is made of two products in turn, as in contactx, where PETSc
            would take another way on one rank.
    """
    # contactx must load the wheels' PETSc first
    from petsc4py import PETSc

    data = hertz_case.read_mesh(path)
    scene = scenes.HertzSphere(data, "finite")
    u, bcs = scene.problem.u, scene.bcs
    V = u.function_space
    F = story.elasticity(u, 1.0, 0.3)
    a = fem.form(ufl.derivative(F, u))
    ds = ufl.Measure("ds", data.mesh, subdomain_data=data.facet_tags)
    pressed = ds((int(Tag.UPPER_CONTACT), int(Tag.LOWER_CONTACT)))
    L = fem.form(ufl.inner(-0.01 * ufl.FacetNormal(data.mesh), ufl.TestFunction(V)) * pressed)
    meter = runner.Meter()
    A = assemble_matrix(a, bcs=bcs)
    A.assemble()
    A.setBlockSize(3)
    A.setOption(PETSc.Mat.Option.SPD, True)
    b = assemble_vector(L)
    apply_lifting(b, [a], [bcs])
    b.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    set_bc(b, bcs)
    x, places = A.createVecRight(), A.createVecRight()
    places.setBlockSize(3)
    owned = V.dofmap.index_map.size_local
    places.array[:] = V.tabulate_dof_coordinates()[:owned].ravel()
    A.setNearNullSpace(PETSc.NullSpace().createRigidBody(places))
    ksp = PETSc.KSP().create(data.mesh.comm)
    ksp.setOperators(A)
    ksp.setType("cg")
    ksp.getPC().setType("gamg")
    ksp.setTolerances(rtol=1e-8)
    is_in_turn = in_turn and data.mesh.comm.size == 1
    with product_options().in_database() if is_in_turn else contextlib.nullcontext():
        ksp.solve(b, x)
    if ksp.getConvergedReason() <= 0:
        raise cx.ConvergenceError("the linear solve did not converge")
    return {"dofs": len(u.x.array), "krylov": ksp.its, **meter.read()}


def run(sizes: Sequence[float]) -> list[dict[str, Any]]:
    """Measure all scenes of some sizes, one after the other, some times.

    Args:
        sizes: Cell sizes.
    """
    rows = []
    for h in sizes:
        path = str(hertz_case.mesh_file(h))
        jobs: list[tuple[str, dict[str, Any]]] = [("linear", {})]
        jobs += [("contact", {"method": m, "friction": f}) for m in story.METHODS for f in FRICTION]
        runs = [
            [runner.alone(f"bench_limit:{name}", path=path, **job) for name, job in jobs]
            for _ in range(RUNS)
        ]
        limit = 0.0
        for (_, job), found in zip(jobs, zip(*runs, strict=True), strict=True):
            row = {"h": h, "scene": job.get("method", LIMIT), **job, **found[-1]}
            del row["path"]
            if all("cpu" in one for one in found):
                row["cpu"] = statistics.median(one["cpu"] for one in found)
                limit = limit or row["cpu"]
                row["ratio"] = row["cpu"] / limit
            rows.append(row)
    return rows


def draw(rows: Sequence[dict[str, Any]], path: Path) -> None:
    """Picture of the time over the size, beside the limit and the fastest peer."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        name = row["scene"]
        if name != LIMIT:
            name += ", with friction" if row["friction"] else ", without friction"
        groups.setdefault(name, []).append(row)
    ours = len(groups)
    for friction, file in PEERS.items():
        for name, of_peer in table.others(file).items():
            groups[name + ", friction" * (friction > 0)] = of_peer
    pictures.lines(
        groups,
        path,
        ours=ours,
        axes=(("dofs", "cpu"),),
        words={"dofs": "displacements", "cpu": "process CPU seconds, one thread"},
        title="How far from one linear solve",
    )
    tables.note(f"see {path}")


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure, print and draw."""
    rows = run([float(h) for h in argv] or SIZES)
    tables.show(
        "Common Hertz problem in linear solves of its mesh",
        COLUMNS,
        rows,
        runner.OUTPUT / "limit.csv",
    )
    draw(rows, runner.OUTPUT / "limit.png")
    return rows


if __name__ == "__main__":
    sys.exit(measured.run("limit", main, sys.argv[1:]))
