# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Totals of contacts as a table in a file."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from contactx.arguments import described, is_number
from contactx.contact import Contact
from contactx.files import check_path, make_folder
from contactx.parallel.agreement import agreed


class CSVOutput:
    """Writes the totals of contacts to a ``.csv`` file, a line for each time.

    Example::

        with cx.CSVOutput("totals.csv", [contact]) as totals:
            for step in cx.LoadSteps(problem, 10, update=update):
                totals.write(step.t)

    The columns are ``t`` and for each contact, with its number behind the name where there are
    several: ``force_x``, ``force_y`` and ``force_z``, the force on the slave side; ``closed`` and
    ``slipping``, numbers of slave nodes; ``area``, reference area of those closed;
    ``largest_pressure``; ``smallest_gap``, NaN where no node has a pair; and ``dissipation``, work
    of friction so far. Each line is in the file before ``write`` returns. All ranks call it; rank 0
    writes.
    """

    def __init__(self, path: str | Path, contacts: Sequence[Contact]):
        """Open the file.

        Args:
            path: File with the suffix ``.csv``; one of this name is replaced. Its folder is made.
            contacts: Contacts of a ContactProblem.

        Raises:
            OSError: If the folder or the file cannot be made.
            TypeError: If an argument is of another kind.
            ValueError: If the suffix is another one, or there are no contacts.
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
        self._comm = contacts[0].interface.halo.comm
        self._names = [name for k in range(len(contacts)) for name in self._columns(k)]
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
        with agreed(self._comm):
            if self._comm.rank == 0:
                self._append("a", row)

    def _columns(self, k: int) -> list[str]:
        suffix = f"_{k}" if len(self._contacts) > 1 else ""
        forces = [f"force_{axis}" for axis in "xyz"[: len(self._contacts[k].force)]]
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
