# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes that Dirichlet conditions hold inside a rigid obstacle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.checks.place import place
from contactx.interface import Interface
from contactx.master.obstacle import ObstacleMaster
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo


def check_over_constrained(
    interfaces: Sequence[Interface],
    names: Sequence[Any],
    prescribed: npt.NDArray[np.float64],
    halo: Halo,
) -> None:
    """Check that no slave node is held inside a rigid obstacle.

    Args:
        interfaces: Discrete sides of the contacts.
        names: The contacts, for the message.
        prescribed: Displacement with the Dirichlet values, shape (num_dofs,).
        halo: Nodes on this rank.

    Raises:
        ValueError: If one of any rank is held inside, on all ranks.
    """
    for k, interface in enumerate(interfaces):
        bad = _held_inside(interface, prescribed, halo)
        count = reduce.total(halo.comm, len(bad))
        if count > 0 and interface.active:
            numbers = halo.original[bad].tolist()
            size = reduce.extent(halo.comm, halo.x[interface.slaves]).max()
            first, at = reduce.first(
                halo.comm, numbers, list(zip(numbers, halo.x[bad], strict=True))
            )
            raise ValueError(
                f"contact {k} ({names[k]}) is over-constrained: Dirichlet conditions hold "
                f"{count} slave nodes inside the rigid obstacle, first node {first} of the mesh as "
                f"it was made, at {place(at, size)}. Take these nodes out of the slave surface, "
                "release them along the obstacle's normal or prescribe values outside of it"
            )


def _held_inside(
    interface: Interface, prescribed: npt.NDArray[np.float64], halo: Halo
) -> npt.NDArray[np.int32]:
    """Slave nodes of this rank held inside, numbered as the blocks of the displacement's dofmap."""
    master = interface.master
    if not isinstance(master, ObstacleMaster) or interface.law.is_tied:
        return np.array([], dtype=np.int32)
    x = halo.x[: halo.num_bulk] + prescribed.reshape(-1, halo.gdim)
    with agreed(halo.comm):
        gap = master.inside(x) - interface.offset()
    size = reduce.extent(halo.comm, x[interface.slaves]).max()
    inside: npt.NDArray[np.int32] = interface.slaves[
        interface.nodes.immobile & (gap < -1e-9 * size)
    ]
    return inside
