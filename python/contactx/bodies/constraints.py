# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What rigid motions of the bodies do to pairs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from contactx import cpp as core
from contactx.bodies.modes import Array, RigidModes
from contactx.forms import Pairs
from contactx.interface import Interface


@dataclass(frozen=True)
class PairRows:
    """Pairs under rigid motions.

    Attributes:
        normal: Unit normals, shape (num_pairs, gdim).
        movement: Relative movement of the slave node by each mode of each body, shape
            (num_pairs, gdim, num_bodies * m).
    """

    normal: Array
    movement: Array


def pair_rows(
    interface: Interface, modes: RigidModes, x: Array
) -> Iterator[tuple[Pairs, PairRows]]:
    """Pairs of a contact under rigid motions of the bodies.

    Args:
        interface: Discrete side of the contact.
        modes: Rigid modes of the bodies.
        x: Positions of all nodes, shape (num_nodes, gdim).

    Yields:
        Pairs of one kind of facet, and what rigid motions do to them.
    """
    gdim = x.shape[1]
    for pairs in interface.master.pairs():
        num_pairs, width = pairs.nodes.shape
        weight = np.ones((num_pairs, width))
        if width > 1:
            at = core.pair_layout["xi"]
            xi = np.ascontiguousarray(pairs.data[:, at : at + 2])
            weight[:, 1:] = -core.shape_functions(width - 1, xi)
        size = gdim * (gdim + 1) // 2
        movement = np.zeros((num_pairs, gdim, modes.count, size))
        pair = np.arange(num_pairs)
        for a in range(width):
            node = pairs.nodes[:, a]
            field = weight[:, a, None, None] * modes.at(node, x)
            movement[pair, :, modes.body[node]] += field
        yield pairs, PairRows(pairs.normal[:, :gdim], movement.reshape(num_pairs, gdim, -1))
