# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Laws with a vector multiplier."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np

from contactx import cpp as core
from contactx.law.law import Law
from contactx.law.nodes import Array, Nodes
from contactx.nodal import NodalValue
from contactx.parallel.reduce import largest

# A node that slips starts the next step on the edge of the cone: what a solve has left must not say
# on which side of it. Parts of the node's pressure and of the largest one
_EDGE = 1e-10
_LEFT = 1e-9
# Trial friction over its bound up to which slip that turns back sticks first, and by how much more
# where iterates go round. Measured: 3 to 100 differ by little, without a limit it is twice the work
_REACH = 10.0
_FARTHER = 1e3


class Coulomb(Law):
    """Unilateral contact with dry friction: |t| <= mu p, and slip only where they are equal."""

    name = "frictional"
    is_vector = True

    def __init__(self, friction: NodalValue, comm: MPI.Comm):
        """Create the law.

        Args:
            friction: Coefficient of friction, read anew in each evaluation.
            comm: Communicator.
        """
        self._friction = friction
        self._comm = comm
        self.begin_step()

    def begin_step(self) -> None:
        """See ``Law``."""
        self._reach = _REACH

    def allow_larger_friction(self) -> None:
        """See ``Law``; what friction throws far may be what it deforms after all."""
        self._reach *= _FARTHER

    def friction(self, nodes: Nodes) -> Array:
        """Current coefficient of friction, shape (n,).

        Raises:
            ValueError: If it is negative or not finite.
        """
        value = np.broadcast_to(self._friction.now(), nodes.gap.shape)
        if np.any(value < 0):
            raise ValueError(f"friction is {value.min()}: give numbers of at least 0")
        return np.where(nodes.smooth, 0.0, value)

    def check(self, nodes: Nodes) -> None:
        """See ``Law``."""
        self.friction(nodes)

    def set_status(self, nodes: Nodes) -> int:
        """See ``Law``; on the edge of the cone a node that slips goes on.

        Slip that turns back sticks first. Where that has been tried it turns: a node that opens
        only on the way back would stick and slip for ever.
        """
        before = nodes.status.copy()
        part = np.where(before == core.SLIP, 1 - self._edge(nodes), 1.0)
        friction = self.friction(nodes) * part
        core.frictional_status(
            nodes.multiplier,
            nodes.closable_gap,
            nodes.normal,
            nodes.slip,
            nodes.c,
            friction,
            self._reach,
            nodes.status,
        )
        # Slip may pull a node off that closes again and again: every fourth time it sticks
        closing = np.flatnonzero((before == core.OPEN) & (nodes.status == core.SLIP))
        closing = closing[friction[closing] > 0]
        nodes.status[closing[nodes.closings[closing] % 4 == 3]] = core.STICK
        nodes.closings[closing] += 1
        back = np.flatnonzero((before == core.SLIP) & (nodes.status == core.STICK))
        if len(back) > 0:
            traction = nodes.multiplier.reshape(nodes.slip.shape)[back]
            normal, p = nodes.normal[back], nodes.pressure[back]
            trial = traction - p[:, None] * normal - nodes.c[back, None] * nodes.slip[back]
            bound = friction[back] * (p - nodes.c[back] * nodes.gap[back])
            back = back[np.linalg.norm(trial, axis=1) > bound]
            nodes.status[back[nodes.turns[back] % 2 == 1]] = core.SLIP
            nodes.turns[back] += 1
        return int(np.count_nonzero(nodes.status != before))

    def _edge(self, nodes: Nodes) -> Array:
        """Part of the friction bound that a slipping node may fall short of."""
        p = np.maximum(nodes.pressure, 0.0)
        edge = np.full_like(p, 0.5)
        highest = largest(self._comm, p.max(initial=0.0))
        np.divide(_LEFT * highest, p, out=edge, where=p > 0)
        return np.minimum(_EDGE + edge, 0.5)

    def evaluate(self, nodes: Nodes) -> None:
        """See ``Law``."""
        core.frictional_complementarity(
            nodes.multiplier,
            nodes.gap,
            nodes.normal,
            nodes.slip,
            nodes.c,
            self.friction(nodes),
            nodes.area,
            nodes.status,
            nodes.mobile,
            nodes.value,
            nodes.by_multiplier.reshape(-1),
            nodes.by_gap,
            nodes.by_slip,
            nodes.by_normal,
        )
        if nodes.mean is not None:
            nodes.mean.chain(nodes.normal, nodes.by_slip, nodes.by_normal)


class Tied(Law):
    """Slave nodes keep their place in the frame of their facet."""

    name = "tied"
    is_vector = True
    is_tied = True

    def set_status(self, nodes: Nodes) -> int:
        """See ``Law``; a node with a pair is tied."""
        now = np.where(np.isnan(nodes.gap) | nodes.ceded, core.OPEN, core.STICK).astype(np.int8)
        changed = int(np.count_nonzero(now != nodes.status))
        nodes.status[:] = now
        return changed

    def evaluate(self, nodes: Nodes) -> None:
        """See ``Law``; the slip of a tie has a normal part, too.

        Each component on its own: A c ds where it can move, else A lambda.
        """
        n, gdim = nodes.slip.shape
        area = nodes.area[:, None]
        tied = nodes.closed[:, None] & (nodes.mobile > 0)
        by_slip = np.where(tied, area * nodes.c[:, None], 0.0)
        by_multiplier = np.where(tied, 0.0, area)
        traction = nodes.multiplier.reshape(n, gdim)
        nodes.value[:] = (by_slip * nodes.slip + by_multiplier * traction).ravel()
        nodes.by_multiplier[:] = by_multiplier[:, :, None] * np.eye(gdim)
        nodes.by_slip[:] = (by_slip[:, :, None] * np.eye(gdim)).ravel()
        nodes.by_gap[:] = 0
        nodes.by_normal[:] = 0
