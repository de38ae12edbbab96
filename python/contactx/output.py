# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact results as files for ParaView."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

from contactx.contact import Contact
from contactx.parallel.agreement import agreed
from dolfinx import fem, io


class VTKOutput:
    """Writes the displacement and the fields of contacts, one set a time, as a ``.pvd`` file.

    Example::

        with cx.VTKOutput("hertz.pvd", u, [contact]) as output:
            problem.solve()
            output.write(0.0)

    On several ranks all of them call it, and each writes a file of its part.
    """

    def __init__(
        self,
        path: str | Path,
        u: fem.Function,
        contacts: Sequence[Contact],
        *,
        fields: Sequence[fem.Function] = (),
    ):
        """Open the file.

        Args:
            path: File with the suffix ``.pvd``; the data go into files beside it. Its folder is
                made.
            u: Displacement.
            contacts: Contacts of a ContactProblem.
            fields: Other functions of linear Lagrange spaces to write, such as stresses.

        Raises:
            OSError: If the folder cannot be made.
            ValueError: If the suffix is another one.
        """
        path = Path(path)
        if path.suffix != ".pvd":
            raise ValueError(f"path ends in {path.suffix!r}: ParaView's collections end in .pvd")
        self._comm = comm = u.function_space.mesh.comm
        with agreed(comm):
            if comm.rank == 0:
                path.parent.mkdir(parents=True, exist_ok=True)
        self._u = u
        self._contacts = list(contacts)
        self._fields = list(fields)
        self._file = io.VTKFile(comm, path, "w")

    def __enter__(self) -> VTKOutput:
        """Use the output in a with statement."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""
        if error is None:
            self.close()
        else:
            # Other ranks may not come by
            self._file.close()

    def write(self, t: float) -> None:
        """Write the current results.

        Args:
            t: Time or load factor.
        """
        functions = [self._u, *self._fields]
        for k, contact in enumerate(self._contacts):
            # Several contacts have fields of the same names
            suffix = f"_{k}" if len(self._contacts) > 1 else ""
            for name in ("pressure", "traction", "gap", "status"):
                function = getattr(contact, name)
                function.name = name + suffix
                functions.append(function)
        self._file.write_function(functions, t)

    def close(self) -> None:
        """Close the file.

        Raises:
            RuntimeError: If rank 0 cannot write the collection.
        """
        with agreed(self._comm):
            self._file.close()
