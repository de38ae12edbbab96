# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a contact takes from one step to the next: copied, and put back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface

# State of the slave nodes that outlives a step
_NODAL = ("multiplier", "status", "gap", "normal", "slip", "immobile", "mobile")


def save(interface: Interface) -> dict[str, npt.NDArray[Any]]:
    """Copy of all that the next step depends on.

    Args:
        interface: Discrete side of the contact.

    Returns:
        Arrays by their names, with shapes and types that never change.
    """
    history = {} if interface.history is None else vars(interface.history)
    return {
        "active": np.array(interface.active),
        **{name: getattr(interface.nodes, name).copy() for name in _NODAL},
        **{f"history_{name}": values.copy() for name, values in history.items()},
        **{f"master_{name}": values for name, values in interface.master.save().items()},
    }


def load(interface: Interface, saved: Mapping[str, npt.NDArray[Any]]) -> None:
    """Go on from what ``save`` gave for the same contact.

    Args:
        interface: Discrete side of the contact.
        saved: Arrays by their names, of the same shapes and types.

    Raises:
        ValueError: If a pair is with a facet that does not exist; nothing has changed.
    """
    interface.master.load({name.removeprefix("master_"): saved[name] for name in saved})
    interface.active = bool(saved["active"])
    for name in _NODAL:
        getattr(interface.nodes, name)[:] = saved[name]
    if interface.history is not None:
        for name in vars(interface.history):
            setattr(interface.history, name, saved[f"history_{name}"].copy())
    interface.begin_anew()
