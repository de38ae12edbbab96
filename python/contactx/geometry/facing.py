# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a slave surface faces its master."""

from __future__ import annotations

import numpy as np

from contactx import cpp as core
from contactx.obstacles import Obstacle
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, least
from contactx.parallel.slaves import SlaveNodes
from contactx.surface import Surface


def check_facing(
    slave: Surface,
    slaves: SlaveNodes,
    master: Surface | Obstacle,
    pairs: core.Master,
    halo: Halo,
) -> None:
    """Check that the slave surface does not face away from all of its master that is in reach.

    It may lie beyond the master's outer edge, to slide onto it later, or out of reach. A rigid
    obstacle takes nodes of any normal. All ranks must take part.

    Args:
        slave: Slave surface.
        slaves: Its nodes.
        master: Master surface or rigid obstacle.
        pairs: Pairs in the reference configuration.
        halo: Nodes of this rank.

    Raises:
        ValueError: If it does, on all ranks.
    """
    comm, x, facets = halo.comm, halo.x, slaves.facets
    if not isinstance(pairs, core.DeformableMaster) or anywhere(comm, pairs.paired.any()):
        return
    distance = least(comm, pairs.distance(x))
    normals = core.nodal_normals(facets.offsets, facets.nodes, x, halo.gdim)
    normals = normals.reshape(-1, halo.gdim)[slaves.owned]
    # The facet that faces a node may lie beside it
    found = pairs.surface.find(x, x[slaves.owned], normals, pairs.reach)
    faces = anywhere(comm, np.isfinite(found.distance).any())
    if distance <= pairs.reach and not faces:
        raise ValueError(
            f"the slave surface {slave} faces away from its master {master}: no slave node has a "
            f"normal that opposes that of a master facet within the search distance "
            f"{pairs.reach:.3g}, although the nearest is {distance:.3g} away. Check the tags: "
            "the surfaces must face each other"
        )
