# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Several workers at once, each watched."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from stress.outcome import Kind, Outcome
from stress.scene import Scene
from tether import tethered

# Seconds for a scene
LIMIT = 600.0


def run_all(
    scenes: Sequence[Scene],
    numbers: Sequence[int],
    workers: int,
    done: Callable[[int, Outcome], None],
) -> None:
    """Run scenes.

    Args:
        scenes: All scenes.
        numbers: Those to run.
        workers: Number of processes.
        done: Called with each number and its outcome.
    """
    waiting: queue.SimpleQueue[int] = queue.SimpleQueue()
    for number in numbers:
        waiting.put(number)
    lock = threading.Lock()

    def work() -> None:
        worker = Worker()
        while True:
            try:
                number = waiting.get_nowait()
            except queue.Empty:
                break
            outcome = worker.ask(number, scenes[number])
            with lock:
                done(number, outcome)
        worker.end()

    threads = [threading.Thread(target=work) for _ in range(workers)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


class Worker:
    """A process that runs one scene after the other."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[str] | None = None
        self._errors = tempfile.TemporaryFile("w+")

    def ask(self, number: int, scene: Scene) -> Outcome:
        """Run a scene; one that ends its process is wrong."""
        if self._process is None:
            self._process = subprocess.Popen(
                tethered([sys.executable, str(Path(__file__).with_name("worker.py"))]),
                env={**os.environ, "OMP_NUM_THREADS": "1"},
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._errors,
                text=True,
            )
        process = self._process
        assert process.stdin is not None and process.stdout is not None
        watchdog = threading.Timer(LIMIT, process.kill)
        watchdog.start()
        print(number, file=process.stdin, flush=True)
        answer = process.stdout.readline()
        watchdog.cancel()
        if answer:
            return Outcome(**json.loads(answer))
        code = process.wait()
        self._process = None
        self._errors.seek(0)
        last = self._errors.read()[-500:]
        reason = f"the process ended with code {code} (killed after {LIMIT:g} s if -9): {last}"
        return Outcome(scene.family, scene.value, scene.variant, Kind.WRONG, reason)

    def end(self) -> None:
        """End the process."""
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()
            self._process.wait()
        self._errors.close()
