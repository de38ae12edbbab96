# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The watchdog of a rank: after a limit it writes down where the rank is, and ends it."""

from __future__ import annotations

import faulthandler
import os
import signal
from pathlib import Path

# How faulthandler begins
TIMED_OUT = "Timeout ("
# Seconds for the other ranks to write theirs
_GRACE = 3


class Watch:
    """Limits each part of a script on a rank, whatever the rank is waiting for."""

    def __init__(self, folder: str, rank: int):
        """Watch this rank.

        Args:
            folder: Where the stack of the rank is written.
            rank: Its number.
        """
        self._rank = rank
        # No file of Python, which would be closed before the process has ended
        self._file = os.open(Path(folder) / f"rank_{rank}.txt", os.O_WRONLY | os.O_CREAT)

    def begin(self, part: str, limit: float) -> None:
        """Begin a part of the script, and end the one before.

        Args:
            part: Its name.
            limit: Seconds that it may take.
        """
        os.ftruncate(self._file, 0)
        os.lseek(self._file, 0, os.SEEK_SET)
        os.write(self._file, f"--- rank {self._rank} in {part}\n".encode())
        # By a thread of C, as the rank may be inside MPI
        faulthandler.dump_traceback_later(limit, file=self._file)
        # Its default action ends the process, and mpiexec then the other ranks
        signal.alarm(int(limit) + _GRACE)


def stacks(folder: str | Path) -> str:
    """What all ranks have written down."""
    return "\n".join(path.read_text() for path in sorted(Path(folder).glob("rank_*.txt")))
