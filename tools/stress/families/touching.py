# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Gaps, overlaps and bodies that touch without force."""

from __future__ import annotations

from collections.abc import Iterator

from stress.blocks import Blocks
from stress.check import Check
from stress.families.grid import ALL_CELLS, CELLS, block_case, divisions, scenes, usual
from stress.scene import Case, Scene

# In cells: their height is 1/20 of the block's
_SIZES = [10.0**k for k in range(-12, 1)] + [2.0, 5.0, 10.0]
_FINE = {"n_upper": (4, 20), "n_lower": (5, 2)}
_CELLS = (CELLS[0], ALL_CELLS[3])


def gaps() -> Iterator[Scene]:
    """Initial gap in cells; one step closes it and presses the bodies together."""

    def make(size, cell, **options):
        gap = size / 20
        return block_case(
            cell=cell,
            gap=gap,
            down=gap + 0.05,
            n_upper=divisions(cell, (4, 20), (2, 20)),
            n_lower=divisions(cell, (5, 2), (3, 1)),
            **options,
        )

    yield from scenes("initial gap in cells", _SIZES, usual(_CELLS), make)


def overlaps() -> Iterator[Scene]:
    """Initial overlap in cells; nothing is moved, or aside by a little."""

    def make(size, cell, **options):
        # By as much as 10 cells the block becomes half as high
        return block_case(
            cell=cell,
            gap=-size / 20,
            down=0.0,
            n_upper=divisions(cell, (4, 20), (2, 20)),
            n_lower=divisions(cell, (5, 2), (3, 1)),
            **options,
        )

    yield from scenes("initial overlap in cells", _SIZES, usual(_CELLS), make)


def zero_force() -> Iterator[Scene]:
    """Bodies that touch: at rest, moved along each other, or apart and back."""

    def make(motion, **options):
        blocks = Blocks(down=0.0, side=0.2 if motion == "along" else 0.0, **options)
        case = blocks.case()
        if motion == "apart and back":
            _lift(blocks, case)

        def answers():
            # What moves along a plane without pressure feels nothing
            force = abs(blocks.contact.force).max()
            return [Check("no force", float(force), 1e-12)]

        case.answers = answers
        return case

    yield from scenes(
        "touching without force", ("at rest", "along", "apart and back"), usual(ALL_CELLS), make
    )


def _lift(blocks: Blocks, case: Case) -> None:
    down = case.update

    def update(t):
        blocks.down = 0.0
        down(0.0)
        top = case.bcs[1].g
        dim = blocks.x0.shape[1]
        top.x.array.reshape(-1, dim)[:, -1] = 0.05 * (1 - abs(2 * t - 1))

    case.update, case.steps = update, 4
