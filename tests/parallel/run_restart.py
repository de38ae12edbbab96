# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec by test_restart.py: load steps whole, up to a checkpoint, or from one on.

Each argument is a task: "whole", "write" or the number of ranks that wrote the checkpoint.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from mpi4py import MPI

import numpy as np
import watch
from outcome import Outcome
from step_scenes import DentedBlock, LooseBlock, SlidingBlocks

import contactx as cx
from dolfinx.mesh import CellType

LIMIT = 60
STEPS, BREAK = 4, 0.5
SCENES = {
    "dented": lambda: DentedBlock(friction=0.2),
    "sliding": lambda: SlidingBlocks(CellType.quadrilateral, friction=0.3),
    "loose": LooseBlock,
}


def run(name: str, folder: Path, task: str) -> None:
    """Take load steps of a scene."""
    scene, comm = SCENES[name](), MPI.COMM_WORLD
    files = {"whole": {}, "write": {"checkpoint": folder / f"{name}-{comm.size}.npz"}}
    steps = cx.LoadSteps(
        scene.problem,
        STEPS,
        update=scene.update,
        history=scene.history,
        progress=False,
        **files.get(task, {"restart": folder / f"{name}-{task}.npz"}),
    )
    outcome = Outcome()
    for step in steps:
        scene.commit()
        if task == "write" and step.t > BREAK:
            return
        if step.t > BREAK:
            outcome.add(scene.problem)
    found = outcome.gather(scene.problem)
    if comm.rank == 0:
        np.savez(folder / f"{name}-{task}-{comm.size}.npz", **found)


def main(argv: Sequence[str]) -> None:
    """Run the tasks named, with files in the folder named first."""
    comm, folder = MPI.COMM_WORLD, Path(argv[0])
    for task in argv[1:]:
        for name in SCENES:
            watch.begin(f"{name}, {task}", LIMIT)
            run(name, folder, task)
            comm.Barrier()
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
