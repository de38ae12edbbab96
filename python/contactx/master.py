# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which kind of pairs a contact has, and how far apart they are looked for."""

from __future__ import annotations

import numpy as np

from contactx import cpp as core
from contactx.bodies import Bodies
from contactx.geometry.facets import check_facets, check_folds
from contactx.geometry.inside import check_apart, check_outside
from contactx.obstacles import Obstacle, Plane
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import extent, largest, total
from contactx.parallel.slaves import SlaveNodes
from contactx.search import in_order
from contactx.surface import FacetList, Surface


def make_master(
    slave: Surface,
    slaves: SlaveNodes,
    master: Surface | Obstacle,
    bodies: Bodies,
    halo: Halo,
    law: core.Law,
    *,
    method: str,
    sliding: str,
    search_distance: float | None,
) -> core.Master:
    """Make the master side of a contact, without pairs yet; all ranks must take part.

    Args:
        slave: Slave surface.
        slaves: Its nodes.
        master: Master surface or rigid obstacle.
        bodies: Bodies of the mesh.
        halo: Nodes of this rank.
        law: Contact law.
        method: "node-to-surface" or "surface-to-surface".
        sliding: "finite" or "small".
        search_distance: Largest distance of a pair; chosen if None.

    Returns:
        The master side.

    Raises:
        ValueError: If facets are degenerate, the surfaces share nodes, a body lies wholly inside
            its master, or an obstacle's parameters do not fit.
    """
    facets = slave.facet_nodes(bodies.V)
    check_facets(slave, "slave", facets, halo)
    if isinstance(master, Obstacle):
        size = float(extent(halo.comm, halo.x[slaves.owned]).max())
        master.extent = max(master.extent, size)
        options = (master, slaves, halo.x, search_distance)
        obstacle: core.ObstacleMaster
        with agreed(halo.comm):
            if law.is_tied:
                obstacle = core.ObstacleTie(*options)
            elif method == "surface-to-surface" and not isinstance(master, Plane):
                obstacle = core.MortarObstacle(*options, law.is_vector)
            else:
                # Dual functions weigh what is linear on a facet, as a plane's gap, at its nodes
                obstacle = core.ObstacleMaster(*options, law.is_vector)
            gap = obstacle.inside(halo.x)
        check_outside(slave, slaves.owned, gap, master, bodies)
        return obstacle
    others = master.facet_nodes(bodies.V)
    check_facets(master, "master", others, halo)
    check_apart(slave, master, facets, others, bodies)
    others = in_order(others, halo)
    if method == "node-to-surface":
        check_folds(slave, slaves, halo)
    deformable: type[core.DeformableMaster]
    if method == "surface-to-surface":
        deformable = core.SurfaceTie if law.is_tied else core.SurfaceToSurface
    else:
        deformable = core.NodeTie if law.is_tied else core.NodeToSurface
    reach = search_distance or _default_reach(halo, slaves.facets, others)
    surface = core.MasterSurface(halo.nodes, others.offsets, others.nodes)
    outside = core.Outside(halo.nodes, others.offsets, others.nodes)
    return deformable(
        halo.nodes,
        slaves,
        surface,
        outside,
        reach,
        is_small=sliding == "small",
        measures_slip=law.is_vector,
    )


def _default_reach(halo: Halo, slave: FacetList, master: FacetList) -> float:
    """Diameter of the larger surface: twice the largest distance of its nodes from their mean.

    A body that has moved into another within one iteration must still be found.

    Args:
        halo: Nodes of this rank.
        slave: Slave facets on this rank.
        master: Master facets on this rank.
    """
    radii = []
    for facets in (slave, master):
        # Each node counts on the rank that owns it
        marked = np.zeros(halo.num_nodes)
        marked[facets.nodes] = 1
        nodes = halo.x[: halo.num_owned][halo.scatter_reverse(marked) > 0]
        sums = total(halo.comm, np.append(nodes.sum(axis=0), len(nodes)))
        arms = np.linalg.norm(nodes - sums[:-1] / sums[-1], axis=1)
        radii.append(largest(halo.comm, arms.max(initial=0.0)))
    return 2 * float(max(radii))
