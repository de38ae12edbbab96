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
import ufl
from contactx._host.checks import described, is_number
from contactx._host.files import WRITERS, check_path, make_folder
from contactx._host.parallel.reduce import agreed
from contactx._host.projection import Projection
from contactx.contact import Contact
from dolfinx import fem

# Fields of a contact
_RESULTS = ("pressure", "traction", "gap", "status")


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
        fields: Sequence[fem.Function | Projection] | Mapping[str, ufl.core.expr.Expr] = (),
    ):
        """Open the file.

        Args:
            path: File with one of the suffixes; the data go into files beside it. Files of these
                names are replaced; the folder is made.
            u: Displacement.
            contacts: Contacts of a ContactProblem.
            fields: What else to write: functions of Lagrange spaces of u's degree, or constant in
                each cell, and projections. Or, by their names, also expressions such as stresses
                and functions of quadrature spaces, which are projected on u's nodes at each write.

        Raises:
            OSError: If the folder cannot be made, or the path is one.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, a function is of another space, or a name is
                that of a result.
        """
        _check_output(u, contacts)
        self._suffixes = _suffixes(contacts)
        results = {name + suffix for suffix in ("", *self._suffixes) for name in _RESULTS}
        self._fields = _named(fields, u, results if contacts else set())
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
        functions = [self._u]
        for name, field in self._fields:
            function = field.update() if isinstance(field, Projection) else field
            function.name = name
            functions.append(function)
        functions += self._merged()
        for contact, suffix in zip(self._contacts, self._suffixes, strict=True):
            for name in _RESULTS:
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


def _check_output(u: Any, contacts: Any) -> None:
    """Check whose results are to be written.

    Args:
        u: Displacement.
        contacts: Contacts.

    Raises:
        TypeError: If one is of another kind.
        ValueError: If a contact is of another mesh or degree.
    """
    if not isinstance(u, fem.Function):
        raise TypeError(f"u must be a dolfinx.fem.Function, not {type(u).__name__}")
    what = "a list of contactx.Contact"
    if isinstance(contacts, Contact) or not isinstance(contacts, Sequence):
        raise TypeError(f"contacts must be {what}, not {type(contacts).__name__}")
    for k, contact in enumerate(contacts):
        if not isinstance(contact, Contact):
            raise TypeError(f"contacts holds a {type(contact).__name__}: pass {what}")
        _check_space(f"contacts[{k}]", contact.pressure, u)


def _named(
    fields: Any, u: fem.Function, results: set[str]
) -> list[tuple[str, fem.Function | Projection]]:
    """Names of what is to be written beside the results, and what it is.

    Args:
        fields: Functions and projections, or these and expressions by their names.
        u: Displacement.
        results: Names that results have.

    Raises:
        TypeError: If one is of another kind.
        ValueError: If one is of another mesh or space, or has the name of a result.
    """
    if isinstance(fields, ufl.core.expr.Expr | str) or not isinstance(fields, Mapping | Sequence):
        raise TypeError(
            f"fields is {described(fields)}: give a list of fem.Function and contactx.Projection, "
            'or a dictionary, {"mises": expression}'
        )
    by_name = isinstance(fields, Mapping)
    pairs: Any = fields.items() if isinstance(fields, Mapping) else enumerate(fields)
    domain, degree = u.function_space.mesh, u.function_space.ufl_element().degree
    named = []
    for key, field in pairs:
        what = f"fields[{key!r}]"
        if by_name and (not isinstance(key, str) or key in results):
            raise ValueError(f"fields has the name {key!r}: give a text that no result has")
        function: Any = field.function if isinstance(field, Projection) else field
        is_nodal = isinstance(function, fem.Function) and not (
            by_name and function.function_space.ufl_element().has_custom_quadrature
        )
        if is_nodal:
            _check_space(what, function, u)
        elif by_name and isinstance(function, ufl.core.expr.Expr):
            V = fem.functionspace(domain, ("Lagrange", degree, function.ufl_shape))
            field = Projection(function, V)
        else:
            raise TypeError(
                f"{what} is {described(field)}: give a fem.Function or contactx.Projection, and "
                'expressions by their names, {"mises": expression}'
            )
        named.append((key if by_name else function.name, field))
    return named


def _check_space(name: str, function: fem.Function, u: fem.Function) -> None:
    """Check that a function is on u's nodes, or constant in each cell.

    Raises:
        ValueError: If it is not.
    """
    V = function.function_space
    if V.mesh is not u.function_space.mesh:
        raise ValueError(f"{name} is on another mesh than u: give one of the same mesh")
    element, degree = V.ufl_element(), u.function_space.ufl_element().degree
    is_nodal = (element.degree, element.discontinuous) == (degree, False)
    if element.element_family != basix.ElementFamily.P or not (is_nodal or element.degree == 0):
        raise ValueError(
            f"{name} is of {element}: interpolate or project it into a Lagrange space of u's "
            f'degree, functionspace(mesh, ("Lagrange", {degree})), or of cells, ("DG", 0)'
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
            TypeError: If t, or what a function of ``columns`` returns, is no number.
            Exception: What a function of ``columns`` raises, on all ranks.
        """
        row = [value for contact in self._contacts for value in self._totals(contact)]
        with agreed(self._comm):
            if not is_number(t):
                raise TypeError(f"t is {described(t)}: give a number")
            for name, function in self._columns.items():
                value = function()
                if np.ndim(value) > 0:
                    raise TypeError(
                        f"columns[{name!r}] returns an array of shape {np.shape(value)}: let it "
                        "return a number"
                    )
                row.append(float(value))
            if self._comm.rank == 0:
                self._append("a", [float(t), *row])

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
