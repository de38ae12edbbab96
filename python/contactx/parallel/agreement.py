# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Errors that all ranks raise."""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from contextlib import contextmanager

from mpi4py import MPI


@contextmanager
def agreed(comm: MPI.Comm) -> Iterator[None]:
    """Raise an error of any rank on all of them, so that none waits for another one for ever.

    All ranks must come by, and nothing inside may be collective.

    Args:
        comm: Communicator.

    Raises:
        BaseException: What was raised inside, on the lowest of the ranks that raised.
    """
    if comm.size == 1:
        yield
        return
    error: BaseException | None = None
    try:
        yield
    except BaseException as raised:
        error = raised
    first = comm.allreduce(comm.size if error is None else comm.rank, MPI.MIN)
    if first == comm.size:
        return
    packed = comm.bcast(_packed(error) if comm.rank == first else None, root=first)
    if comm.rank == first:
        assert error is not None
        raise error
    theirs: BaseException = pickle.loads(packed)
    theirs.add_note(f"raised on rank {first}")
    raise theirs


def _packed(error: BaseException | None) -> bytes:
    """An error as bytes; of one that has no copy its text."""
    try:
        packed = pickle.dumps(error)
        pickle.loads(packed)
    except Exception:
        return pickle.dumps(RuntimeError(f"{type(error).__name__}: {error}"))
    return packed
