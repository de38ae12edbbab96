# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec: solves cases and writes what came out, for test_ranks.py to compare."""

from __future__ import annotations

import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path

from mpi4py import MPI

import numpy as np

import contactx as cx

from ranks import watch
from ranks.cases import METHODS, SCENES, Case
from ranks.outcome import Outcome
from ranks.partitions import partitioned

# Seconds a case may take on cores that others use, too, with forms to compile
LIMIT = 90


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
