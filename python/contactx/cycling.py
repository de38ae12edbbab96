# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What comes back: a status that returns, and pairs that go back and forth between facets.

The core decides, see ``cycle_guard.h`` and ``frozen_pairs.h``; here it meets contacts and iterates.
"""

from __future__ import annotations

from collections.abc import Sequence

from petsc4py import PETSc

from contactx import cpp as core
from contactx.interface import Interface
from contactx.parallel.halo import Halo


class CycleGuard:
    """Shortens steps when the same active set comes back without a smaller residual."""

    def __init__(self, interfaces: Sequence[Interface], halo: Halo):
        """Create the guard.

        Args:
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._interfaces, self._halo = interfaces, halo
        self._rule = core.CycleGuard()
        self.begin_step()

    def begin_step(self) -> None:
        """Nothing has been seen yet."""
        self._rule.begin_step()
        self._last: PETSc.Vec | None = None

    @property
    def cycles(self) -> int:
        """How often a status has come back."""
        return self._rule.cycles

    def shorten(self, x: PETSc.Vec) -> bool:
        """Take back a part of the last step, if iterates go round.

        Args:
            x: The new iterate, changed in place.

        Returns:
            Whether it was changed.
        """
        if self._last is None or not self._rule.shortens():
            return False
        part = core.CycleGuard.part
        x.aypx(part, (1 - part) * self._last)
        return True

    def note(self, x: PETSc.Vec, residual: float) -> None:
        """Remember an iterate; all ranks must take part.

        Args:
            x: The iterate.
            residual: Its residual.
        """
        self._last = x.copy()
        status = core.fingerprint(self._halo.nodes, [i.nodes.status for i in self._interfaces])
        if self._rule.note(status, residual):
            for interface in self._interfaces:
                interface.law.allow_larger_friction()


class FrozenPairs:
    """Releases frozen pairs where they hide a penetration at what would be the solution."""

    def __init__(self, interfaces: Sequence[Interface], halo: Halo):
        """Take the contacts.

        Args:
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._interfaces, self._halo = interfaces, halo
        self._rule = core.FrozenPairs()

    def begin_step(self) -> None:
        """Pairs have not been released yet."""
        self._rule.begin_step()

    @property
    def gaps(self) -> list[float]:
        """Smallest gap that frozen pairs of each contact hide, when last looked for."""
        return self._rule.gaps

    def hide_penetration(self) -> bool:
        """Whether frozen pairs hide more penetration than the mesh explains; collective."""
        found = [i.master.deepest_frozen_pair(i.positions()) for i in self._interfaces]
        return self._rule.hide_penetration(self._halo.nodes, found)

    def release(self) -> bool:
        """Release the pairs, to settle close to the solution, unless that was tried often enough.

        Returns:
            Whether they are released.
        """
        if not self._rule.release():
            return False
        for interface in self._interfaces:
            interface.master.reset_flips()
        return True
