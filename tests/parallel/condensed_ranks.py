# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_condensed_ranks.py under mpiexec: solves scenes and writes their answers to a file.

Arguments: the file, and the names of the scenes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
import stacked_blocks
from partitions import partitioned
from scenes import Blocks, hertz_sphere
from story import fix

import contactx as cx
from contactx.meshes import Tag
from contactx.parallel.reduce import gathered
from dolfinx.mesh import CellType

OPTIONS = {"petsc_options": {"pc_type": "condensed"}}
MORTAR = {"method": "surface-to-surface"}

type Scene = tuple[cx.ContactProblem, list[cx.Contact]]


def sphere(sliding: str, down: float = 0.02, **options: Any) -> Scene:
    problem, contact = hertz_sphere(0.04, sliding, down=down, **options, **OPTIONS)
    return problem, [contact]


def blocks(cell: CellType, *, aside: float = 0.02, **options: Any) -> Scene:
    scene = Blocks(cell, n_upper=4, n_lower=3)
    scene.bcs[-2].g.value[...] = aside
    contact = scene.contact(**options)
    return scene.problem(contact, **OPTIONS), [contact]


def on_plane(cell: CellType, **options: Any) -> Scene:
    scene = Blocks(cell, n_upper=4, n_lower=3)
    gdim = scene.u.function_space.mesh.geometry.dim
    plane = cx.Plane(np.zeros(gdim), np.eye(gdim)[-1])
    contact = scene.contact(master=plane, **options)
    return scene.problem(contact, **OPTIONS), [contact]


def held() -> Scene:
    """Slave nodes that are held where they press on the master cannot be condensed."""
    scene = Blocks(CellType.tetrahedron, gap=1e-9)
    contact = scene.contact(friction=0.3)
    scene.bcs += [fix(scene.u, scene.tags, i, -0.01 * i, Tag.UPPER_CONTACT) for i in range(3)]
    return scene.problem(contact, **OPTIONS), [contact]


def free_blocks(dim: int) -> Scene:
    stacked_blocks.INTERFERENCE = 0.0
    problem, contacts, load = stacked_blocks.create(0.25, "finite", dim, **OPTIONS)
    load.value[0], load.value[-1] = 0.001, -0.01
    return problem, contacts


SCENES: dict[str, Callable[[], Scene]] = {
    "sphere": lambda: sphere("finite"),
    "small sphere": lambda: sphere("small"),
    "friction": lambda: sphere("finite", 1e-5, friction=0.3),
    "sphere mortar": lambda: sphere("finite", **MORTAR),
    "blocks": lambda: blocks(CellType.tetrahedron),
    "blocks friction": lambda: blocks(CellType.hexahedron, friction=0.3),
    "blocks 2D": lambda: blocks(CellType.triangle, friction=0.3),
    "mortar": lambda: blocks(CellType.tetrahedron, **MORTAR),
    "mortar friction": lambda: blocks(CellType.hexahedron, friction=0.3, **MORTAR),
    "tied": lambda: blocks(CellType.tetrahedron, tied=True),
    "tied mortar": lambda: blocks(CellType.hexahedron, tied=True, **MORTAR),
    "plane": lambda: on_plane(CellType.hexahedron, friction=0.3),
    "plane mortar": lambda: on_plane(CellType.tetrahedron, **MORTAR),
    "held": held,
    "free blocks 2D": lambda: free_blocks(2),
    "free blocks": lambda: free_blocks(3),
}


def answers(problem: cx.ContactProblem, contacts: list[cx.Contact]) -> dict[str, Any]:
    """What does not depend on the number of ranks, nodes in the mesh's order; on all ranks."""
    halo, comm = problem._halo, problem._halo.comm
    n = halo.num_owned
    u = problem.u.x.array.reshape(-1, halo.gdim)[:n]
    status = [c.status.x.array[:n] for c in contacts]
    report = problem.report
    return {
        "u": in_order(comm, halo.original[:n], u),
        "status": in_order(comm, halo.original[:n], np.stack(status, axis=1)),
        "iterations": report.iterations,
        "krylov": report.krylov,
        "hierarchies": report.hierarchies,
        "uncondensed": sorted(set(report.uncondensed)),
        "direct": len(report.uncondensed),
    }


def in_order(comm: MPI.Comm, numbers: npt.NDArray[Any], rows: npt.NDArray[Any]) -> Any:
    every, rows = gathered(comm, numbers), gathered(comm, rows)
    return rows[np.argsort(every)]


def main(path: str, partition: str, *names: str) -> None:
    for name in names or SCENES:
        with partitioned(partition):
            problem, contacts = SCENES[name]()
        problem.solve()
        found = answers(problem, contacts)
        if MPI.COMM_WORLD.rank == 0:
            print(name, {k: v for k, v in found.items() if k not in ("u", "status")}, flush=True)
            np.savez(f"{path}-{name}.npz".replace(" ", "_"), **found)


if __name__ == "__main__":
    main(*sys.argv[1:])
