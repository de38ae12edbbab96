# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How rigid motions of the bodies move slave nodes relative to their masters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from contactx.bodies.modes import Array, RigidModes
from contactx.interface import Interface


@dataclass(frozen=True)
class ContactRows:
    """Slave nodes of this rank with a pair under rigid motions.

    Attributes:
        slaves: Slave nodes by their number in the contact, shape (k,).
        normal: Unit normals, shape (k, gdim).
        movement: Relative movement of the slave node by each mode of each body, shape
            (k, gdim, num_bodies * m).
    """

    slaves: npt.NDArray[np.integer]
    normal: Array
    movement: Array


def along(normal: Array, vectors: Array) -> Array:
    """Parts of vectors along the surface, shape (n, gdim)."""
    along: Array = vectors - np.einsum("pi,pi->p", normal, vectors)[:, None] * normal
    return along


def contact_rows(interface: Interface, modes: RigidModes, x: Array) -> ContactRows:
    """Slave nodes of this rank under rigid motions of the bodies; their masters may be elsewhere.

    Args:
        interface: Discrete side of the contact.
        modes: Rigid modes of the bodies.
        x: Positions of all nodes, shape (num_nodes, gdim).
    """
    gdim = x.shape[1]
    master = interface.master
    slaves = np.flatnonzero(master.paired)
    place = np.full(len(master.paired), -1)
    place[slaves] = np.arange(len(slaves))
    weights = master.weights()
    some = place[weights.slaves] >= 0
    row, node = place[weights.slaves[some]], weights.nodes[some]
    size = gdim * (gdim + 1) // 2
    movement = np.zeros((len(slaves), modes.count, gdim, size))
    field = weights.values[some, None, None] * modes.at(node, x)
    np.add.at(movement, (row, modes.body[node]), field)
    movement = movement.transpose(0, 2, 1, 3).reshape(len(slaves), gdim, modes.count * size)
    return ContactRows(slaves, master.normals()[slaves, :gdim], movement)
