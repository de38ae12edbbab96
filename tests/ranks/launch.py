# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs a script on several ranks, and ends it if they wait for one another for ever."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from ranks import watch
from tether import environment, tethered

# Where the scripts are that tests launch
SCRIPTS = Path(__file__).parent
# Seconds for a script, or for the last part that it began by ``watch.begin``
LIMIT = 120.0
# Seconds after which all is killed in any case
LONGEST = 1800.0
# A few that hang are skipped, more are not waited for
_MOST = 3
# Whether this process has waited for all others
_ALONE = threading.Lock()
_LOCK = Path(tempfile.gettempdir()) / f"contactx-launch-{os.getuid()}.lock"


class Hang(AssertionError):
    """Ranks waited for one another until the watchdog came."""


class Failure(AssertionError):
    """The script ended with an error."""


def mpiexec() -> str:
    """Launcher of the MPI that this Python has; that of the path if it brings none."""
    own = Path(sys.executable).parent / "mpiexec"
    return str(own) if own.exists() else "mpiexec"


def launch(
    script: Path, ranks: int, *arguments: str, limit: float = LIMIT, longest: float = LONGEST
) -> str:
    """Run a script on some ranks, on one thread each, after any other launch on this machine.

    Args:
        script: The script; helpers of tests and demos can be imported in it.
        limit: Seconds after which it hangs, unless it begins parts with limits of their own.

    Raises:
        Hang: If ranks hang, with the stacks of all of them.
        Failure: If the script fails otherwise, with what it printed.
    """
    command = [mpiexec(), "-n", str(ranks), sys.executable, watch.__file__, str(limit)]
    with tempfile.TemporaryDirectory() as folder, alone():
        # The ranks end with the launcher. Ctrl-C is for this process, which ends the launcher
        process = subprocess.Popen(
            tethered([*command, str(script), *arguments]),
            env=environment() | _variables(ranks) | {watch.FOLDER: folder},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            printed, _ = process.communicate(timeout=longest)
        except subprocess.TimeoutExpired:
            process.kill()
            printed, _ = process.communicate()
            raise Hang(f"hang: {longest:g} s were too few\n{printed}") from None
        except BaseException:
            process.kill()
            process.wait()
            raise
        found = watch.stacks(folder)
        if watch.TIMED_OUT in found:
            raise Hang(f"hang of {ranks} ranks in {script.name}\n{found}\n{printed}")
        if process.returncode != 0:
            raise Failure(f"{script.name} on {ranks} ranks: {process.returncode}\n{printed}")
        return printed


def launch_together(
    script: Path, ranks: int, folder: Path, names: Sequence[str], file: Callable[[str], Path]
) -> dict[str, str]:
    """Run many parts in one launch, as a start costs seconds; one that hangs hides no other.

    The script takes a folder and names, and writes a file for each name in turn.

    Returns:
        What went wrong with those that have no file.
    """
    left, wrong = list(names), {}
    for _ in range(_MOST):
        try:
            launch(script, ranks, str(folder), *left)
            break
        except (Hang, Failure) as error:
            left = [name for name in left if not file(name).exists()]
            if left:
                wrong[left.pop(0)] = str(error)
            if not left:
                break
    missing = [name for name in left if not file(name).exists()]
    return wrong | dict.fromkeys(missing, "not run, or it wrote nothing")


def _variables(ranks: int) -> dict[str, str]:
    """Environment of the ranks, with what their MPI needs where they share cores."""
    # Open MPI refuses more ranks than cores unless it is told
    variables = {"PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
    if ranks > (os.cpu_count() or 1):
        # MPICH's ranks spin while they wait; this halves the time of four on two cores, where
        # MPIR_CVAR_POLLS_BEFORE_YIELD changes nothing and MPIR_CVAR_ENABLE_HEAVY_YIELD costs more
        variables["MPIR_CVAR_CH4_PROGRESS_THROTTLE"] = "1"
    return variables


@contextmanager
def alone() -> Iterator[None]:
    """Wait until no other launch is under way: two of them would share the cores.

    Those within the block of a process that has waited go on at once.
    """
    if _ALONE.locked():
        yield
        return
    with _ALONE, _LOCK.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield
