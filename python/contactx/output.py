# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact results as files for ParaView."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import TracebackType

from contactx.contact import Contact
from dolfinx import fem, io


class VTKOutput:
    """Writes the displacement and the fields of contacts, one set a time, as a ``.pvd`` file.

    Example::

        with cx.VTKOutput("hertz.pvd", u, [contact]) as output:
            problem.solve()
            output.write(0.0)
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
            path: File with the suffix ``.pvd``; the data go into files beside it.
            u: Displacement.
            contacts: Contacts of a ContactProblem.
            fields: Other functions of linear Lagrange spaces to write, such as stresses.

        Raises:
            ValueError: If the suffix is another one.
        """
        path = Path(path)
        if path.suffix != ".pvd":
            raise ValueError(f"path ends in {path.suffix!r}: ParaView's collections end in .pvd")
        path.parent.mkdir(parents=True, exist_ok=True)
        self._u = u
        self._contacts = list(contacts)
        self._fields = list(fields)
        self._file = io.VTKFile(u.function_space.mesh.comm, path, "w")

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
        self.close()

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
        """Close the file."""
        self._file.close()
