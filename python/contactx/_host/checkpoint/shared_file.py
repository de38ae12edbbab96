# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A file that all ranks write or read at once, and that is whole or not there.

By MPI itself: of the wheels beside DOLFINx's, h5py has no parallel HDF5, and adios2 no MPI.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx._host.parallel.reduce import agreed

# What MPICH says before it says why
_PREFIX = "Other I/O error "

type Bytes = npt.NDArray[np.uint8]


class SharedFile:
    """A file that all ranks have open, as ``storage/archive.h`` of the core describes it."""

    def __init__(self, comm: MPI.Intracomm, path: Path, mode: int):
        """Open a file; all ranks must take part in this and all else.

        Args:
            comm: Communicator.
            path: The file.
            mode: MPI's mode.

        Raises:
            OSError: If a rank cannot open it, on all of them.
        """
        self._comm = comm
        self._do(self._open, path, mode)

    def size(self) -> int:
        """Number of bytes."""
        return int(self._file.Get_size())

    def write(self, at: int, values: Bytes) -> None:
        """Write bytes, on each rank its own, or none.

        Args:
            at: Place of the first one.
            values: The bytes.

        Raises:
            OSError: If a rank could not, on all of them.
        """
        self._do(self._file.Write_at_all, at, values)

    def read(self, at: int, values: Bytes) -> None:
        """Read bytes, on each rank its own, or none.

        Args:
            at: Place of the first one.
            values: What takes the bytes.

        Raises:
            OSError: If a rank could not, on all of them.
        """
        self._do(self._file.Read_at_all, at, values)

    def sync(self) -> None:
        """Bring to the disk what was written."""
        self._do(self._file.Sync)

    def close(self) -> None:
        """Close it."""
        self._file.Close()

    def _open(self, path: Path, mode: int) -> None:
        self._file = MPI.File.Open(self._comm, path, mode)

    def _do(self, work: Any, *arguments: Any) -> None:
        with agreed(self._comm):
            # Collective: also a rank that fails has taken part
            try:
                work(*arguments)
            except MPI.Exception as error:
                text = str(error).rsplit(": ", 1)[-1].removeprefix(_PREFIX)
                raise OSError(errno.EIO, text) from error


@contextmanager
def replaced(comm: MPI.Intracomm, path: Path) -> Iterator[SharedFile]:
    """A new, empty file, which takes the place of the old one once it is whole.

    Args:
        comm: Communicator, all ranks of which take part.
        path: The file.

    Raises:
        OSError: If it cannot be written; the old file is still there.
    """
    temporary = path.with_name(f"{path.name}.tmp")
    try:
        with agreed(comm):
            # Where MPI cannot open a file it does not say why
            if comm.rank == 0:
                open(temporary, "wb").close()
        file = SharedFile(comm, temporary, MPI.MODE_CREATE | MPI.MODE_WRONLY)
        try:
            yield file
            file.sync()
        finally:
            file.close()
        with agreed(comm):
            if comm.rank == 0:
                os.replace(temporary, path)
    except BaseException as error:
        if comm.rank == 0:
            with suppress(OSError):
                temporary.unlink(missing_ok=True)
        if not isinstance(error, OSError):
            raise
        raise OSError(
            error.errno,
            f"cannot write the checkpoint {path}: {error.strerror or error}; an older file of this "
            "name is as it was",
        ) from error


@contextmanager
def opened(comm: MPI.Intracomm, path: Path) -> Iterator[SharedFile]:
    """A file to read.

    Args:
        comm: Communicator, all ranks of which take part.
        path: The file.

    Raises:
        FileNotFoundError: If there is no such file.
        OSError: If it cannot be read.
        ValueError: If it is a folder.
    """
    with agreed(comm):
        if comm.rank == 0:
            if path.is_dir():
                raise ValueError("it is a folder, not a checkpoint: give the name of a file")
            if not path.is_file():
                raise FileNotFoundError(
                    f"there is no checkpoint {path}. Give another file, or leave restart out "
                    "(manual: errors/restart-refused)"
                )
    try:
        with agreed(comm):
            # Where MPI cannot open a file it does not say why
            if comm.rank == 0:
                open(path, "rb").close()
        file = SharedFile(comm, path, MPI.MODE_RDONLY)
    except OSError as error:
        text = f"cannot read the checkpoint {path}: {error.strerror or error}"
        raise OSError(error.errno, text) from error
    try:
        yield file
    finally:
        file.close()
