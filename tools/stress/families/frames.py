# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The same scene in other units, turned, far away, and with other numbers."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from stress.blocks import Blocks
from stress.check import Check
from stress.families.grid import ALL_CELLS, CELLS, scenes, usual, variants
from stress.scene import METHODS, SLIDINGS, Case, Scene, relative

_BASE: dict[str, Any] = {"down": 0.03, "side": 0.02, "radius": 4.0, "n_upper": (4, 2)}
_EPS = np.finfo(np.float64).eps


def _state(blocks: Blocks) -> dict[str, Any]:
    """What must be the same: without units, in the first scene's axes, sorted by place."""
    dim = blocks.x0.shape[1]
    u = blocks.u
    V = u.function_space
    node = np.empty(len(blocks.x0), dtype=np.int64)
    node[V.dofmap.list.ravel()] = V.mesh.geometry.dofmaps[0].ravel()
    order = np.lexsort(np.round(blocks.x0[node], 9).T)
    moved = u.x.array.reshape(-1, dim) @ blocks.Q / blocks.length
    p = blocks.contact.pressure.x.array
    own = np.empty(len(p), dtype=np.int64)
    own[blocks.contact.pressure.function_space.dofmap.list.ravel()] = V.dofmap.list.ravel()
    pressure = np.empty(len(p))
    pressure[own] = p / blocks.modulus
    force = blocks.Q.T @ blocks.contact.force / (blocks.modulus * blocks.length ** (dim - 1))
    return {"u": moved[order], "pressure": pressure[order], "force": force}


@cache
def _first(**options: Any) -> tuple[dict[str, Any], int]:
    """State and iterations of the scene itself."""
    blocks = Blocks(**_BASE, **options)
    case = blocks.case()
    case.update(1.0)
    case.problem.solve()
    return _state(blocks), case.problem.report.iterations


def _compared(blocks: Blocks, allowed: float, same_way: bool, **options: Any) -> Case:
    case = blocks.case()

    def answers():
        state, iterations = _first(**options)
        now = _state(blocks)
        checks = [relative(name, now[name], state[name], allowed) for name in state]
        if same_way:
            difference = abs(case.problem.report.iterations - iterations)
            checks.append(Check("as many iterations", difference, 0.0))
        return checks

    case.answers = answers
    return case


def units() -> Iterator[Scene]:
    """Units of length over 20 decades, of modulus over as many."""
    decades = [10.0**k for k in range(-10, 11, 2)]
    values = [(1.0, 1.0)]
    values += [(d, 1.0) for d in decades if d != 1] + [(1.0, d) for d in decades if d != 1]
    # Multipliers and displacements are 24 decades apart then
    values += [(d, 1 / d**0.5) for d in decades[1:-1] if d != 1]

    def make(value, **options):
        length, modulus = value
        blocks = Blocks(**_BASE, **options, length=length, modulus=modulus)
        return _compared(blocks, 1e-9, True, **options)

    yield from scenes("units of length:modulus", values, usual(), make)


def turned() -> Iterator[Scene]:
    """Turned at random, and moved away from the origin by up to a million sizes."""
    values = (0.0, 1.0, 1e2, 1e3, 1e4, 1e5, 1e6)
    options = [
        {**rest, "turn": turn}
        for rest in variants(cell=CELLS, method=METHODS, sliding=SLIDINGS, friction=(0.0, 0.3))
        for turn in (1, 2, 3)
    ]

    def make(away, turn, **options):
        blocks = Blocks(**_BASE, **options, turn=turn, away=away)
        return _compared(blocks, 1e-8 + 2e4 * _EPS * away, False, **options)

    yield from scenes("turned and moved away by sizes", values, options, make)


def renumbered() -> Iterator[Scene]:
    """Nodes, cells and their local numbers shuffled, and so the pairs."""

    def make(seed, **options):
        blocks = Blocks(**_BASE, **options, shuffle=seed)
        return _compared(blocks, 1e-9, False, **options)

    yield from scenes("numbers shuffled, seed", range(1, 7), usual(ALL_CELLS), make)
