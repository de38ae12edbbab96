# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec: solves cases and writes what came out, for test_ranks.py to compare.

mpiexec -n 2 python tests/parallel/run_cases.py FOLDER hertz_2d-node-default
"""

from __future__ import annotations

import sys
import time
import traceback
from collections.abc import Sequence
from pathlib import Path

import numpy as np

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "demos")]

from mpi4py import MPI  # noqa: E402

from cases import METHODS, SCENES, Case  # noqa: E402
from outcome import Outcome  # noqa: E402
from partitions import partitioned  # noqa: E402
from watch import Watch  # noqa: E402

import contactx as cx  # noqa: E402

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
    folder, comm = argv[0], MPI.COMM_WORLD
    watch = Watch(folder, comm.rank)
    for name in argv[2:]:
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
            np.savez(Path(argv[1]) / f"{name}-{comm.size}.npz", seconds=seconds, **found)
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
