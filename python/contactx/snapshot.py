# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem in memory, to return to where a step fails."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from contactx import saving
from contactx.contact import Contact
from dolfinx import fem


class Snapshot:
    """Copy of displacement, contacts with their results, and history."""

    def __init__(
        self,
        u: fem.Function,
        contacts: Sequence[Contact],
        refresh: Callable[[], None],
        history: Sequence[fem.Function] = (),
    ):
        """Copy the state.

        Args:
            u: Displacement.
            contacts: Contacts of its problem.
            refresh: Takes over a displacement that was set at owned nodes.
            history: Functions that belong to the state.
        """
        self._refresh = refresh
        self._contacts = [(c.interface, saving.save(c.interface)) for c in contacts]
        self._fields = [(c.fields, dict(vars(c.fields))) for c in contacts]
        results = [
            value
            for _, attributes in self._fields
            for value in attributes.values()
            if isinstance(value, fem.Function)
        ]
        self._functions = [(f, f.x.array.copy()) for f in (u, *history, *results)]

    def restore(self) -> None:
        """Return to the state, bit for bit; all ranks must take part."""
        for function, values in self._functions:
            function.x.array[:] = values
        self._refresh()
        for interface, saved in self._contacts:
            saving.load(interface, saved)
        for fields, attributes in self._fields:
            vars(fields).update(attributes)
