# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs a script on several ranks, and ends it if they wait for one another for ever."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from watch import TIMED_OUT, stacks

# What a launch may take in all; each part of a script has a limit of its own
LONGEST = 600.0


class Hang(AssertionError):
    """Ranks waited for one another until the watchdog came."""


class Failure(AssertionError):
    """The script ended with an error."""


def mpiexec() -> str:
    """Launcher of the MPI that this Python has; that of the path if it brings none."""
    own = Path(sys.executable).parent / "mpiexec"
    return str(own) if own.exists() else "mpiexec"


def launch(script: Path, ranks: int, *arguments: str, longest: float = LONGEST) -> str:
    """Run a script on some ranks.

    The script makes a ``Watch`` of the folder that is its first argument.

    Args:
        script: The script.
        ranks: Number of ranks.
        arguments: Further arguments of the script.
        longest: Seconds after which all is killed in any case.

    Returns:
        What it printed.

    Raises:
        Hang: If ranks hang, with the stacks of all of them.
        Failure: If the script fails otherwise, with what it printed.
    """
    with tempfile.TemporaryDirectory() as folder:
        command = [mpiexec(), "-n", str(ranks), sys.executable, str(script), folder, *arguments]
        # A group of its own, so that nothing of it outlives its end
        process = subprocess.Popen(
            command,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            printed, _ = process.communicate(timeout=longest)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            printed, _ = process.communicate()
            raise Hang(f"hang: {longest:g} s were too few\n{printed}\n{stacks(folder)}") from None
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        found = stacks(folder)
        if TIMED_OUT in found:
            raise Hang(f"hang of {ranks} ranks in {script.name}\n{found}\n{printed}")
        if process.returncode != 0:
            raise Failure(f"{script.name} on {ranks} ranks: {process.returncode}\n{printed}")
        return printed
