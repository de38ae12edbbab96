# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem in memory, to return to where a step fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from dolfinx import fem

if TYPE_CHECKING:
    from contactx.assembler import ContactAssembler


class FunctionValues:
    """Copy of the functions of a problem: what is solved for, and the contacts' results."""

    def __init__(self, assembler: ContactAssembler, history: Sequence[fem.Function] = ()):
        """Copy the values.

        Args:
            assembler: The coupled system.
            history: Further functions that belong to the state.
        """
        self._fields = [(c.fields, dict(vars(c.fields))) for c in assembler.contacts]
        results = [
            value
            for _, attributes in self._fields
            for value in attributes.values()
            if isinstance(value, fem.Function)
        ]
        functions = (assembler.u, *assembler.functions, *history, *results)
        self._functions = [(f, f.x.array.copy()) for f in functions]

    def restore(self) -> None:
        """Return to the values."""
        for function, values in self._functions:
            function.x.array[:] = values
        for fields, attributes in self._fields:
            vars(fields).update(attributes)


class Snapshot:
    """Copy of all state of a problem; see ``problem/snapshot.h`` for what the core copies."""

    def __init__(self, assembler: ContactAssembler, history: Sequence[fem.Function] = ()):
        """Copy the state.

        Args:
            assembler: The coupled system.
            history: Further functions that belong to the state.
        """
        self._core = assembler.core.snapshot()
        self._values = FunctionValues(assembler, history)

    def restore(self) -> None:
        """Return to the state, bit for bit; all ranks must take part."""
        self._values.restore()
        self._core.restore()
