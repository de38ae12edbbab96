# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem in memory, to return to where a step fails."""

from __future__ import annotations

from collections.abc import Sequence

from contactx import cpp as core
from contactx._host.discrete_contact import Fields
from dolfinx import fem


class FunctionValues:
    """Copy of the functions of a problem: what is solved for, and the contacts' results."""

    def __init__(self, functions: Sequence[fem.Function], fields: Sequence[Fields] = ()):
        """Copy the values.

        Args:
            functions: Functions that belong to the state.
            fields: Results of the contacts.
        """
        self._fields = [(f, dict(vars(f))) for f in fields]
        results = [
            value
            for _, attributes in self._fields
            for value in attributes.values()
            if isinstance(value, fem.Function)
        ]
        self._functions = [(f, f.x.array.copy()) for f in (*functions, *results)]

    def restore(self) -> None:
        """Return to the values."""
        for function, values in self._functions:
            function.x.array[:] = values
        for fields, attributes in self._fields:
            vars(fields).update(attributes)


class Snapshot:
    """Copy of all state of a problem; see ``problem/snapshot.h`` for what the core copies."""

    def __init__(self, problem: core.Problem, values: FunctionValues):
        """Copy the state.

        Args:
            problem: Driver of the load steps.
            values: Copy of the functions.
        """
        self._core = problem.snapshot()
        self._values = values

    def restore(self) -> None:
        """Return to the state, bit for bit; all ranks must take part."""
        self._values.restore()
        self._core.restore()
