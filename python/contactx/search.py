# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surfaces that are searched, with the names that Python has for facets."""

from __future__ import annotations

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.surface import FacetList


def slave_facets(halo: Halo, facets: FacetList) -> FacetList:
    """Facets of a slave surface that this rank needs: all around its own nodes.

    Args:
        halo: Nodes of this rank, to which those of the facets are added for good.
        facets: Facets of the surface that this rank has.
    """
    if halo.comm.size == 1:
        return facets
    return FacetList(*core.slave_facets(halo.nodes, facets.offsets, facets.nodes))


def in_order(facets: FacetList, halo: Halo) -> FacetList:
    """Facets in the order of their original numbers, the same on any number of ranks."""
    return FacetList(*core.in_order(halo.nodes, facets.offsets, facets.nodes))
