# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Meshes that do not fit each other, and bad ones."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from stress.blocks import Blocks
from stress.families.grid import ALL_CELLS, CELLS, block_case, divisions, scenes, usual, variants
from stress.scene import METHODS, SLIDINGS, Scene


def mesh_ratio() -> Iterator[Scene]:
    """Cells of one surface are up to 50 times as many as of the other, along each axis."""
    ratios = [(n, 1) for n in (50, 20, 10, 5, 3, 2)] + [(1, n) for n in (1, 2, 3, 5, 10, 20, 50)]

    def make(ratio, cell, **options):
        upper, lower = ratio
        deep = divisions(cell, 2, 1)
        return block_case(
            cell=cell, n_upper=(upper, deep), n_lower=(lower, deep), side=0.03, **options
        )

    yield from scenes("mesh-size ratio", ratios, usual(), make)


def aspect() -> Iterator[Scene]:
    """Cells up to 10,000 times as long as thick: lying layers, standing columns, plates."""
    values = (10.0, 100.0, 1e3, 1e4)
    options = list(
        variants(
            cell=ALL_CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.0, 0.3),
            shape=("layers", "columns", "plate"),
        )
    )

    def make(value, shape, **options):
        if shape == "plate":
            height = 2 / 3 / value
            down = {"size_upper": (1.0, height), "down": 0.1 * height}
            return block_case(n_upper=(3, 2), n_lower=(4, 2), **down, **options)
        blocks = _Graded(n_upper=(4, 3), n_lower=(5, 3), down=0.01, side=0.01, **options)
        blocks.axis, blocks.ratio = (-1 if shape == "layers" else 0), value
        return blocks.case()

    yield from scenes("aspect ratio of cells", values, options, make)


class _Graded(Blocks):
    """Cells next to the contact are thin, or some across it narrow."""

    axis = 0
    ratio = 1.0

    def _mesh(self):
        data = super()._mesh()
        x, dim = data.mesh.geometry.x, data.mesh.geometry.dim
        axis = 0 if self.axis == 0 else dim - 1
        bodies = data.mesh.geometry.dofmaps[0], data.cell_tags.values
        for body in np.unique(bodies[1]):
            own = np.unique(bodies[0][data.cell_tags.find(body)])
            along = x[own, axis]
            places = np.unique(np.round(along, 9))
            near = int(np.argmin(np.abs(places))) if self.axis < 0 else len(places) // 2
            beside = near + 1 if near + 1 < len(places) else near - 1
            width = (places[beside] - places[near]) / self.ratio
            moves = np.abs(along - places[beside]) < 1e-8
            x[own[moves], axis] = places[near] + width
        return data


def noise() -> Iterator[Scene]:
    """Nodes moved at random: slivers."""
    options = [
        {"cell": cell, **rest, "friction": friction}
        for cell in (CELLS[1], *ALL_CELLS[2:])
        for rest in variants(method=METHODS, sliding=SLIDINGS)
        for friction in (0.0, 0.5)
    ]

    def make(value, cell, **options):
        # Hexahedra fold sooner
        part = 0.8 if cell == ALL_CELLS[3] else 1.0
        return block_case(
            cell=cell,
            n_upper=(4, 4),
            n_lower=(5, 4),
            noise=part * value,
            side=0.05,
            radius=3.0,
            **options,
        )

    yield from scenes("nodes moved by a part of a cell", (0.1, 0.2, 0.25, 0.3), options, make)
