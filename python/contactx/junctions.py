# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The core's rule for nodes that are slave in several contacts, for the contacts of a problem."""

from __future__ import annotations

from collections.abc import Sequence

from contactx import cpp as core
from contactx.interface import Interface
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere


class Junctions:
    """See ``junctions.h``."""

    def __init__(self, interfaces: Sequence[Interface], halo: Halo):
        """Find the nodes; all ranks must take part.

        Args:
            interfaces: Discrete sides of the contacts.
            halo: Nodes of this rank.
        """
        self._interfaces = interfaces
        self._rule = core.Junctions([i.slaves for i in interfaces])
        self._any = anywhere(halo.comm, len(self._rule.shared) > 0)

    @property
    def corners(self) -> int:
        """How many nodes of this rank close several contacts at the last iterate."""
        return self._rule.corners

    def update(self, first: bool) -> None:
        """Decide which contacts of shared nodes may close, and where friction counts.

        All ranks must take part.

        Args:
            first: Whether the iterate is the step's start.
        """
        if not self._any:
            return
        interfaces = self._interfaces
        for interface in interfaces:
            # What was ceded before may close again
            interface.nodes.ceded[:] = False
        flags = self._rule.update(
            [i.law.is_tied for i in interfaces],
            [i.master.paired & i.active if i.law.is_tied else i.closing(first) for i in interfaces],
            [i.nodes.gap for i in interfaces],
            [i.master.normals() for i in interfaces],
            first,
        )
        for interface, (ceded, smooth) in zip(interfaces, flags, strict=True):
            interface.nodes.ceded[:] = ceded
            interface.nodes.smooth[:] = smooth
