# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What comes back: a status that returns, and pairs that go back and forth between facets."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

from contactx.interface import Interface
from contactx.parallel.reduce import least, total

# Part of a step that is taken where iterates go round
_FACTOR = 0.5
# Penetration, over the length of an edge, that frozen pairs may hide: as much as a ridge of 45
# degrees does under the margin of a facet
_HIDDEN = 0.03
# How often they are released in a step
_TIMES = 2


class CycleGuard:
    """Shortens steps when the same active set comes back without a smaller residual.

    The residual is piecewise smooth, with a piece for each active set: Newton steps that return to
    an active set would return to it for ever. A shortened step ends between the pieces and leads
    out of the cycle. The solution stays the same: full steps follow, and the residual alone decides
    convergence.

    Attributes:
        cycles: How often a status has come back.
    """

    def __init__(self, interfaces: Sequence[Interface], comm: MPI.Comm):
        """Create the guard.

        Args:
            interfaces: Discrete sides of the contacts.
            comm: Communicator.
        """
        self._interfaces = interfaces
        self._comm = comm
        self.begin_step()

    def begin_step(self) -> None:
        """Nothing has been seen yet."""
        self.cycles = 0
        self._short = 0
        self._seen: dict[int, list[float]] = {}
        self._status = -1
        self._last: PETSc.Vec | None = None

    def shorten(self, x: PETSc.Vec) -> bool:
        """Take back a part of the last step, if iterates go round.

        Args:
            x: The new iterate, changed in place.

        Returns:
            Whether it was changed.
        """
        if self._short == 0 or self._last is None:
            return False
        self._short -= 1
        x.aypx(_FACTOR, (1 - _FACTOR) * self._last)
        return True

    def note(self, x: PETSc.Vec, residual: float) -> None:
        """Remember an iterate; all ranks must take part.

        Args:
            x: The iterate.
            residual: Its residual.
        """
        self._last = x.copy()
        status = self._fingerprint()
        before = self._seen.setdefault(status, [])
        if status == self._status:
            # It may converge slowly; the same residual says that slip turns to and fro
            again = any(abs(residual - r) < 1e-3 * r for r in before)
        else:
            again = residual > _FACTOR * min(before, default=float("inf"))
        self._status = status
        before.append(residual)
        if again and self._short == 0:
            self.cycles += 1
            # Longer each time
            self._short = 1 + self.cycles
            self._seen.clear()
            for interface in self._interfaces:
                interface.law.allow_larger_friction()

    def _fingerprint(self) -> int:
        """Number that stands for the status of all nodes of all ranks."""
        digest = hashlib.blake2b(digest_size=8)
        for interface in self._interfaces:
            digest.update(interface.nodes.status.tobytes())
        mine = np.frombuffer(digest.digest(), dtype=np.uint64)
        return int(total(self._comm, mine)[0])


class FrozenPairs:
    """Releases frozen pairs where they hide a penetration at what would be the solution.

    A pair that goes back and forth between facets is frozen until the step's end.

    Attributes:
        gaps: Smallest gap that frozen pairs of each contact hide, when last looked for.
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
        """Pairs have not been released yet."""
        self._times = 0
        self.gaps: list[float] = []

    def hide_penetration(self) -> bool:
        """Whether frozen pairs hide more penetration than the mesh explains; collective."""
        found = [i.master.deepest_frozen_pair(i.positions()) for i in self._interfaces]
        gaps, parts = least(self._comm, np.array(found)).T
        self.gaps = gaps.tolist()
        return bool(parts.min() < -_HIDDEN)

    def release(self) -> bool:
        """Release the pairs, to settle close to the solution, unless that was tried often enough.

        Returns:
            Whether they are released.
        """
        if self._times == _TIMES:
            return False
        self._times += 1
        for interface in self._interfaces:
            interface.master.reset_flips()
        return True
