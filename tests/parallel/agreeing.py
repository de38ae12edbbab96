# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What all ranks do alike."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

WORLD = MPI.COMM_WORLD


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
