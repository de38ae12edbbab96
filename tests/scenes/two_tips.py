# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two thin cantilevers, one with its tip above the other's."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx
from dolfinx import fem, mesh

from scenes.grids import create, grid, outside
from scenes.problems import make_problem
from story import displacement, elasticity

THICKNESS = 0.02
LOWER, UPPER = 1, 2


class TwoTips:
    """The lower one is fixed at its left end, the right end of the upper one is moved down.

    Attributes:
        contact: Contact of the lower one's top with the upper one's bottom, or of all of both.
    """

    def __init__(self, *, overlap: float = 0.05, n: int = 20, whole: bool = False, **options: Any):
        """Create the cantilevers."""
        parts = []
        for k in range(2):
            right, up = k * (1 - overlap), k * 1.5 * THICKNESS
            parts.append(grid([right, up], [right + 1, up + THICKNESS], [n, 2]))
        domain = create(*parts)
        facets = outside(domain)
        at = mesh.compute_midpoints(domain, 1, facets)[:, 1]
        values = np.zeros(len(facets), dtype=np.int32)
        of_lower = at < 1.25 * THICKNESS
        values[of_lower & (whole | np.isclose(at, THICKNESS))] = LOWER
        values[~of_lower & (whole | np.isclose(at, 1.5 * THICKNESS))] = UPPER
        tags = mesh.meshtags(domain, 1, facets, values)
        self.u = u = displacement(domain)
        V = u.function_space
        self.moved = fem.Constant(domain, np.zeros(2))
        right = 2 - overlap
        bcs = [
            fem.dirichletbc(value, fem.locate_dofs_geometrical(V, where), V)
            for value, where in (
                (np.zeros(2), lambda x: np.isclose(x[0], 0)),
                (self.moved, lambda x: np.isclose(x[0], right)),
            )
        ]
        self.contact = cx.Contact(cx.Surface(tags, LOWER), cx.Surface(tags, UPPER), **options)
        self.problem = make_problem(elasticity(u, 1.0, 0.3), u, [self.contact], bcs)

    def push(self, down: float) -> None:
        """Move the upper one down by as many thicknesses."""
        self.moved.value[1] = -down * THICKNESS
