# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Paths of files to write, and files that DOLFINx writes functions to, by their suffixes."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mpi4py import MPI

from contactx._host.parallel.reduce import agreed
from dolfinx import fem, io


def check_path(name: str, path: Any) -> Path:
    """Check that a path is one.

    Args:
        name: Name of the argument.
        path: The path.

    Raises:
        TypeError: If it is none.
    """
    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"{name} is {path!r}: give the path of a file")
    return Path(path)


def make_folder(name: str, path: Path) -> None:
    """Make the folder of a file.

    Args:
        name: Name of the argument.
        path: The file.

    Raises:
        OSError: If it cannot be made.
        ValueError: If there is something else than a file at the path.
    """
    if path.is_dir():
        raise ValueError(f"{name} is the folder {path}: give the name of a file")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        there = path.exists()
    except OSError as error:
        text = f"cannot make the folder of {name} {path}: {error.strerror}"
        raise OSError(error.errno, text) from error
    if there and not path.is_file():
        raise ValueError(f"{name} {path} is no regular file: give another name")


class Writer(ABC):
    """A file, or several, of functions at increasing times; all ranks take part in all of it."""

    @abstractmethod
    def __init__(self, comm: MPI.Comm, path: Path):
        """Open the file.

        Args:
            comm: Communicator of the mesh.
            path: The file, in a folder that is there.
        """

    @abstractmethod
    def write(self, functions: Sequence[fem.Function], t: float) -> None:
        """Write functions.

        Args:
            functions: The same ones every time.
            t: Time.

        Raises:
            OSError: If a file is not whole after that.
        """

    @abstractmethod
    def close(self) -> None:
        """Close the file; nothing happens if it is closed.

        Raises:
            OSError: If it is not whole after that.
        """


class VTKWriter(Writer):
    """A collection of ParaView's, ``.pvd``, with a file of each rank and time beside it.

    The collection lists the times that all ranks have written whole, whenever the program is
    killed: it is replaced by a longer one that was written beside it.
    """

    def __init__(self, comm: MPI.Comm, path: Path):
        """Open the file; an older collection of its name goes, whose data are overwritten."""
        # DOLFINx writes once more when the file is destroyed, wherever the program has gone by then
        self._comm, self._path = comm, path.absolute()
        self._beside = self._path.with_suffix(".pvd~")
        self._count = 0
        with agreed(comm):
            if comm.rank == 0:
                self._path.unlink(missing_ok=True)
        self._file: io.VTKFile | None = io.VTKFile(comm, self._beside, "w")

    def write(self, functions: Sequence[fem.Function], t: float) -> None:
        """See ``Writer``."""
        assert self._file is not None
        stem, rank = self._path.stem, self._comm.rank
        with agreed(self._comm):
            self._file.write_function(functions, t)
            self._check_whole(f"{stem}_p{rank}_{self._count:06d}.vtu")
            if rank == 0:
                self._check_whole(f"{stem}{self._count:06d}.pvtu")
        self._count += 1
        if rank == 0:
            try:
                # This writes the collection, and the file stays open
                self._file.close()
            except RuntimeError as error:
                raise OSError(f"cannot write {self._path}: {error}") from error
            self._check_whole(self._beside.name)
            try:
                self._beside.replace(self._path)
            except OSError as error:
                text = f"cannot write {self._path}: {error.strerror}"
                raise OSError(error.errno, text) from error

    def close(self) -> None:
        """See ``Writer``."""
        self._file = None
        if self._comm.rank == 0:
            self._beside.unlink(missing_ok=True)

    def _check_whole(self, name: str) -> None:
        """Check that a file has its end: DOLFINx does not say if it could not be written."""
        path = self._path.with_name(name)
        try:
            with open(path, "rb") as file:
                file.seek(max(0, path.stat().st_size - 64))
                whole = file.read().rstrip().endswith(b"</VTKFile>")
        except OSError as error:
            raise OSError(error.errno, f"cannot write {path}: {error.strerror}") from error
        if not whole:
            raise OSError(f"cannot write {path} whole: is the disk full?")


class XDMFWriter(Writer):
    """A file ``.xdmf`` with its data in a file ``.h5`` beside it, for all ranks."""

    def __init__(self, comm: MPI.Comm, path: Path):
        """Open the file."""
        self._path, self._has_mesh = path, False
        self._file = io.XDMFFile(comm, path, "w")

    def write(self, functions: Sequence[fem.Function], t: float) -> None:
        """See ``Writer``."""
        try:
            if not self._has_mesh:
                self._file.write_mesh(functions[0].function_space.mesh)
                self._has_mesh = True
            for function in functions:
                self._file.write_function(function, t)
        except RuntimeError as error:
            raise OSError(f"cannot write {self._path}: {error}") from error

    def close(self) -> None:
        """See ``Writer``."""
        self._file.close()


class VTXWriter(Writer):
    """Folders of ADIOS2, ``_scalars.bp`` and ``_vectors.bp``: each holds functions of one space."""

    def __init__(self, comm: MPI.Comm, path: Path):
        """Take the path; the files are opened once the functions are known."""
        self._comm, self._path = comm, path
        self._files: list[io.VTXWriter] = []

    def write(self, functions: Sequence[fem.Function], t: float) -> None:
        """See ``Writer``."""
        try:
            if not self._files:
                kinds: dict[str, list[fem.Function]] = {"scalars": [], "vectors": []}
                for function in functions:
                    kinds["vectors" if function.ufl_shape else "scalars"].append(function)
                for kind, members in kinds.items():
                    if members:
                        path = self._path.with_name(f"{self._path.stem}_{kind}.bp")
                        self._files.append(io.VTXWriter(self._comm, path, members))
            for file in self._files:
                file.write(t)
        except RuntimeError as error:
            raise OSError(f"cannot write {self._path}: {error}") from error

    def close(self) -> None:
        """See ``Writer``."""
        for file in self._files:
            file.close()


WRITERS: dict[str, type[Writer]] = {".pvd": VTKWriter, ".xdmf": XDMFWriter, ".bp": VTXWriter}
