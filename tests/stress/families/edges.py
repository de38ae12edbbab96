# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sliding off an edge, and over a ridge or a valley."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dolfinx.mesh import CellType

from scenes import dimension
from stress.blocks import Blocks
from stress.families.grid import ALL_CELLS, CELLS, divisions, scenes, variants
from stress.scene import METHODS, Case, Check, Scene


def off_an_edge() -> Iterator[Scene]:
    """A small block is drawn off a larger one, in a number of steps, until nothing is below it."""
    options = list(
        variants(
            cell=ALL_CELLS, method=METHODS, friction=(0.0, 0.3), young=((1.0, 1.0), (1.0, 100.0))
        )
    )

    def make(steps, cell, **options):
        blocks = Blocks(
            cell=cell,
            n_upper=(3, 2),
            n_lower=divisions(cell, (8, 3), (5, 2)),
            size_upper=(0.5, 0.5),
            shift=0.4,
            down=0.01,
            side=1.3,
            steps=steps,
            **options,
        )
        case = _pressed_first(blocks)

        def answers():
            force = float(np.abs(blocks.contact.force).max())
            return [Check("nothing is below it", force, 1e-12)]

        case.answers = answers
        return case

    yield from scenes("off an edge, steps", (5, 10, 20, 40), options, make)


def _pressed_first(blocks: Blocks) -> Case:
    """The block is pressed within the first tenth of the way."""
    case = blocks.case()
    dim = blocks.x0.shape[1]
    top = case.bcs[1].g

    def update(t):
        motion = np.zeros(dim)
        motion[0], motion[-1] = blocks.side * t, -blocks.down * min(1, 10 * t)
        top.x.array.reshape(-1, dim)[:] = motion

    case.update = update
    return case


class _Bent(Blocks):
    """The lower block's top has a ridge, or a valley, across the way."""

    slope = 0.0

    def _mesh(self):
        data = super()._mesh()
        x, dim = data.mesh.geometry.x, data.mesh.geometry.dim
        lower = x[:, dim - 1] <= 1e-12
        upper = np.zeros(len(x), dtype=bool)
        upper[np.unique(data.mesh.geometry.dofmaps[0][data.cell_tags.find(1)])] = True
        lower = ~upper
        height = -self.slope * np.abs(x[lower, 0] - 0.75)
        x[lower, dim - 1] += height * (1 + x[lower, dim - 1])
        return data


def over_a_ridge() -> Iterator[Scene]:
    """A block is drawn over a ridge, which rises by a slope, or across a valley."""
    slopes = (-0.5, -0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 0.5)
    options = list(
        variants(
            cell=(*CELLS, CellType.hexahedron),
            method=METHODS,
            friction=(0.0, 0.3),
            lower=(6, 7),
            steps=(6, 24),
        )
    )

    def make(slope, cell, lower, **options):
        blocks = _Bent(
            cell=cell,
            n_upper=(4, 2) if dimension(cell) == 2 else (2, 2),
            n_lower=(lower, 3) if dimension(cell) == 2 else (lower, 1),
            size_upper=(0.3, 0.3),
            shift=0.1,
            # On the slope's top, or at its foot, it is pressed by as much
            gap=max(0.0, slope * -0.65) + 1e-3,
            down=0.03,
            side=1.0,
            **options,
        )
        blocks.slope = slope
        return _pressed_first(blocks)

    yield from scenes("over a ridge (+) or valley (-)", slopes, options, make)
