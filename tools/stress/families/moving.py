# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Friction from none to ten, deep indentation in one step, rigid obstacles."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dolfinx.mesh import CellType

from scenes import dimension
from stress.alone import Alone
from stress.families.grid import CELLS, block_case, divisions, scenes, variants
from stress.scene import METHODS, SLIDINGS, Scene
from stress.tools import Ball, Floor, Wave


def friction() -> Iterator[Scene]:
    """Coefficient of friction under none, some and much shear, in one step."""
    values = (0.0, 1e-6, 1e-3, 0.01, 0.1, 0.3, 0.577, 1.0, 2.0, 5.0, 10.0)
    options = list(
        variants(
            cell=CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            side=(0.0, 0.02, 0.3),
            radius=(None, 2.0),
        )
    )

    def make(mu, cell, **options):
        return block_case(
            cell=cell,
            friction=mu,
            n_upper=divisions(cell, (6, 4), (3, 2)),
            n_lower=divisions(cell, (7, 4), (4, 2)),
            **options,
        )

    yield from scenes("friction", values, options, make)


def indentation() -> Iterator[Scene]:
    """How deep the upper block is pressed in one step, as a part of its height."""
    values = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
    options = list(
        variants(
            cell=CELLS,
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.0, 0.3),
            radius=(None, 1.5),
            material=("linear", "neo-hooke"),
        )
    )

    def make(depth, cell, **options):
        return block_case(
            cell=cell,
            down=depth,
            n_upper=divisions(cell, (6, 4), (3, 2)),
            n_lower=divisions(cell, (8, 4), (4, 2)),
            **options,
        )

    yield from scenes("indentation in one step", values, options, make)


def rigid() -> Iterator[Scene]:
    """How deep a rigid obstacle of some shape is pressed into a block in one step."""
    values = (0.001, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
    options = list(
        variants(
            cell=(*CELLS, CellType.hexahedron),
            method=METHODS,
            sliding=SLIDINGS,
            friction=(0.0, 0.3),
            shape=("plane", "ball", "wave"),
        )
    )
    yield from scenes("rigid obstacle, depth", values, options, _rigid)


def _rigid(depth, cell, shape, **options):
    dim = dimension(cell)
    below = np.full(dim, 0.5)
    below[-1] = -1.0
    obstacles = {
        "plane": lambda domain: Floor(domain, np.zeros(dim)),
        "ball": lambda domain: Ball(domain, below, 1.0),
        "wave": lambda domain: Wave(domain, np.zeros(dim)),
    }
    scene = Alone(cell, obstacles[shape], n=(divisions(cell, 8, 4),) * dim, **options)

    def update(t):
        scene.top.x.array.reshape(-1, dim)[:, -1] = -depth * t

    scene.case.update = update
    return scene.case
