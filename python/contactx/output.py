# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Contact results as files: fields for ParaView, totals as a table."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

import basix
from contactx._host.checks import described, is_number
from contactx._host.files import WRITERS, check_path, make_folder
from contactx._host.parallel.reduce import agreed
from contactx.contact import Contact
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

    Of several contacts the fields have names or numbers behind theirs, and without these the
    largest pressure and status, and the smallest gap, of all. On several ranks all of them call it,
    and each writes a file of its part.
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
        self._suffixes = _suffixes(contacts)
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
        functions = [self._u, *self._fields, *self._merged()]
        for contact, suffix in zip(self._contacts, self._suffixes, strict=True):
            for name in ("pressure", "traction", "gap", "status"):
                function = getattr(contact, name)
                function.name = name + suffix
                functions.append(function)
        with agreed(self._comm):
            self._file.write(functions, float(t))

    def _merged(self) -> list[fem.Function]:
        """One pressure, gap and status of all contacts, where there are several."""
        if len(self._contacts) < 2:
            return []
        merged = []
        for name, larger in (("pressure", np.fmax), ("gap", np.fmin), ("status", np.fmax)):
            functions = [getattr(contact, name) for contact in self._contacts]
            function = fem.Function(functions[0].function_space, name=name)
            function.x.array[:] = larger.reduce([each.x.array for each in functions])
            merged.append(function)
        return merged

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


def _suffixes(contacts: Sequence[Contact]) -> list[str]:
    """What goes behind the names of fields and columns of each contact.

    Args:
        contacts: Contacts, of whose names some may be none.

    Raises:
        ValueError: If two have the same name.
    """
    names = [
        contact.name or (str(k) if len(contacts) > 1 else "") for k, contact in enumerate(contacts)
    ]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"contacts has several with the name {twice!r}: give each its own")
    return [f"_{name}" if name else "" for name in names]


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


class CSVOutput:
    """Writes the totals of contacts to a ``.csv`` file, a line for each time.

    Example::

        with cx.CSVOutput("totals.csv", [contact]) as totals:
            for step in cx.LoadSteps(problem, 10, update=update):
                totals.write(step.t)

    The columns are ``t`` and for each contact, with its name behind it, or its number where there
    are several: ``force_x``, ``force_y`` and ``force_z``, the force on the slave side; ``closed``
    and ``slipping``, numbers of slave nodes; ``area``, reference area of those closed;
    ``largest_pressure``; ``smallest_gap``, NaN where no node has a pair; and ``dissipation``, work
    of friction so far; then columns of one's own. Each line is in the file before ``write``
    returns. All ranks call it; rank 0 writes.
    """

    def __init__(
        self,
        path: str | Path,
        contacts: Sequence[Contact],
        *,
        columns: Mapping[str, Callable[[], float]] | None = None,
    ):
        """Open the file.

        Args:
            path: File with the suffix ``.csv``; one of this name is replaced. Its folder is made.
            contacts: Contacts of a ContactProblem.
            columns: Further columns: for each name a function without arguments, called on all
                ranks as a line is written, that returns the number of rank 0.

        Raises:
            OSError: If the folder or the file cannot be made.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, there are no contacts, or a column has the
                name of another one.
        """
        if isinstance(contacts, Contact) or not isinstance(contacts, Sequence):
            raise TypeError(
                f"contacts must be a list of contactx.Contact, not {type(contacts).__name__}"
            )
        for contact in contacts:
            if not isinstance(contact, Contact):
                raise TypeError(
                    f"contacts holds a {type(contact).__name__}: pass a list of contactx.Contact"
                )
        if len(contacts) == 0:
            raise ValueError("contacts is empty: pass at least one Contact")
        self._path = check_path("path", path)
        if self._path.suffix != ".csv":
            raise ValueError(
                f"path ends in {self._path.suffix!r}: totals are written to .csv, give such a name"
            )
        self._contacts = list(contacts)
        self._comm = contacts[0].discrete.halo.comm
        self._columns = dict(columns or {})
        suffixes = _suffixes(contacts)
        self._names = [
            name
            for contact, suffix in zip(contacts, suffixes, strict=True)
            for name in self._names_of(contact, suffix)
        ]
        for name, value in self._columns.items():
            if not callable(value):
                raise TypeError(
                    f"columns[{name!r}] is {described(value)}: give a function that returns a "
                    "number, such as a lambda"
                )
            if name in ("t", *self._names):
                raise ValueError(f"columns has {name!r}, as contacts have: give it another name")
        self._names += self._columns
        with agreed(self._comm):
            if self._comm.rank == 0:
                make_folder("path", self._path)
                self._append("w", ["t", *self._names])

    def __enter__(self) -> CSVOutput:
        """Use the output in a with statement; each line is whole anyhow."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Nothing is open between two lines."""

    def write(self, t: float) -> None:
        """Write a line of the current totals.

        Args:
            t: Time or load factor.

        Raises:
            OSError: If the file cannot be written, on all ranks.
            TypeError: If t is no number.
        """
        if not is_number(t):
            raise TypeError(f"t is {described(t)}: give a number")
        row = [float(t), *(value for contact in self._contacts for value in self._totals(contact))]
        row += [float(value()) for value in self._columns.values()]
        with agreed(self._comm):
            if self._comm.rank == 0:
                self._append("a", row)

    @staticmethod
    def _names_of(contact: Contact, suffix: str) -> list[str]:
        forces = [f"force_{axis}" for axis in "xyz"[: len(contact.force)]]
        others = ["closed", "slipping", "area", "largest_pressure", "smallest_gap", "dissipation"]
        return [name + suffix for name in (*forces, *others)]

    def _totals(self, contact: Contact) -> list[Any]:
        totals = contact.fields.totals()
        return [
            *contact.force.tolist(),
            totals.closed,
            totals.slipping,
            totals.area,
            totals.largest_pressure,
            totals.smallest_gap,
            totals.dissipation,
        ]

    def _append(self, mode: str, row: list[Any]) -> None:
        """Write a line; the file is closed after it, so that it has all lines at any time."""
        with open(self._path, mode, newline="", encoding="utf-8") as file:
            csv.writer(file).writerow(row)
