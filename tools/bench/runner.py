# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs each measurement in a process of its own, on one thread."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import importlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import contactx  # noqa: F401  # before any script here imports dolfinx

ROOT = Path(__file__).parents[2]
OUTPUT = ROOT / "build" / "bench"

# Scripts beside this one use the scenes of the tests and the demos
for _folder in ("tools", "demos", "tests", "tools/bench"):
    if str(ROOT / _folder) not in sys.path:
        sys.path.insert(0, str(ROOT / _folder))

from ranks.launch import Failure, Hang, launch  # noqa: E402
from tether import tethered  # noqa: E402


def alone(function: str, **job: Any) -> dict[str, Any]:
    """Call a function in a process of its own.

    Args:
        function: ``module:function`` of a module beside this one; it returns a dict.
        job: Arguments that JSON can carry.

    Returns:
        The job and what it returns; where it fails, the last line of the error as ``failed``.
    """
    run = subprocess.run(
        tethered([sys.executable, __file__, function, json.dumps(job)]),
        env={**os.environ, "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
    )
    if run.returncode != 0:
        lines = run.stderr.strip().splitlines() or [f"it ended with code {run.returncode}"]
        return {**job, "failed": lines[-1]}
    result: dict[str, Any] = json.loads(run.stdout.splitlines()[-1])
    return result


def on_ranks(function: str, ranks: int, limit: float = 600.0, **job: Any) -> dict[str, Any]:
    """Call a function as ``alone`` does, on some ranks; what rank 0 returns counts.

    Args:
        function: ``module:function`` of a module beside this one.
        ranks: Number of ranks.
        limit: Seconds after which it counts as a hang.
        job: Arguments that JSON can carry.
    """
    try:
        printed = launch(Path(__file__), ranks, function, json.dumps(job), limit=limit)
    except (Hang, Failure) as error:
        return {"ranks": ranks, **job, "failed": str(error)}
    results = [line for line in printed.splitlines() if line.startswith("{")]
    return {"ranks": ranks, **json.loads(results[-1])}


def here(function: str, **job: Any) -> dict[str, Any]:
    """Call a function as ``alone`` does, but in this process, and let its errors through."""
    module, name = function.split(":")
    result: dict[str, Any] = getattr(importlib.import_module(module), name)(**job)
    return {**job, **result}


class Meter:
    """Seconds and memory since it was made, which is when the mesh has been read."""

    def __init__(self) -> None:
        gc.collect()
        # What reading the mesh has freed must not serve what is measured for nothing
        ctypes.CDLL(None).malloc_trim(0)
        with contextlib.suppress(OSError):
            # The largest memory so far counts from here on
            Path("/proc/self/clear_refs").write_text("5")
        self._memory = memory("VmRSS")
        self._start = time.process_time()
        self._began = time.perf_counter()

    def read(self) -> dict[str, float]:
        """CPU and wall seconds, the largest memory, MB: above that of the start, and as it is."""
        peak = memory("VmHWM")
        return {
            "cpu": time.process_time() - self._start,
            "wall": time.perf_counter() - self._began,
            "memory": peak - self._memory,
            "peak": peak,
        }


def memory(name: str) -> float:
    """An entry of the process's status, MB; getrusage may give the parent's instead."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(name + ":"):
            return int(line.split()[1]) / 1024
    raise RuntimeError(f"/proc/self/status has no {name}: these benchmarks need Linux")


if __name__ == "__main__":
    from mpi4py import MPI

    returned = here(sys.argv[1], **json.loads(sys.argv[2]))
    if MPI.COMM_WORLD.rank == 0:
        print(json.dumps(returned), flush=True)
