# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs scripts on several ranks; what hangs is killed and reported."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent


def run_ranks(script: str, ranks: int, *arguments: object, seconds: float = 200) -> str:
    """Run a script of this folder under mpiexec, and return what it printed.

    Args:
        script: Name of the file.
        ranks: Number of ranks.
        arguments: Arguments of the script.
        seconds: Time after which it counts as hung.

    Raises:
        AssertionError: If it fails or hangs.
    """
    launcher = Path(sys.executable).parent / "mpiexec"
    command = [str(launcher) if launcher.exists() else "mpiexec", "-n", str(ranks)]
    command += [sys.executable, str(HERE / script), *map(str, arguments)]
    folders = [HERE.parent, HERE.parent.parent / "demos", *sys.path]
    process = subprocess.Popen(
        command,
        env={
            **os.environ,
            "OMP_NUM_THREADS": "1",
            "PYTHONPATH": os.pathsep.join(map(str, folders)),
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        # The ranks, too, not only what launched them
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        raise AssertionError(f"hung for {seconds} s on {ranks} ranks:\n{output}") from None
    assert process.returncode == 0, output
    return output
