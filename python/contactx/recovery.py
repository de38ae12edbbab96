# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodal tractions that scatter less than the multipliers.

A multiplier is the force of a slave node over its area. It scatters from node to node where the
meshes do not match (by 20 % on Hertz's problem, node to surface), and at the edge of the contact.
``Recovery`` moves force between closed nodes i and j that share a facet, in two passes of

    p_i <- p_i + 1/A_i sum_j m_ij (p_j - p_i),   m_ij = (A_fi A_fj / A_f) r_ij^2

with the parts A_fi of a facet's area A_f. Inside the contact, where r = 1, a pass takes the means
of the facets, and of them those of the nodes. At its edge the pressure falls like a root and says
little of what is inside: r_ij < 1 is the ratio of the closed parts of the two nodes' surroundings.
All of this was chosen by measurement on Hertz's point and line contacts, the same for both methods;
these properties are exact but for rounding:

- the sum of the pressures' forces stays, as what one node loses another one gains;
- a uniform traction stays, on any mesh and next to any edge;
- signs and the friction cone stay: averages have positive weights, the same for p and t;
- open nodes stay at zero, and no rigid motion changes anything.

Peaks that are not much wider than a facet get lower: with 3, 6 and 12 nodes in the half-width of a
line contact by 3, 0.9 and 0.3 %, at the corner of a flat punch by a fifth.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.slaves import SlaveNodes
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int64]

_PASSES = 2


class Recovery:
    """Averages tractions of slave nodes with those of their neighbours on the slave surface.

    All ranks must take part in what it does; neighbours may belong to others.
    """

    def __init__(self, slave: SlaveNodes, x: Array):
        """Find the neighbours.

        Args:
            slave: Slave nodes.
            x: Reference positions of all nodes, shape (num_nodes, gdim).
        """
        self._slave, facets = slave, slave.facets
        nodes = slave.corners.astype(np.int64)
        # Each corner of each facet as a node of its own
        corners = np.arange(len(nodes), dtype=np.int32)
        parts = core.nodal_areas(facets.offsets, corners, x[facets.nodes], x.shape[1])
        # Of nodes of other ranks not all facets are here
        self._area = slave.scatter_forward(slave.sums(parts))
        none = np.zeros(0, dtype=np.int64)
        to, from_, weight = [none], [none], [np.zeros(0)]
        for _, corner in FacetList(facets.offsets, corners).groups():
            part = parts[corner]
            i, j = np.nonzero(~np.eye(corner.shape[1], dtype=bool))
            to.append(nodes[corner[:, i]].ravel())
            from_.append(nodes[corner[:, j]].ravel())
            weight.append((part[:, i] * part[:, j] / part.sum(axis=1, keepdims=True)).ravel())
        self._to, self._from = np.concatenate(to), np.concatenate(from_)
        self._weight = np.concatenate(weight)

    def pressure(self, p: Array, area: Array, closed: npt.NDArray[np.bool_]) -> Array:
        """Average pressures.

        Args:
            p: Pressures, zero on open nodes, force/area, shape (n,).
            area: Areas of the slave nodes, shape (n,).
            closed: Whether they are in contact, shape (n,).

        Returns:
            Averages, shape (n,).
        """
        to, from_, rate = self._flows(area, closed)
        for _ in range(_PASSES):
            every = self._slave.scatter_forward(p)
            p = p + _sums(to, rate * (every[from_] - p[to]), len(p))
        return p

    def shear(self, t: Array, normal: Array, area: Array, closed: npt.NDArray[np.bool_]) -> Array:
        """Average tractions along the surface.

        From node to node they turn with the normal, so that they keep their sizes on a curved
        surface.

        Args:
            t: Tractions normal to the normals, zero on open nodes, force/area, shape (n, gdim).
            normal: Unit normals, shape (n, gdim).
            area: Areas of the slave nodes, shape (n,).
            closed: Whether they are in contact, shape (n,).

        Returns:
            Averages, normal to the normals, shape (n, gdim).
        """
        to, from_, rate = self._flows(area, closed)
        a, b = self._slave.scatter_forward(normal)[from_], normal[to]
        for _ in range(_PASSES):
            flow = rate[:, None] * (_turned(self._slave.scatter_forward(t)[from_], a, b) - t[to])
            t = t + np.stack([_sums(to, f, len(t)) for f in flow.T], axis=1)
        return t

    def _flows(self, area: Array, closed: npt.NDArray[np.bool_]) -> tuple[Index, Index, Array]:
        """Nodes i of this rank and j, both closed, and m_ij/A_i of each flow from j to i."""
        to, from_ = self._to, self._from
        n = len(area)
        closed = self._slave.scatter_forward(closed)
        beside_open = _sums(to, self._weight * ~closed[from_], len(closed))[:n]
        surroundings = self._slave.scatter_forward(1 - beside_open / self._area[:n])
        # Less than one where the master covers a node's facets in part
        covered = self._slave.scatter_forward(area / self._area[:n])
        both = closed[to] & closed[from_] & (to < n)
        to, from_ = to[both], from_[both]
        less, more = np.sort([surroundings[to], surroundings[from_]], axis=0)
        weight = self._weight[both] * np.minimum(covered[to], covered[from_])
        return to, from_, weight * (less / more) ** 2 / area[to]


def _sums(places: Index, values: Array, n: int) -> Array:
    """Sums of values by their places, shape (n,)."""
    # Of no values at all NumPy makes integers
    return np.bincount(places, values, n).astype(np.float64)


def _turned(t: Array, a: Array, b: Array) -> Array:
    """Vectors normal to unit vectors a, turned on the shortest way from a to b, shape (n, gdim)."""
    along = np.einsum("ij,ij->i", b, t)
    cosine = np.einsum("ij,ij->i", a, b)
    # Opposite vectors have no shortest way; t is normal to both of them
    factor = np.divide(along, 1 + cosine, out=np.zeros_like(along), where=1 + cosine > 0)
    turned: Array = t - factor[:, None] * (a + b)
    return turned
