# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_scripts.py: contact that stops on n ranks and goes on on m."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

import meshes
from inputs import archive
from ranks.agreeing import some_ranks, wait
from scenes.steps import DentedBlock, SlidingBlocks

WORLD = MPI.COMM_WORLD
FACETS = {"method": "surface-to-surface"}
SCENES: dict[str, Callable[[], Any]] = {
    "facets, friction": lambda: SlidingBlocks(CellType.quadrilateral, friction=0.2, **FACETS),
    "tied": lambda: SlidingBlocks(CellType.tetrahedron, tied=True, offset=0.01),
    "plastic, facets, friction": lambda: DentedBlock(friction=0.3, **FACETS),
}
# Ranks that write a checkpoint, and those that go on from it: three from what four have written,
# and one from what these three have written then
PAIRS = ((1, 2), (4, 3), (3, 1))


def scene_on(name: str, size: int) -> Any:
    """A new scene on the first so many ranks; None on the others."""
    comm = some_ranks(size)
    if comm is None:
        return None
    # The scenes do not name a communicator
    meshes.blocks.__kwdefaults__["comm"] = comm
    return SCENES[name]()


def make_steps(scene: Any, **options: Any) -> cx.LoadSteps:
    return cx.LoadSteps(
        scene.problem, [0.25, 0.5], scene.update, history=scene.history, progress=False, **options
    )


def take(scene: Any, steps: cx.LoadSteps, until: int | None = None) -> None:
    for step in steps:
        scene.commit()
        if step.index == until:
            break


def state(scene: Any, steps: cx.LoadSteps, file: Path) -> dict[str, Any]:
    """All arrays of the state but for the table with its wall times, on rank 0."""
    steps.save(file)
    comm = scene.u.function_space.mesh.comm
    arrays = archive.read(file) if comm.rank == 0 else {}
    arrays.pop("steps: table", None)
    comm.Barrier()
    return arrays


def straight(name: str, n: int, folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """States after the first step, which is written, and after the second."""
    scene = scene_on(name, n)
    if scene is None:
        return {}, {}
    steps = make_steps(scene)
    take(scene, steps, until=1)
    middle = state(scene, steps, folder / f"{name} {n}.state")
    take(scene, steps)
    return middle, state(scene, steps, folder / "end.state")


def restarted(name: str, n: int, m: int, folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """States as n ranks left it, and at the end, on m ranks."""
    scene = scene_on(name, m)
    if scene is None:
        return {}, {}
    steps = make_steps(scene, restart=folder / f"{name} {n}.state")
    again = state(scene, steps, folder / f"{name} {m}.state")
    take(scene, steps)
    return again, state(scene, steps, folder / "end.state")


def main(folder: Path) -> None:
    for name in SCENES:
        runs = {}
        for n in (1, WORLD.size):
            runs[n] = straight(name, n, folder)
            wait()
        for n, m in PAIRS:
            again, end = restarted(name, n, m, folder)
            wait()
            if WORLD.rank == 0:
                # What was read is what was written, to the last bit
                for key, values in again.items():
                    assert values.tobytes() == runs[n][0][key].tobytes(), (name, n, m, key)
                compare(end, runs[1][1], (name, n, m))
                runs.setdefault(m, (again, end))
                print(f"{name}: {n} ranks, then {m}", flush=True)


def compare(end: dict[str, Any], straight: dict[str, Any], what: tuple[Any, ...]) -> None:
    """Compare with a run of one rank that did not stop."""
    assert end.keys() == straight.keys()
    closed = straight["contact 0: status"] > 0
    assert closed.any() and not np.all(straight["u"] == 0)
    for key, values in end.items():
        exact = straight[key]
        if key.endswith(("slip", "slip_data", "master_start")):
            # Open nodes have what they had at some iterate
            values, exact = values[closed], exact[closed]
        if values.dtype.kind == "f":
            scale = max(1.0, np.nanmax(np.abs(exact), initial=0.0))
            assert np.allclose(values, exact, rtol=0, atol=1e-9 * scale, equal_nan=True), (
                what,
                key,
                np.nanmax(np.abs(values - exact)),
            )
        else:
            assert np.array_equal(values, exact), (what, key)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
