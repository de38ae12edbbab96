# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes that Dirichlet conditions hold inside a rigid obstacle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface
from contactx.master.obstacle import ObstacleMaster


def check_over_constrained(
    interfaces: Sequence[Interface], names: Sequence[Any], prescribed: npt.NDArray[np.float64]
) -> None:
    """Check that no slave node is held inside a rigid obstacle.

    Args:
        interfaces: Discrete sides of the contacts.
        names: The contacts, for the message.
        prescribed: Displacement with the Dirichlet values, shape (num_dofs,).

    Raises:
        ValueError: If one is held inside.
    """
    for k, interface in enumerate(interfaces):
        bad = _held_inside(interface, prescribed)
        if len(bad) > 0 and interface.active:
            raise ValueError(
                f"contact {k} ({names[k]}) is over-constrained: Dirichlet conditions hold "
                f"{len(bad)} slave nodes inside the rigid obstacle, first node {bad[0]}. Take "
                "these nodes out of the slave surface, release them along the obstacle's normal "
                "or prescribe values outside of it"
            )


def _held_inside(
    interface: Interface, prescribed: npt.NDArray[np.float64]
) -> npt.NDArray[np.int32]:
    """Slave nodes held inside, numbered as the blocks of the displacement's dofmap."""
    master = interface.master
    if not isinstance(master, ObstacleMaster) or interface.law.is_tied:
        return np.array([], dtype=np.int32)
    position = interface.state.position
    x = (position.array + prescribed).reshape(-1, position.block_size)
    gap = master.inside(x) - interface.offset()
    size = np.ptp(x[interface.slaves], axis=0).max(initial=0.0)
    inside: npt.NDArray[np.int32] = interface.slaves[
        interface.nodes.immobile & (gap < -1e-9 * size)
    ]
    return inside
