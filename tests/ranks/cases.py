# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes, methods and partitions that are run on several ranks.

Run under mpiexec it solves cases and writes what came out, for test_ranks.py to compare.
"""

from __future__ import annotations

import inspect
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mpi4py import MPI

import numpy as np

import contactx as cx

from ranks import partitions, scenes_coupled, scenes_elastic, scenes_moving, scenes_several, watch
from ranks.outcome import Outcome
from ranks.partitions import partitioned

# Seconds a case may take on cores that others use, too, with forms to compile
LIMIT = 90
METHODS = {"node": "node-to-surface", "surface": "surface-to-surface"}
_MODULES = (scenes_elastic, scenes_several, scenes_coupled, scenes_moving)

# Functions that yield the problem after each step
SCENES: dict[str, Callable[[], Iterator[cx.ContactProblem]]] = {
    name: function
    for module in _MODULES
    for name, function in vars(module).items()
    if inspect.isgeneratorfunction(function) and not name.startswith("_")
}
# Scenes that name their method themselves: they are run by that one alone
ONE_METHOD = dict.fromkeys(("clip", "sheets", "discs", "loose_discs"), "node")
ONE_METHOD |= {"dam_face": "surface", "dam_face_in_increments": "surface"}
# What they are for is in that one alone, or the same in both
ONE_METHOD |= {"tip_on_arm": "surface", "chords": "surface", "edge": "node"}
# What tests/fast runs on two ranks: friction, free bodies, ties, nodes in several
# contacts, dragging over the parts of ranks, an obstacle, inertia, self-contact, both solvers,
# a fluid
QUICK = (
    ("friction_condensed", "node"),
    ("floating_3d", "surface"),
    ("tied", "node"),
    ("chain", "surface"),
    ("dragged_2d", "surface"),
    ("dragged_3d", "node"),
    ("plane", "node"),
    ("flying_2d", "surface"),
    ("clip", "node"),
    ("penetrated", "node"),
)


@dataclass(frozen=True)
class Case:
    """A scene by a method on a distributed mesh."""

    scene: str
    method: str
    partition: str = partitions.DEFAULT

    def __str__(self) -> str:
        return f"{self.scene}-{self.method}-{self.partition}"

    @classmethod
    def read(cls, text: str) -> Case:
        """A case from its text."""
        return cls(*text.split("-"))


def run(case: Case) -> dict[str, np.ndarray]:
    """Solve a case; what came out is on rank 0."""
    cx.Contact.__init__.__kwdefaults__["method"] = METHODS[case.method]
    outcome = Outcome()
    with partitioned(case.partition):
        for problem in SCENES[case.scene]():
            outcome.add(problem)
    return outcome.gather(problem)


def main(argv: Sequence[str]) -> None:
    """Solve the cases named, and write the results into the folder named first."""
    comm = MPI.COMM_WORLD
    for name in argv[1:]:
        watch.begin(name, LIMIT)
        start = time.perf_counter()
        try:
            found = run(Case.read(name))
        except Exception:
            # The other ranks must have it, too, or the watch will say so
            found = {"error": np.array(traceback.format_exc())}
            print(f"{name}, rank {comm.rank}: {found['error']}", flush=True)
        comm.Barrier()
        if comm.rank == 0:
            seconds = time.perf_counter() - start
            np.savez(Path(argv[0]) / f"{name}-{comm.size}.npz", seconds=seconds, **found)
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
