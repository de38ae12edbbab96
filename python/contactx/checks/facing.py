# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a slave surface faces its master."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.checks.shape import corner_normals
from contactx.master.facets import FacetMaster
from contactx.master.master import Master
from contactx.master.mortar import MortarMaster
from contactx.obstacles import Obstacle
from contactx.parallel import reduce
from contactx.parallel.halo import Halo
from contactx.surface import FacetList, Surface

_CHUNK = 1_000_000


def check_facing(
    slave: Surface,
    master: Surface | Obstacle,
    facets: FacetList,
    pairs: Master,
    halo: Halo,
) -> None:
    """Check that the slave surface does not face away from all of its master that is in reach.

    It may lie beyond the master's outer edge, to slide onto it later, or out of reach. A rigid
    obstacle takes nodes of any normal.

    Args:
        slave: Slave surface.
        master: Master surface or rigid obstacle.
        facets: Slave facets.
        pairs: Pairs in the reference configuration.
        halo: Nodes on this rank.

    Raises:
        ValueError: If it does, on all ranks.
    """
    comm, x = halo.comm, halo.x
    if not isinstance(pairs, FacetMaster | MortarMaster) or reduce.anywhere(
        comm, pairs.paired.any()
    ):
        return
    distance = reduce.least(comm, pairs.distance(x))
    if distance <= pairs.reach and not reduce.anywhere(
        comm, _opposes(facets, pairs.facets, x, pairs.reach)
    ):
        raise ValueError(
            f"the slave surface {slave} faces away from its master {master}: no slave node has a "
            f"normal that opposes that of a master facet within the search distance "
            f"{pairs.reach:.3g}, although the nearest is {distance:.3g} away. Check the tags: "
            "the surfaces must face each other"
        )


def _opposes(slave: FacetList, master: FacetList, x: npt.NDArray[np.float64], reach: float) -> bool:
    """Whether any slave node has a master facet within reach whose normal opposes its own.

    It need not project on that facet: it may lie beyond the master's outer edge. All pairs are
    gone through, which is meant for surfaces of which a search has found no pair.

    Args:
        slave: Slave facets.
        master: Master facets.
        x: Positions, shape (num_nodes, gdim).
        reach: Largest distance of a pair.
    """
    gdim = x.shape[1]
    slaves = np.unique(slave.nodes)
    normals = core.nodal_normals(slave.offsets, slave.nodes, x, gdim).reshape(-1, gdim)[slaves]
    has_none = ~normals.any(axis=1)
    for _, nodes in master.groups():
        corners = x[nodes]
        facing = corner_normals(corners).mean(axis=1)
        low, high = corners.min(axis=1), corners.max(axis=1)
        step = max(1, _CHUNK // len(nodes))
        for first in range(0, len(slaves), step):
            part = slice(first, first + step)
            p = x[slaves[part]][:, None]
            # The boxes are in reach wherever the facets are
            off = np.maximum(np.maximum(low - p, p - high), 0)
            near = np.einsum("sfi,sfi->sf", off, off) <= reach**2
            against = (normals[part] @ facing.T < 0) | has_none[part, None]
            for i in np.flatnonzero((near & against).any(axis=1)):
                chosen = nodes[near[i] & against[i]]
                if _distance(slaves[first + i], chosen, x) <= reach:
                    return True
    return False


def _distance(slave: np.int32, nodes: npt.NDArray[np.int32], x: npt.NDArray[np.float64]) -> float:
    """Distance from a slave node to the nearest of some facets."""
    count, size = nodes.shape
    offsets = np.arange(count + 1, dtype=np.int32) * np.int32(size)
    one, alone = np.array([0, 1], dtype=np.int32), np.array([slave], dtype=np.int32)
    return core.Pairing(one, alone, offsets, nodes.ravel(), x.shape[1]).distance(x)
