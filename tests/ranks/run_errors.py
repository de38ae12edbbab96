# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run under mpiexec: lets things go wrong and writes down what came of it, for test_errors.py."""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from mpi4py import MPI

from ranks import scenes_errors, watch

LIMIT = 60


def main(argv: Sequence[str]) -> None:
    """Run the functions named, and write what they return into the folder named first."""
    comm, folder = MPI.COMM_WORLD, Path(argv[0])
    for name in argv[1:]:
        watch.begin(name, LIMIT)
        found = None
        try:
            found = getattr(scenes_errors, name)(folder)
        except Exception:
            # Not where it is expected to be raised
            traceback.print_exc()
        comm.Barrier()
        if comm.rank == 0 and found is not None:
            (folder / f"{name}-{comm.size}.json").write_text(json.dumps(found))
    watch.begin("the end", LIMIT)


if __name__ == "__main__":
    main(sys.argv[1:])
