# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reductions over the ranks: numbers with the same result on each, and errors that all raise."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from operator import itemgetter
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt


def total(comm: MPI.Comm, value: npt.ArrayLike) -> Any:
    """Sum of a number, or of arrays of one shape, over the ranks."""
    return _reduced(comm, value, MPI.SUM)


def largest(comm: MPI.Comm, value: npt.ArrayLike) -> Any:
    """Largest of a number, or of arrays of one shape, over the ranks."""
    return _reduced(comm, value, MPI.MAX)


def least(comm: MPI.Comm, value: npt.ArrayLike) -> Any:
    """Smallest of a number, or of arrays of one shape, over the ranks."""
    return _reduced(comm, value, MPI.MIN)


def anywhere(comm: MPI.Comm, value: bool | np.bool_) -> bool:
    """True on all ranks if a condition holds on any of them."""
    return bool(_reduced(comm, int(value), MPI.MAX))


def everywhere(comm: MPI.Comm, value: bool | np.bool_) -> bool:
    """True on all ranks if a condition holds on all of them."""
    return bool(_reduced(comm, int(value), MPI.MIN))


def norm(comm: MPI.Comm, *parts: npt.NDArray[np.float64]) -> float:
    """Euclidean norm of arrays that each rank has a part of."""
    return float(np.sqrt(total(comm, float(sum(np.dot(part, part) for part in parts)))))


def extent(comm: MPI.Comm, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Size of the box around points that each rank has some of; zero where there are none.

    Args:
        comm: Communicator.
        x: Points of this rank, shape (n, gdim).

    Returns:
        Lengths, shape (gdim,).
    """
    low, high = x.min(axis=0, initial=np.inf), x.max(axis=0, initial=-np.inf)
    corners = largest(comm, np.stack([-low, high]))
    size: npt.NDArray[np.float64] = np.maximum(corners.sum(axis=0), 0.0)
    return size


def first(comm: MPI.Comm, keys: Sequence[Any], items: Sequence[Any]) -> Any:
    """The item with the smallest key on any rank.

    Args:
        comm: Communicator.
        keys: Keys of this rank's items, which can be compared; some rank has one.
        items: Items of this rank.
    """
    mine = min(zip(keys, items, strict=True), key=itemgetter(0), default=None)
    found = [pair for pair in comm.allgather(mine) if pair is not None]
    return min(found, key=itemgetter(0))[1]


def _reduced(comm: MPI.Comm, value: npt.ArrayLike, op: MPI.Op) -> Any:
    if comm.size == 1:
        return value
    mine = np.ascontiguousarray(value)
    theirs = np.empty_like(mine)
    comm.Allreduce(mine, theirs, op=op)
    return theirs if np.ndim(value) > 0 else theirs.item()


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
