# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A dry arch of stones under its own weight, whose supports give way; its stones are free bodies.

Lengths are in radii of the middle line, forces in weights of a stone of volume 1.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.optimize import linprog

import contactx as cx
import ufl

import story
from published.drawing import deformed
from published.record import Answer, Case, solve, steps
from scenes.grids import chosen, create, grid, middles, outside
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem

# Stones of half of the arch, its inner and outer radius, friction between stones
STONES, INNER, OUTER, FRICTION = 8, 0.9, 1.1, 0.3
# Young's modulus over the weight of a stone, and how far the support gives way: nearly rigid
_YOUNG, _SPREAD, _CELLS = 1e6, 1e-3, 6
_STEP = math.pi / 2 / STONES


def least_thrust() -> float:
    """Least horizontal force at the crown that rigid stones can be in balance with.

    A linear program of the forces at the corners of each joint: they press, and the shear of a
    joint is within the friction. Below the first stone, which is held, any force may act.
    """
    n = 3 * (STONES + 1)
    weight = _STEP * (OUTER**2 - INNER**2) / 2
    arm = 2 * math.sin(_STEP / 2) / (1.5 * _STEP) * (OUTER**3 - INNER**3) / (OUTER**2 - INNER**2)
    balance, loads = np.zeros((3 * STONES, n)), np.zeros(3 * STONES)
    rubs = np.zeros((2 * STONES, n))
    for joint in range(STONES + 1):
        angle = joint * _STEP
        out = np.array([math.cos(angle), math.sin(angle)])
        along = np.array([-out[1], out[0]])
        # On the stone above the joint; that below it takes the opposite
        columns = [
            [*force, radius * (out[0] * force[1] - out[1] * force[0])]
            for radius, force in ((INNER, along), (OUTER, along), (1.0, out))
        ]
        for stone, sign in ((joint, 1), (joint - 1, -1)):
            if 0 <= stone < STONES:
                rows = slice(3 * stone, 3 * stone + 3)
                balance[rows, 3 * joint : 3 * joint + 3] = sign * np.transpose(columns)
        if joint > 0:
            friction = FRICTION if joint < STONES else 0.0
            for row, sign in ((2 * joint - 2, 1), (2 * joint - 1, -1)):
                rubs[row, 3 * joint : 3 * joint + 3] = -friction, -friction, sign
    for stone in range(STONES):
        loads[3 * stone + 1 :][:2] = weight, weight * arm * math.cos((stone + 0.5) * _STEP)
    crown = np.zeros(n)
    crown[-3:-1] = 1
    free, pressed = (None, None), (0, None)
    bounds = [free] * 3 + [pressed, pressed, free] * STONES
    found = linprog(crown, rubs, np.zeros(len(rubs)), balance, loads, bounds)
    return float(found.fun)


def _stone(k: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Grid of a stone, counted from the support."""
    x, cells = grid((INNER, k * _STEP), (OUTER, (k + 1) * _STEP), (_CELLS, _CELLS))
    return np.column_stack([x[:, 0] * np.cos(x[:, 1]), x[:, 0] * np.sin(x[:, 1])]), cells


def arch() -> Answer:
    """Half of it; the crown presses on the plane of symmetry, the lowest stone is moved outward."""
    domain = create(*(_stone(k) for k in range(STONES)))
    facets = outside(domain)
    angles, inside = (np.arctan2(*points.T[::-1]) / _STEP for points in middles(domain, facets))
    stone = np.floor(inside).astype(int)
    # Lower faces 1, 3, ..., upper faces 2, 4, ...
    lower, upper = np.isclose(angles, stone), np.isclose(angles, stone + 1)
    tags = chosen(domain, facets, np.select([lower, upper], [2 * stone + 1, 2 * stone + 2], 0))
    u = story.displacement(domain)
    F = st_venant_kirchhoff(u, _YOUNG, 0.2) + ufl.TestFunction(u.function_space)[1] * ufl.dx
    aside = story.fix(u, tags, 0, 0.0, 1)
    bcs = [aside, story.fix(u, tags, 1, 0.0, 1)]
    contacts = [
        cx.Contact(cx.Surface(tags, 2 * k + 1), cx.Surface(tags, 2 * k), friction=FRICTION)
        for k in range(1, STONES)
    ]
    contacts.append(cx.Contact(cx.Surface(tags, 2 * STONES), cx.Plane((0, 0), (1, 0))))
    problem = make_problem(F, u, contacts, bcs)
    iterations = solve(problem)

    def update(t: float) -> None:
        aside.g.value[...] = t * _SPREAD

    iterations += steps(problem, 3, update)
    thrust = float(contacts[-1].force[0])
    return Answer(thrust, iterations, deformed(u, scale=10), least_thrust())


CASES = [
    Case(
        "arch",
        "Dry arch of 16 stones whose supports give way, friction 0.3",
        "Limit analysis by a linear program: M. Gilbert, C. Casapulla and H. M. Ahmed, Comput. "
        "Struct. 84, 2006, 873-887; Solfec's manual, validation, masonry arch",
        "thrust, over the weight of a stone of volume 1",
        arch,
        note="The program is solved here, for stones of a fifth of the radius: the published "
        "results are curves. Joints open at the crown and the haunch, and others slip.",
    ),
]
