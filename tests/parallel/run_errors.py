# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec: lets things go wrong and writes down what came of it, for test_errors.py."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path

TESTS = Path(__file__).parents[1]
sys.path[:0] = [str(TESTS), str(TESTS.parent / "demos")]

from mpi4py import MPI  # noqa: E402

import scenes_errors  # noqa: E402
from watch import Watch  # noqa: E402

import contactx  # noqa: E402, F401

LIMIT = 60


def main(argv: Sequence[str]) -> None:
    """Run the functions named, and write what they return into the folder named first."""
    comm, folder = MPI.COMM_WORLD, Path(argv[1])
    watch = Watch(argv[0], comm.rank)
    for name in argv[2:]:
        watch.begin(name, LIMIT)
        found = getattr(scenes_errors, name)(folder)
        if comm.rank == 0:
            (folder / f"{name}-{comm.size}.json").write_text(json.dumps(found))
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
