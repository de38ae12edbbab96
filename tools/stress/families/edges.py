# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sliding off an edge, over a ridge or a valley, and with an edge."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from dolfinx.mesh import CellType

from scenes import dimension
from scenes.tip_on_arm import SIDE, TipOnArm
from stress.blocks import INTO, Blocks
from stress.check import Check
from stress.families.grid import ALL_CELLS, CELLS, divisions, label, scenes, variants
from stress.scene import METHODS, Case, Scene


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
    case.swapped = lambda: _pressed_first(blocks.swap())
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


def with_an_edge() -> Iterator[Scene]:
    """The edge of a block pushes an arm down and slides along it as it bends."""
    rows = variants(
        steps=(1, 5, 10, 20), method=METHODS, slave=("block", "arm"), depth=(0.1, 0.2, 0.3)
    )
    for own in rows:
        steps = own.pop("steps")
        yield Scene(
            "with an edge along an arm, steps",
            str(steps),
            label(own),
            partial(_edge, steps, **own),
        )


def _edge(steps: int, method: str, slave: str, depth: float) -> Case:
    scene = TipOnArm(method=method, swapped=slave == "arm")

    def update(t: float) -> None:
        scene.way.value[1] = -depth * t

    return Case(
        scene.problem,
        [scene.contact],
        scene.F,
        scene.bcs,
        update,
        size=SIDE,
        steps=steps,
        into=[INTO[method]],
        swapped=partial(_edge, steps, method, "block", depth) if slave == "arm" else None,
    )
