# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact results as files for ParaView."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

import basix
from contactx.arguments import described, is_number
from contactx.contact import Contact
from contactx.files import check_path, make_folder
from contactx.parallel.agreement import agreed
from contactx.writers import WRITERS
from dolfinx import fem


class VTKOutput:
    """Writes the displacement and the fields of contacts for ParaView, a set for each time.

    The suffix of the path says how: ``.pvd`` is VTK's format with a file of each rank and time,
    ``.xdmf`` one file with its data in ``.h5`` beside it, and ``.bp`` ADIOS2's for VTX, scalars and
    vectors in a folder each: ``name_scalars.bp`` and ``name_vectors.bp``.

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
            path: File with one of the suffixes; the data go into files beside it. Files of these
                names are replaced; the folder is made.
            u: Displacement.
            contacts: Contacts of a ContactProblem.
            fields: Other functions of linear Lagrange spaces to write, such as stresses.

        Raises:
            OSError: If the folder cannot be made, or the path is one.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, or a function is of another space.
        """
        _check_output(u, contacts, fields)
        path = check_path("path", path)
        if path.suffix not in WRITERS:
            raise ValueError(
                f"path ends in {path.suffix!r}: give one of {', '.join(WRITERS)}, ParaView's "
                "collections, XDMF and ADIOS2"
            )
        if "." in path.stem:
            raise ValueError(
                f"path has the name {path.name!r}: take the dots before the suffix out, or "
                "all times would be written to the same file"
            )
        self._comm = comm = u.function_space.mesh.comm
        with agreed(comm):
            if comm.rank == 0:
                make_folder("path", path)
        self._u = u
        self._contacts = list(contacts)
        self._fields = list(fields)
        self._path = path
        self._closed = False
        self._file = WRITERS[path.suffix](comm, path)

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
            self._closed = True
            with suppress(OSError):
                self._file.close()

    def write(self, t: float) -> None:
        """Write the current results.

        Args:
            t: Time or load factor.

        Raises:
            OSError: If a file is not whole after that, on all ranks.
            RuntimeError: If the output is closed.
            TypeError: If t is no number.
            ValueError: If t is not finite.
        """
        if self._closed:
            raise RuntimeError(f"the output {self._path} is closed: write before that")
        if not is_number(t):
            raise TypeError(f"t is {described(t)}: give a number")
        if not np.isfinite(t):
            raise ValueError(f"t is {t}: give a finite number")
        functions = [self._u, *self._fields]
        for k, contact in enumerate(self._contacts):
            # Several contacts have fields of the same names
            suffix = f"_{k}" if len(self._contacts) > 1 else ""
            for name in ("pressure", "traction", "gap", "status"):
                function = getattr(contact, name)
                function.name = name + suffix
                functions.append(function)
        with agreed(self._comm):
            self._file.write(functions, float(t))

    def close(self) -> None:
        """Close the file.

        Raises:
            OSError: If rank 0 cannot write the collection, on all ranks.
        """
        if self._closed:
            return
        self._closed = True
        with agreed(self._comm):
            self._file.close()


def _check_output(u: Any, contacts: Any, fields: Any) -> None:
    """Check what is to be written.

    Args:
        u: Displacement.
        contacts: Contacts.
        fields: Other functions.

    Raises:
        TypeError: If one is of another kind.
        ValueError: If a function is of another mesh, or not of a linear Lagrange space.
    """
    if not isinstance(u, fem.Function):
        raise TypeError(f"u must be a dolfinx.fem.Function, not {type(u).__name__}")
    for name, items, kind in (("contacts", contacts, Contact), ("fields", fields, fem.Function)):
        what = f"a list of {'contactx.Contact' if kind is Contact else 'fem.Function'}"
        if isinstance(items, kind) or not isinstance(items, Sequence):
            raise TypeError(f"{name} must be {what}, not {type(items).__name__}")
        for item in items:
            if not isinstance(item, kind):
                raise TypeError(f"{name} holds a {type(item).__name__}: pass {what}")
    functions = {f"fields[{k}]": f for k, f in enumerate(fields)}
    functions |= {f"contacts[{k}]": contact.pressure for k, contact in enumerate(contacts)}
    for name, function in functions.items():
        V = function.function_space
        if V.mesh is not u.function_space.mesh:
            raise ValueError(f"{name} is on another mesh than u: give one of the same mesh")
        element, degree = V.ufl_element(), u.function_space.ufl_element().degree
        if (element.element_family, element.degree) != (basix.ElementFamily.P, degree) or (
            element.discontinuous
        ):
            raise ValueError(
                f"{name} is of {element}: interpolate it into a Lagrange space of u's degree, "
                f'functionspace(mesh, ("Lagrange", {degree}))'
            )
