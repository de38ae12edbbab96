# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An upper block on a wider lower one: two elastic bodies that any contact may join."""

from __future__ import annotations

from typing import Any

import contactx as cx
from contactx.obstacles import Obstacle
from dolfinx import fem, mesh

import meshes
from meshes import Tag
from story import displacement, elasticity, fix

PLANE = (mesh.CellType.triangle, mesh.CellType.quadrilateral)
CELLS = (*PLANE, mesh.CellType.tetrahedron, mesh.CellType.hexahedron)
NU = 0.3


def dimension(cell: mesh.CellType) -> int:
    """Dimension of space of a kind of cells."""
    return 2 if cell in PLANE else 3


class Blocks:
    """An upper block pressed on a wider lower one that it does not match."""

    def __init__(
        self,
        cell_type: mesh.CellType,
        *,
        down: float = 0.05,
        gap: float = 0.0,
        n_upper: int = 2,
        n_lower: int = 3,
        degree: int = 1,
        stiffness: float = 1.0,
    ):
        """Create it.

        Args:
            stiffness: Young's modulus of the lower block; that of the upper one is one.
        """
        gdim = dimension(cell_type)
        data = meshes.blocks(
            cell_type,
            (n_upper,) * gdim,
            (n_lower,) * gdim,
            size_lower=(1.5,) * (gdim - 1) + (1.0,),
            shift=(0.23,) * (gdim - 1),
            gap=gap,
        )
        self.tags = data.facet_tags
        self.u = displacement(data.mesh, degree)
        young: Any = 1.0
        if stiffness != 1.0:
            young = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
            young.x.array[:] = 1.0
            young.x.array[data.cell_tags.find(Tag.LOWER)] = stiffness
        self.F = elasticity(self.u, young, NU)
        self.bcs = [
            *(fix(self.u, self.tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim)),
            *(fix(self.u, self.tags, i, 0.0, Tag.UPPER_TOP) for i in range(gdim - 1)),
            fix(self.u, self.tags, gdim - 1, -down, Tag.UPPER_TOP),
        ]

    def contact(
        self, sliding: str = "finite", *, master: Obstacle | None = None, **options: Any
    ) -> cx.Contact:
        return cx.Contact(
            cx.Surface(self.tags, Tag.UPPER_CONTACT),
            master or cx.Surface(self.tags, Tag.LOWER_CONTACT),
            sliding=sliding,
            **options,
        )

    def problem(self, *contacts: cx.Contact, **options: Any) -> cx.ContactProblem:
        return cx.ContactProblem(
            self.F,
            self.u,
            contacts=contacts,
            bcs=self.bcs,
            petsc_options_prefix="blocks_",
            **options,
        )

    def scalar(self, value: float, **options: Any) -> fem.Function:
        """A function of the scalar linear space."""
        V = fem.functionspace(self.u.function_space.mesh, ("Lagrange", 1))
        function = fem.Function(V, **options)
        function.x.array[:] = value
        return function
