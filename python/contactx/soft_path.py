# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The core's path from soft to hard contact, for the contacts of a problem."""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.interface import Interface
from contactx.parallel.reduce import total


class SoftPath:
    """See ``soft_path.h``; all ranks must take part.

    Friction must find stick and slip at the same time, which a soft layer does not help: contacts
    without friction alone take the path, and only if no other contact has friction.

    Attributes:
        iterations: Linear solves of this step with soft contact.
    """

    def __init__(self, interfaces: Sequence[Interface], comm: MPI.Comm):
        """Take the contacts.

        Args:
            interfaces: Discrete sides of the contacts.
            comm: Communicator.
        """
        self._places = [k for k, i in enumerate(interfaces) if not i.law.is_tied]
        self._interfaces = [interfaces[k] for k in self._places]
        self._is_able = all(not i.law.is_vector for i in self._interfaces)
        self._comm = comm
        self._path = core.SoftPath()
        self.iterations = 0

    def begin_step(self) -> None:
        """Start a step, with hard contact."""
        self._path.begin_step()
        self._take()
        self.iterations = 0

    @property
    def is_soft(self) -> bool:
        """Whether contact is soft now."""
        return bool(self._path.softness > 0)

    def begins(self, step: Sequence[npt.NDArray[np.float64]]) -> bool:
        """Decide whether the path begins in place of a Newton step.

        Args:
            step: What the step takes off the multipliers of each contact.

        Returns:
            Whether it does, and the step is not to be taken.
        """
        if not self._is_able or self.is_soft:
            return False
        sums = np.zeros(4)
        for k, interface in zip(self._places, self._interfaces, strict=True):
            n = interface.nodes
            sums += core.look_at_step(n.multiplier, n.gap, n.c, n.area, n.status, -step[k])
        if not self._path.begins(*total(self._comm, sums)):
            return False
        self._take()
        return True

    def advance(self, changes: int, closed: int, *, is_full: bool) -> None:
        """Go on after an iterate.

        Args:
            changes: Number of nodes that changed their status.
            closed: Number of closed nodes.
            is_full: Whether the step was taken in full.
        """
        self.iterations += self.is_soft
        self._path.advance(changes, closed, is_full)
        self._take()

    def harden(self) -> None:
        """Make contact hard again."""
        self._path.harden()
        self._take()

    def _take(self) -> None:
        for interface in self._interfaces:
            nodes = interface.nodes
            changed = nodes.softness != self._path.softness
            nodes.softness = self._path.softness
            if changed:
                interface.law.evaluate(nodes)
