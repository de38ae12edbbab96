# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The watchdog of a rank: after a limit it writes down where the rank is, and ends it.

Run as a script it runs another one, watched: python watch.py SECONDS SCRIPT ...
"""

from __future__ import annotations

import faulthandler
import os
import runpy
import signal
import sys
import traceback
from pathlib import Path

import contactx  # noqa: F401  # it loads the wheels' MPI

# isort: split
from mpi4py import MPI

# Environment variable with the folder that the stacks come to
FOLDER = "CONTACTX_STACKS"
# How faulthandler begins
TIMED_OUT = "Timeout ("
# Seconds for the other ranks to write theirs
_GRACE = 3


def begin(part: str, limit: float) -> None:
    """Begin a part of a script, and end the one before.

    Args:
        limit: Seconds that it may take on this rank, whatever the rank is waiting for.
    """
    rank = MPI.COMM_WORLD.rank
    # No file of Python, which would be closed before the process has ended
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    file = os.open(Path(os.environ[FOLDER]) / f"rank_{rank}.txt", flags)
    os.write(file, f"--- rank {rank} in {part}\n".encode())
    # By a thread of C, as the rank may be inside MPI
    faulthandler.dump_traceback_later(limit, file=file)
    # Its default action ends the process, and mpiexec then the other ranks
    signal.alarm(int(limit) + _GRACE)


def stacks(folder: str | Path) -> str:
    """What all ranks have written down."""
    return "\n".join(path.read_text() for path in sorted(Path(folder).glob("rank_*.txt")))


def run(script: str, limit: float) -> None:
    """Run a script, watched; an error of one rank ends all, which may be waiting for it."""
    sys.path[0] = str(Path(script).parent)
    begin(Path(script).name, limit)
    try:
        runpy.run_path(script, run_name="__main__")
    except BaseException as error:
        if isinstance(error, SystemExit) and not error.code:
            return
        traceback.print_exc()
        sys.stderr.flush()
        MPI.COMM_WORLD.Abort(1)


if __name__ == "__main__":
    _, seconds, name, *_ = sys.argv
    sys.argv[:] = sys.argv[2:]
    run(name, float(seconds))
