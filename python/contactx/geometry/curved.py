# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Curved cells, which a displacement of a lower degree does not follow."""

from __future__ import annotations

import numpy as np

import basix
from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.refined import cells_of, geometry_of
from contactx.surface import Surface
from dolfinx import fem


def check_straight(name: str, surface: Surface, V: fem.FunctionSpace, halo: Halo) -> None:
    """Check that a contact surface is as the displacement has it; all ranks must take part.

    See ``mesh/straight.h``.

    Args:
        name: What it is to the contact.
        surface: The surface.
        V: Space of the displacement.
        halo: Nodes on this rank.

    Raises:
        ValueError: If it is curved on any rank, on all ranks; as ``Surface.facet_nodes`` does.
    """
    cmap = V.mesh.geometry.cmaps[0]
    if cmap.degree == 1:
        return
    points = basix.create_element(
        basix.ElementFamily.P,
        basix.CellType[V.mesh.topology.cell_type.name],
        cmap.degree,
        basix.LagrangeVariant(cmap.variant),
    ).points
    core.check_straight(
        halo.nodes,
        f"{name} {surface}",
        *cells_of(V),
        geometry_of(V.mesh),
        np.asarray(points, dtype=np.float64),
        *surface.cells_and_facets(V.mesh),
    )
