# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks that rub on a plane or on a base, driven by all displacements of their faces."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh

import meshes
from meshes import Tag
from scenes.blocks import dimension
from scenes.coulomb import check_coulomb
from scenes.materials import of_bodies
from scenes.problems import make_problem
from scenes.supports import DrivenFaces
from story import displacement, elasticity

type Array = npt.NDArray[np.float64]


class DrivenBlock:
    """A unit block whose top is driven, on a rigid plane or on a base whose bottom is driven.

    Attributes:
        bottom: The base's bottom; None on a plane.
        contact: The block's lower face on the plane or the base.
        count: Number of slave nodes by status.
    """

    def __init__(
        self,
        cell: mesh.CellType,
        *,
        plane: cx.Plane | None = None,
        friction: Any = 0.3,
        sliding: str = "finite",
        n_upper: int = 3,
        n_lower: int = 4,
        width: float = 3.0,
        shift: float = 0.83,
        gap: float = 0.0,
        height: float = 1.0,
        young: float | tuple[float, float] = 1.0,
        nu: float = 0.3,
        material: Callable[[fem.Function, Any, float], ufl.Form] = elasticity,
        rigid_base: bool = False,
    ):
        self.gdim = gdim = dimension(cell)
        data = meshes.blocks(
            cell,
            (n_upper,) * gdim,
            (n_lower,) * (gdim - 1) + (1 if rigid_base else n_lower,),
            size_upper=(1.0,) * (gdim - 1) + (height,),
            size_lower=(width,) * (gdim - 1) + (1.0,),
            shift=(shift,) * (gdim - 1),
            gap=gap,
        )
        domain, tags = data.mesh, data.facet_tags
        if plane is not None:
            domain, tags = meshes.single(data, Tag.UPPER)
        self.tags = tags
        self.u = displacement(domain)
        if isinstance(young, tuple):
            young = of_bodies(data, *young)
        self.F = material(self.u, young, nu)
        self.top = DrivenFaces(self.u, tags, Tag.UPPER_TOP)
        self.bottom: DrivenFaces | None = None
        if plane is None:
            # One layer of cells is fixed by both of its faces
            faces = (Tag.LOWER_BOTTOM, Tag.LOWER_CONTACT) if rigid_base else (Tag.LOWER_BOTTOM,)
            self.bottom = DrivenFaces(self.u, tags, *faces)
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Surface(tags, Tag.LOWER_CONTACT) if plane is None else plane,
            friction=friction,
            sliding=sliding,
        )
        self.problem = make_problem(
            self.F,
            self.u,
            [self.contact],
            [driven.bc for driven in (self.top, self.bottom) if driven is not None],
        )
        self._residual = fem.form(self.F)
        self.iterations: list[int] = []
        self.count: dict[str, int] = {}

    def step(self, *top: float) -> None:
        """Move the top to a place and solve."""
        self.top.move(top)
        self.solve()

    def solve(self) -> None:
        """Solve and check Coulomb's law."""
        self.problem.solve()
        self.iterations.append(self.problem.report.iterations)
        self.count = check_coulomb(self.contact, self.problem.report.history[-1].tolerance)

    @property
    def reactions(self) -> Array:
        """Forces of the bulk, in equilibrium those of supports and contact, shape (num_dofs,)."""
        forces: Array = fem.assemble_vector(self._residual).array
        return forces

    @property
    def tangential(self) -> Array:
        """Total force on the block along a horizontal surface, shape (gdim - 1,)."""
        return self.contact.force[:-1]

    @property
    def normal(self) -> float:
        """Total force on the block across a horizontal surface."""
        return float(self.contact.force[-1])
