# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes of a contact on one rank."""

from __future__ import annotations

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.search import slave_facets
from contactx.surface import FacetList


class SlaveNodes(core.SlaveNodes):
    """Slave nodes that a rank owns, and those of others that share a facet with them.

    See ``contact/slave_nodes.h``.

    Attributes:
        facets: Slave facets around the owned slave nodes.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Find the nodes; all ranks must take part.

        Args:
            halo: Nodes of this rank, to which those of facets around its own are added for good.
            own: Slave facets of this rank's cells.
        """
        self.facets = slave_facets(halo, own)
        # The nodes do not keep it alive
        self._halo = halo
        super().__init__(halo.nodes, self.facets.offsets, self.facets.nodes, own.offsets, own.nodes)
