# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A sheet held at its ends, or a block on its bottom, with a rigid tool that comes from above."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.grids import faces, outside, tagged
from scenes.problems import make_problem
from story import displacement, elasticity

RADIUS = 0.3


def disc(place: fem.Constant) -> cx.Sphere:
    return cx.Sphere(place, RADIUS)


def cylinder(place: fem.Constant) -> cx.Cylinder:
    return cx.Cylinder(place, (0, 1, 0), RADIUS)


def level_set(place: fem.Constant) -> cx.LevelSet:
    return cx.LevelSet(lambda x: ufl.sqrt((x[0] - place[0]) ** 2 + (x[1] - place[1]) ** 2) - RADIUS)


class HeldSheet:
    """From -1 to 1, its top at height 0.

    Attributes:
        place: Centre of the tool, which touches the top at first.
    """

    def __init__(
        self,
        tool: Callable[[fem.Constant], cx.Sphere | cx.Cylinder | cx.LevelSet] = disc,
        *,
        thickness: float = 0.1,
        n: int = 24,
        gdim: int = 2,
        whole: bool = False,
        on_ground: bool = False,
        deep: float = 0.0,
        material: Callable[[fem.Function, float, float], ufl.Form] = elasticity,
        audit: str = "refuse",
        **options: Any,
    ):
        """Create the sheet.

        Args:
            deep: How deep the tool is at first, by its radius.
        """
        high = max(2, round(thickness * n / 2))
        ends = [[-1.0, -thickness], [1.0, 0.0]]
        if gdim == 2:
            domain = mesh.create_rectangle(
                MPI.COMM_WORLD, ends, [n, high], mesh.CellType.quadrilateral
            )
        else:
            corners = [[-1.0, 0.0, -thickness], [1.0, 0.2, 0.0]]
            domain = mesh.create_box(
                MPI.COMM_WORLD, corners, [n, 2, high], mesh.CellType.hexahedron
            )
        self.u = u = displacement(domain)
        V, up = u.function_space, gdim - 1

        def fixed(x: np.ndarray) -> np.ndarray:
            at: np.ndarray = (
                np.isclose(x[up], -thickness) if on_ground else np.isclose(np.abs(x[0]), 1)
            )
            return at

        tags = tagged(domain, outside(domain)) if whole else faces(domain, [(up, 0.0)])
        bc = fem.dirichletbc(np.zeros(gdim), fem.locate_dofs_geometrical(V, fixed), V)
        middle = np.zeros(gdim)
        self.place = fem.Constant(domain, middle)
        self.push(deep)
        self.contact = cx.Contact(cx.Surface(tags, 1), tool(self.place), **options)
        self.problem = make_problem(material(u, 1.0, 0.3), u, [self.contact], [bc], audit=audit)

    def push(self, deep: float) -> None:
        """Move the tool.

        Args:
            deep: How far below the sheet's first height its lowest point is, by its radius.
        """
        self.place.value[-1] = RADIUS * (1 - deep)

    def solve(self, deep: float, steps: int) -> None:
        """Push the tool in equal steps."""
        for k in range(steps):
            self.push(deep * (k + 1) / steps)
            self.problem.solve()

    def lowest(self) -> float:
        """Smallest displacement upward."""
        gdim = len(self.u)
        return float(self.u.x.array.reshape(-1, gdim)[:, -1].min())


def limit(loop, step, correction):
    """In place of ``core.Loop.limit``, which keeps cells from turning inside out as well.

    And slacks of the interior point inside their cones: so the active set goes on alone.
    """
    loop.bar_path()
    rule = loop.length
    rule.begin(loop.size_of(step), 1.0)
    while rule.has_trial:
        rule.judge(correction(rule.part))
    return rule.part
