# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes that are slave in several contacts."""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface
from contactx.parallel.reduce import anywhere

# Part of a normal that lies outside the span of others and still counts as independent
_INDEPENDENT = 0.1
# And where a node needs both: it has gone to and fro between them this often in a step
_LITTLE = 1e-4
_FLIPS = 2


class Junctions:
    """Keeps the system solvable where a node is slave in several contacts, as in a corner.

    The rule: of the contacts that a node closes, the deepest comes first, and one whose normal lies
    nearly in the span of the normals before it stays open, unless the node goes to and fro between
    them: it needs both, as in a shallow valley. A node that closes several contacts slides without
    friction in all of them, so that its constraints are the independent normals alone. A tie
    constrains a node in every direction: the node's other contacts stay open.

    Attributes:
        shared: Nodes of this rank that are slave in several contacts.
        corners: How many of them close several contacts at the last iterate.
    """

    def __init__(self, interfaces: Sequence[Interface], comm: MPI.Comm):
        """Find the nodes.

        Args:
            interfaces: Discrete sides of the contacts.
            comm: Communicator.
        """
        self._interfaces = interfaces
        slaves = np.concatenate([i.slaves for i in interfaces])
        nodes, count = np.unique(slaves, return_counts=True)
        self.shared: npt.NDArray[np.int32] = nodes[count > 1]
        self.corners = 0
        self._any = anywhere(comm, len(self.shared) > 0)
        self._places: list[list[tuple[int, int]]] = [[] for _ in self.shared]
        for k, interface in enumerate(interfaces):
            _, which, local = np.intersect1d(
                self.shared, interface.slaves, assume_unique=True, return_indices=True
            )
            for s, i in zip(which, local, strict=True):
                self._places[s].append((k, int(i)))
        self._deepest = np.full(len(self.shared), -1)
        self._flips = np.zeros(len(self.shared), dtype=np.int32)

    def update(self, first: bool) -> None:
        """Decide which contacts of shared nodes may close, and where friction counts.

        All ranks must take part.

        Args:
            first: Whether the iterate is the step's start.
        """
        self.corners = 0
        if not self._any:
            return
        if first:
            self._deepest[:] = -1
            self._flips[:] = 0
        closing, normals = [], []
        for interface in self._interfaces:
            nodes = interface.nodes
            nodes.ceded[:] = nodes.smooth[:] = False
            if interface.law.is_tied:
                closing.append(interface.master.paired & interface.active)
            else:
                closing.append(interface.closing(first))
            normals.append(interface.master.normals())
        for s, places in enumerate(self._places):
            closed = [(k, i) for k, i in places if closing[k][i]]
            if len(closed) > 1:
                self._decide(s, closed, normals)

    def _decide(
        self, s: int, closed: list[tuple[int, int]], normals: list[npt.NDArray[np.float64]]
    ) -> None:
        def urgency(place: tuple[int, int]) -> tuple[bool, float, int]:
            interface = self._interfaces[place[0]]
            return (not interface.law.is_tied, interface.nodes.gap[place[1]], place[0])

        kept: list[tuple[int, int]] = []
        basis = np.zeros((0, normals[0].shape[1]))
        closed = sorted(closed, key=urgency)
        self._flips[s] += self._deepest[s] not in (-1, closed[0][0])
        self._deepest[s] = closed[0][0]
        independent = _INDEPENDENT if self._flips[s] < _FLIPS else _LITTLE
        for k, i in closed:
            interface = self._interfaces[k]
            rest = normals[k][i] - basis.T @ (basis @ normals[k][i])
            size = np.linalg.norm(rest)
            if size < independent:
                interface.nodes.ceded[i] = True
                continue
            kept.append((k, i))
            # A tie spans every direction
            basis = (
                np.eye(len(rest))
                if interface.law.is_tied
                else np.vstack([basis, rest[None, :] / size])
            )
        if len(kept) > 1:
            self.corners += 1
            for k, i in kept:
                self._interfaces[k].nodes.smooth[i] = True
