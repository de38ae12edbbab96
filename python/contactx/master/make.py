# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which kind of pairs a contact has."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.law.law import Law
from contactx.master.facets import FacetMaster
from contactx.master.master import Master
from contactx.master.obstacle import ObstacleMaster
from contactx.master.ties import FacetTie, ObstacleTie
from contactx.obstacles import Obstacle
from contactx.surface import FacetList, Surface
from dolfinx import fem


def make_master(
    slave: FacetList,
    master: Surface | Obstacle,
    V: fem.FunctionSpace,
    x: npt.NDArray[np.float64],
    law: Law,
    *,
    sliding: str,
    search_distance: float | None,
) -> Master:
    """Make the master side of a contact, without pairs yet.

    Args:
        slave: Slave facets.
        master: Master surface or rigid obstacle.
        V: Space of the displacement.
        x: Reference positions of its nodes, shape (num_nodes, gdim).
        law: Contact law.
        sliding: "finite" or "small".
        search_distance: Largest distance of a pair; chosen if None.

    Returns:
        The master side.

    Raises:
        ValueError: If the surfaces share nodes, or an obstacle's parameters do not fit.
    """
    if isinstance(master, Obstacle):
        rigid = ObstacleTie if law.is_tied else ObstacleMaster
        slaves = np.unique(slave.nodes)
        return rigid(slaves, master, x, search_distance, measures_slip=law.is_vector)
    others = master.facet_nodes(V)
    shared = np.intersect1d(slave.nodes, others.nodes)
    if len(shared) > 0:
        raise ValueError(
            f"slave and master overlap: {master} and the slave surface share {len(shared)} nodes. "
            "Give each body its own nodes and each surface its own facets"
        )
    deformable = FacetTie if law.is_tied else FacetMaster
    return deformable(
        slave, others, x, search_distance, sliding=sliding, measures_slip=law.is_vector
    )
