# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slave nodes exactly on vertices, edges and the boundary of the master."""

from __future__ import annotations

from collections.abc import Iterator

from scenes import dimension
from stress.families.grid import ALL_CELLS, block_case, scenes, variants
from stress.scene import METHODS, SLIDINGS, Scene

# Cells of the upper block, of the lower one, and how far it begins aside
_PLACES = {
    "on vertices, flush": (4, 4, 0.0, 1.0),
    "on edges, flush": (8, 4, 0.0, 1.0),
    "on vertices": (4, 6, 0.25, 1.5),
    "on edge middles": (4, 6, 0.125, 1.5),
    "on the boundary": (4, 3, 0.5, 1.5),
    "beyond the boundary": (4, 4, 0.5, 1.0),
    "one cell on one": (1, 1, 0.0, 1.0),
    "master inside the slave": (4, 4, -0.25, 0.5),
}


def on_vertices() -> Iterator[Scene]:
    """Slave nodes on the places named, pressed, then moved along by a cell or a part of one."""
    options = list(
        variants(
            cell=ALL_CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.0, 0.3),
            side=(0.0, 0.25),
        )
    )

    def make(place, cell, method, **options):
        upper, lower, shift, size = _PLACES[place]
        solid = dimension(cell) == 3
        # Faces of the lower block's sides are not in the contact
        return block_case(
            cell=cell,
            method=method,
            n_upper=(upper, 2 - solid),
            n_lower=(lower, 2 - solid),
            size_lower=(size, 1.0),
            shift=shift,
            **options,
        )

    yield from scenes("nodes exactly on places", _PLACES, options, make)
