# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A hang is found, told and ended; a run that is ended leaves no process behind."""

import os
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path

import pytest

from ranks.launch import SCRIPTS, Failure, Hang, launch
from tether import TESTS

SCRIPT = SCRIPTS / "hanging.py"


def test_a_hang_is_told_and_ended():
    start = time.perf_counter()
    with pytest.raises(Hang, match="hang of 2 ranks") as info:
        launch(SCRIPT, 2, "hang")
    assert time.perf_counter() - start < 30
    text = str(info.value)
    for rank in (0, 1):
        assert f"rank {rank} in a barrier" in text
    assert text.count("Timeout (") == 2
    assert text.count('hanging.py", line') == 2


def test_an_error_is_told():
    with pytest.raises(Failure, match="it has failed"):
        launch(SCRIPT, 2, "fail")


def test_a_script_that_ends():
    assert launch(SCRIPT, 2, "end").count("came to the end") == 2


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
