# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Processes that end with the one that started them, however that one ends.

Run as a script it becomes another program: python tether.py PARENT PROGRAM ARGUMENTS ...
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

TESTS = Path(__file__).parent
# From linux/prctl.h
_PR_SET_PDEATHSIG = 1


def tether() -> None:
    """Have the kernel kill this process when its parent ends; on Linux, elsewhere it does nothing.

    A parent that is killed cannot end what it has started.
    """
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def environment(*folders: Path) -> dict[str, str]:
    """Environment of a process on one thread that imports what tests import, and more folders."""
    shared = (TESTS, *(TESTS.parent / folder for folder in ("demos", "tools")))
    found = [*map(str, (*folders, *shared))]
    found += filter(None, [os.getenv("PYTHONPATH")])
    return {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": os.pathsep.join(found)}


def tethered(command: Sequence[str]) -> list[str]:
    """The command that runs another one as a process that ends with this one."""
    return [sys.executable, __file__, str(os.getpid()), *command]


if __name__ == "__main__":
    tether()
    if os.getppid() != int(sys.argv[1]):
        sys.exit("the process that started this one has ended already")
    os.execvp(sys.argv[2], sys.argv[2:])
