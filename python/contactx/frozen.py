# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pairs that were held because they went back and forth between facets."""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI

import numpy as np

from contactx.interface import Interface
from contactx.parallel.reduce import least

# Penetration, over the length of an edge, that they may hide: as much as a ridge of 45 degrees does
# under the margin of a facet
_HIDDEN = 0.03
_TIMES = 2


class FrozenPairs:
    """Lets frozen pairs go where they hide a penetration at what would be the solution.

    Attributes:
        gaps: Smallest gap that those of each contact hide, when last looked for.
    """

    def __init__(self, interfaces: Sequence[Interface], comm: MPI.Comm):
        """Take the contacts.

        Args:
            interfaces: Discrete sides of the contacts.
            comm: Communicator.
        """
        self._interfaces = interfaces
        self._comm = comm
        self.begin_step()

    def begin_step(self) -> None:
        """Forget how often pairs have been let go."""
        self._times = 0
        self.gaps: list[float] = []

    def hide(self) -> bool:
        """Whether they hide a penetration that the mesh does not excuse; collective."""
        found = [i.master.deepest_frozen(i.positions()) for i in self._interfaces]
        gaps, parts = least(self._comm, np.array(found)).T
        self.gaps = gaps.tolist()
        return bool(parts.min() < -_HIDDEN)

    def let_go(self) -> bool:
        """Let them go to settle close to the solution, unless that was tried often enough.

        Returns:
            Whether they are free.
        """
        if self._times == _TIMES:
            return False
        self._times += 1
        for interface in self._interfaces:
            interface.master.forget_flips()
        return True
