# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sheets that are thinner than their facets, one on the other, pressed together."""

from __future__ import annotations

from typing import Any

import contactx as cx
import ufl
from dolfinx import fem

from scenes.grids import create, grid, outside, tagged
from scenes.problems import make_problem
from story import displacement, elasticity

PRESSURE = 1e-3


class ThinSheets:
    """Sheets under a uniform pressure, E = 1, nu = 0: their boundaries are one surface."""

    def __init__(
        self,
        cells: tuple[int, ...] = (10, 7, 10),
        height: float = 0.02,
        petsc_options: dict[str, Any] | None = None,
        **options: Any,
    ):
        """Create them, one above the other with small gaps."""
        gap = 0.01 * height
        parts = []
        for k, n in enumerate(cells):
            low = k * (height + gap)
            parts.append(grid([0.0, low], [1.0, low + height], [n, 1]))
        domain = create(*parts)
        tags = tagged(domain, outside(domain))
        self.top = len(cells) * height + (len(cells) - 1) * gap
        self.u = u = displacement(domain)
        V = u.function_space
        height_of = ufl.SpatialCoordinate(domain)[1]
        on_top = ufl.conditional(ufl.gt(height_of, self.top - 1e-9), PRESSURE, 0.0)
        F = elasticity(u, 1.0, 0.0) + on_top * ufl.TestFunction(u.function_space)[1] * ufl.ds
        bcs = []
        for component, where in (
            (1, lambda x: x[1] < 1e-9),
            (0, lambda x: x[0] < 1e-9),
        ):
            dofs = fem.locate_dofs_geometrical(
                (V.sub(component), V.sub(component).collapse()[0]), where
            )
            zero = fem.Function(V.sub(component).collapse()[0])
            bcs.append(fem.dirichletbc(zero, dofs, V.sub(component)))
        self.contact = cx.Contact.all(tags, **options)
        self.problem = make_problem(F, u, [self.contact], bcs, petsc_options=petsc_options)
