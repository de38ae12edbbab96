# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slender bodies, whose active sets creep: beams on a former, belts on a drum."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.grids import tagged
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem
from story import displacement, elasticity

type Material = Callable[[fem.Function, float, float], ufl.Form]

# Thickness, half of the length and way of the ends, all over the radius of the former
SHAPES = {
    "thick": (0.1, 1.0, 0.3),
    "thin": (0.05, 1.0, 0.25),
    "deep": (0.05, 1.0, 0.5),
    "sheet": (0.02 / 4, 0.25, 0.1 / 4),
}


class Strip:
    """A strip of one layer of quadrilaterals on a circle of radius 1 about the origin."""

    def __init__(
        self,
        domain: mesh.Mesh,
        ends: Callable[[npt.NDArray[np.float64]], npt.NDArray[np.bool_]],
        bottom: Callable[[npt.NDArray[np.float64]], npt.NDArray[np.bool_]],
        material: Material,
        aside: float,
        petsc_options: dict[str, Any] | None,
        **options: Any,
    ):
        """Create the problem.

        Args:
            aside: How far the circle is moved, so that no node is above its centre.
        """
        self.u = displacement(domain)
        V = self.u.function_space
        tags = tagged(domain, mesh.locate_entities_boundary(domain, 1, bottom))
        self._given = fem.Function(V)
        self._x = V.tabulate_dof_coordinates()[:, 0]
        bcs = [fem.dirichletbc(self._given, fem.locate_dofs_geometrical(V, ends))]
        self.contact = cx.Contact(cx.Surface(tags, 1), cx.Sphere((aside, 0.0), 1.0), **options)
        self.problem = make_problem(
            material(self.u, 1.0, 0.3),
            self.u,
            [self.contact],
            bcs,
            petsc_options=petsc_options or {},
        )

    def pull(self, down: float, left: float | None = None) -> None:
        """Move the ends down.

        Args:
            left: How far the left one; as the other one if None.
        """
        at_left = self._x < 0
        self._given.x.array[1::2] = np.where(at_left, -down if left is None else -left, -down)


def beam(
    n: int,
    shape: str = "thick",
    *,
    material: Material = elasticity,
    petsc_options: dict[str, Any] | None = None,
    **options: Any,
) -> Strip:
    """A straight beam above the circle, whose ends ``press`` pulls down."""
    thick, half, _ = SHAPES[shape]
    corners = [[-half, 1.0], [half, 1.0 + thick]]
    domain = mesh.create_rectangle(MPI.COMM_WORLD, corners, [n, 1], mesh.CellType.quadrilateral)
    return Strip(
        domain,
        lambda x: np.isclose(np.abs(x[0]), half),
        lambda x: np.isclose(x[1], 1.0),
        material,
        0.01,
        petsc_options,
        **options,
    )


def press(strip: Strip, shape: str) -> cx.Report:
    """Pull the ends of a beam down in one step.

    Args:
        shape: Its shape.
    """
    strip.pull(SHAPES[shape][2])
    strip.problem.solve()
    return strip.problem.report


def belt(
    n: int,
    *,
    wound: bool = True,
    material: Material = st_venant_kirchhoff,
    friction: float = 0.3,
    **options: Any,
) -> Strip:
    """A belt of thickness 0.005, wound half around the circle, or straight above it."""
    thick = 0.005
    half = np.pi / 2 if wound else 2.0
    corners = [[-half, 1.0], [half, 1.0 + thick]]
    domain = mesh.create_rectangle(MPI.COMM_WORLD, corners, [n, 1], mesh.CellType.quadrilateral)
    x = domain.geometry.x
    if wound:
        angle, radius = x[:, 0].copy(), x[:, 1].copy()
        x[:, 0], x[:, 1] = radius * np.sin(angle), radius * np.cos(angle)

    def ends(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
        at: npt.NDArray[np.bool_] = (
            np.isclose(x[1], 0, atol=1e-9) if wound else np.isclose(np.abs(x[0]), half)
        )
        return at

    def bottom(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
        height = np.hypot(x[0], x[1]) if wound else x[1]
        at: npt.NDArray[np.bool_] = np.isclose(height, 1.0, atol=0.1 * thick)
        return at

    return Strip(
        domain,
        ends,
        bottom,
        material,
        0.0 if wound else 0.01,
        None,
        friction=friction,
        **options,
    )


# How far each end of a belt is pulled down, the right one first
PULLS = {"one end": (0.02, 0.0), "one end, far": (0.2, 0.0), "both ends": (0.1, 0.1)}


def run_belt(strip: Strip, right: float, left: float, steps: int = 5) -> list[cx.Report]:
    """Pull the ends of a belt down in equal load steps; reports of all that were accepted."""
    plan = cx.LoadSteps(
        strip.problem, steps, update=lambda t: strip.pull(t * right, t * left), progress=False
    )
    return [step.report for step in plan]
