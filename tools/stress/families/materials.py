# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies of very different stiffness, nearly incompressible ones, ones without Poisson's effect."""

from __future__ import annotations

from collections.abc import Iterator

from stress.families.grid import ALL_CELLS, block_case, scenes, usual, variants
from stress.scene import METHODS, SLIDINGS, Scene


def stiffness() -> Iterator[Scene]:
    """Ratio of Young's moduli, either body the stiffer one; with friction also a shear."""
    ratios = [(10.0**k, 1.0) for k in range(8, 0, -1)] + [(1.0, 10.0**k) for k in range(9)]

    def make(young, friction, **options):
        return block_case(young=young, friction=friction, side=0.1 * (friction > 0), **options)

    yield from scenes("stiffness ratio", ratios, usual(), make)


def poisson() -> Iterator[Scene]:
    """Poisson's ratio of both bodies, or of one."""
    values = [(a, b) for a in (0.0, 0.3, 0.49, 0.499, 0.4999) for b in (0.0, 0.4999)]
    options = [
        *usual(cells=ALL_CELLS, friction=(0.3,)),
        *variants(method=METHODS, sliding=SLIDINGS, material=("neo-hooke",)),
    ]

    def make(nu, **options):
        return block_case(nu=nu, **options)

    yield from scenes("Poisson's ratio", values, options, make)
