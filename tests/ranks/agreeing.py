# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What all ranks do alike, and some of them by themselves."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from mpi4py import MPI

WORLD = MPI.COMM_WORLD
_SOME: dict[int, MPI.Comm] = {}


def some_ranks(size: int) -> MPI.Comm | None:
    """Communicator of the first so many ranks; None on the others."""
    if not _SOME:
        for n in range(1, WORLD.size + 1):
            _SOME[n] = WORLD.Split(0 if WORLD.rank < n else 1)
    return _SOME[size] if WORLD.rank < size else None


def wait() -> None:
    """Wait for all ranks without keeping a core busy, which others may need."""
    barrier = WORLD.Ibarrier()
    while not barrier.Test():
        time.sleep(0.005)


def refused(kind: type[BaseException], message: str, call: Callable[[], Any]) -> None:
    """Check that all ranks raise the same."""
    try:
        call()
    except BaseException as error:
        found = [type(error).__name__, str(error).splitlines()[0]]
    else:
        found = ["nothing", ""]
    every = WORLD.allgather(found)
    assert all(f == every[0] for f in every), every
    assert found[0] == kind.__name__ and message in found[1], (found, message)
    if WORLD.rank == 0:
        print(f"all ranks: {kind.__name__}: {message}", flush=True)
