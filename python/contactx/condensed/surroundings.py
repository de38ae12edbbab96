# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is known of all nodes on a rank, those of other ranks included."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.bulk import Bulk
from contactx.condensed.blocks import Array
from contactx.condensed.numbering import Numbering
from contactx.system import SaddlePointSystem


class Surroundings:
    """What a rank must know of the nodes of others to eliminate its multipliers.

    Attributes:
        numbering: Where the displacements are in the bulk's matrix.
        free: 1 at displacements that are not prescribed, else 0, shape (num_local,).
        is_slave: Whether each node is slave in each contact, shape (num_nodes, num_contacts).
    """

    numbering: Numbering
    free: Array
    is_slave: npt.NDArray[np.bool_]

    def __init__(self, bulk: Bulk, system: SaddlePointSystem):
        """Create it; ``renew`` comes before the first use.

        Args:
            bulk: The bulk.
            system: The coupled system.
        """
        self._bulk = bulk
        self._system = system
        self._version = -1

    def renew(self) -> None:
        """Follow the nodes on this rank where they have changed; all ranks must take part."""
        halo = self._system.halo
        if self._version == halo.version:
            return
        self._version = halo.version
        self.numbering = Numbering(halo)
        self.free = self.numbering.extend((self._bulk.markers == 0).astype(np.float64))
        interfaces = self._system.interfaces
        is_slave = np.zeros((halo.num_owned, len(interfaces)), dtype=bool)
        for k, interface in enumerate(interfaces):
            is_slave[interface.slaves, k] = True
        self.is_slave = halo.extend(is_slave)
