# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A stiff bar that leans on a wall, held by friction at floor and wall alone."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

from scenes.grids import chosen, create, grid, middles, outside
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem
from story import displacement

LENGTH, WIDTH, YOUNG, WEIGHT, FRICTION = 1.0, 0.02, 1e4, 1e-3, 0.4
# Friction at both ends balances the weight of a thin bar above this angle:
# tan(angle) > (1 - mu^2) / (2 mu)
LIMIT = np.degrees(np.arctan((1 - FRICTION**2) / (2 * FRICTION)))


def lean(degrees: float, **options: Any) -> tuple[cx.Report, fem.Function]:
    """Let go of a bar that leans on a wall, in one step.

    Returns:
        What the step took, and the displacement.
    """
    domain = create(grid([0, 0], [LENGTH, WIDTH], [20, 2]))
    turn = np.pi - np.radians(degrees)
    x = domain.geometry.x
    x[:, :2] = x[:, :2] @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
    x[:, :2] -= x[:, :2].min(axis=0)
    facets = outside(domain)
    at, _ = middles(domain, facets)
    at_floor, at_wall = at[:, 1] < 1.5 * WIDTH, (at[:, 0] < 1.5 * WIDTH) & (at[:, 1] > 5 * WIDTH)
    values = np.where(at_floor, 1, np.where(at_wall, 2, 0))
    tags = chosen(domain, facets, values)
    u = displacement(domain)
    F = st_venant_kirchhoff(u, YOUNG, 0.0) + WEIGHT * ufl.TestFunction(u.function_space)[1] * ufl.dx
    contacts = [
        cx.Contact(cx.Surface(tags, tag), cx.Plane((0, 0), normal), friction=FRICTION, **options)
        for tag, normal in ((1, (0, 1)), (2, (1, 0)))
    ]
    problem = make_problem(F, u, contacts, [])
    problem.solve()
    return problem.report, u
