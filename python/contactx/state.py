# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""State of a problem: copied, put back, written.

``state_rows``, ``save_state`` and ``load_state`` are about what one contact takes from one step to
the next; ``Snapshot`` is the state of a whole problem in memory, to return to where a step fails.

Each rank has arrays of its own, and of each it is known what its rows stand for, so that they can
be brought to other ranks (``state_rows``): an owned slave node, an owned node of the bulk, or
nothing where an array is the same on all ranks. Behind those of owned nodes there may be rows of
others, which do not count. No number in them is a local one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from contactx.contact import Contact
from contactx.interface import Interface
from dolfinx import fem

# Meaning of the rows of a saved array: an owned slave node, an owned node of the bulk, or
# nothing where the array is the same on all ranks
type RowKind = Literal["slave", "node", "global"]

# State of the slave nodes that outlives a step, and what laws of vectors have as well
_NODAL = ("multiplier", "status", "gap", "immobile")
_VECTORS = ("normal", "slip", "mobile")
_HISTORY = ("slip", "total", "dissipation")


def state_rows(interface: Interface) -> dict[str, RowKind]:
    """Meaning of the rows of each array that ``save_state`` may give.

    Args:
        interface: Discrete side of the contact.

    Returns:
        Kinds by the names of the arrays.
    """
    history = () if interface.history is None else _HISTORY
    nodal = (*_nodal(interface), *(f"history_{name}" for name in history))
    kinds: dict[str, RowKind] = {"active": "global", **dict.fromkeys(nodal, "slave")}
    return kinds | {f"master_{name}": kind for name, kind in interface.master.saved_rows.items()}


def save_state(interface: Interface) -> dict[str, npt.NDArray[Any]]:
    """Copy all state that the next step depends on.

    Args:
        interface: Discrete side of the contact.

    Returns:
        Arrays of this rank by their names, with shapes and types that never change.
    """
    nodes = interface.nodes
    history = () if interface.history is None else _HISTORY
    n = len(nodes.status)
    shapes = {"multiplier": (n, nodes.size)}
    nodal = {name: getattr(nodes, name).copy() for name in _nodal(interface)}
    return {
        "active": np.array(interface.active),
        **{name: a.reshape(shapes.get(name, a.shape)) for name, a in nodal.items()},
        **{f"history_{name}": getattr(interface.history, name) for name in history},
        **{f"master_{name}": values for name, values in interface.master.save().items()},
    }


def load_state(interface: Interface, saved: Mapping[str, npt.NDArray[Any]]) -> None:
    """Go on from what ``save_state`` gave for the same contact; all ranks must take part.

    Args:
        interface: Discrete side of the contact.
        saved: Arrays of this rank by their names, of the same shapes and types.

    Raises:
        ValueError: If a pair is with a facet that does not exist; nothing has changed.
    """
    nodes = interface.nodes
    master = {n.removeprefix("master_"): a for n, a in saved.items() if n.startswith("master_")}
    interface.master.load(master)
    interface.active = bool(saved["active"])
    for name in _nodal(interface):
        values = getattr(nodes, name)
        values[:] = saved[name].reshape(values.shape)
    if interface.history is not None:
        interface.history.restore(*(saved[f"history_{name}"] for name in _HISTORY))
    interface.rebuild()


def _nodal(interface: Interface) -> tuple[str, ...]:
    return (*_NODAL, *_VECTORS) if interface.law.is_vector else _NODAL


class Snapshot:
    """Copy of displacement, contacts with their results, and history."""

    def __init__(
        self,
        u: fem.Function,
        contacts: Sequence[Contact],
        update_ghosts: Callable[[], None],
        history: Sequence[fem.Function] = (),
    ):
        """Copy the state.

        Args:
            u: Displacement.
            contacts: Contacts of its problem.
            update_ghosts: Gives ghosts the owners' displacements.
            history: Functions that belong to the state.
        """
        self._update_ghosts = update_ghosts
        self._contacts = [(c.interface, save_state(c.interface)) for c in contacts]
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
        self._update_ghosts()
        for interface, saved in self._contacts:
            load_state(interface, saved)
        for fields, attributes in self._fields:
            vars(fields).update(attributes)
