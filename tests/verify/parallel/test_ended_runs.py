# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A run of the tests that is ended leaves no process behind: no worker, launcher or rank."""

import os
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

import pytest

from ranks.launch import SCRIPTS
from tether import TESTS


def processes(mark):
    """Command lines of the processes that have a mark in their environment."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if mark.encode() in (folder / "environ").read_bytes():
                found.append((folder / "cmdline").read_bytes().replace(b"\0", b" ").decode())
        except OSError:
            # It has ended, or is another user's
            continue
    return found


def wait_until(holds, seconds):
    """Wait for a condition, and say whether it came."""
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            return False
        time.sleep(0.1)
    return True


def all_run(lines):
    """Whether both ranks and the process of another kind have started."""
    ranks = [line for line in lines if line.endswith("hanging.py sleep ") and "-n 2" not in line]
    return len(ranks) == 2 and any("time.sleep(600)" in line for line in lines)


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_nothing_is_left(end):
    mark = f"CONTACTX_MARK={uuid.uuid4()}"
    name, value = mark.split("=")
    tests = [sys.executable, "-m", "pytest", "-n", "2", "-q", str(SCRIPTS / "endless.py")]
    run = subprocess.Popen(
        tests,
        cwd=TESTS.parent,
        env={**os.environ, name: value},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        assert wait_until(lambda: all_run(processes(mark)), 60), processes(mark)
        run.send_signal(end)
        assert wait_until(lambda: run.poll() is not None and not processes(mark), 30), processes(
            mark
        )
    finally:
        run.kill()
        run.wait()
