# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""One block on a rigid obstacle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import dimension
from stress.blocks import bulk
from stress.scene import Case
from stress.tools import Tool


class Alone:
    """A block on an obstacle, with its top moved or loaded.

    Attributes:
        u: Displacement.
        contact: Its bottom on the obstacle.
        top: Displacement of the top, if it is moved.
        load: Traction on the top, if it is loaded.
        weight: Force on the volume.
        case: The case; its update is to be set.
    """

    def __init__(
        self,
        cell: CellType,
        tool: Callable[[mesh.Mesh], Tool],
        *,
        n: Sequence[int],
        size: Sequence[float] | None = None,
        moved: bool = True,
        material: str = "linear",
        nu: float = 0.3,
        **options: Any,
    ):
        """Make the block, its bottom at height zero.

        Args:
            cell: Kind of its cells.
            tool: Makes what it lies on.
            n: Cells along each axis.
            size: Its size; 1 along each axis if None.
            moved: Whether the top is moved.
            material: Material.
            nu: Poisson's ratio.
            options: Options of the contact.
        """
        dim = dimension(cell)
        size = (1.0,) * dim if size is None else size
        data = meshes.blocks(cell, n, (1,) * dim, size_upper=size)
        domain, tags = meshes.single(data, Tag.UPPER)
        V = fem.functionspace(domain, ("Lagrange", 1, (dim,)))
        self.u, self.top = fem.Function(V), fem.Function(V)
        self.load, self.weight = (fem.Constant(domain, np.zeros(dim)) for _ in range(2))
        v = ufl.TestFunction(V)
        ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
        F = bulk(self.u, fem.Constant(domain, 1.0), fem.Constant(domain, nu), material)
        F -= ufl.inner(self.load, v) * ds(int(Tag.UPPER_TOP)) + ufl.inner(self.weight, v) * ufl.dx
        bcs = []
        if moved:
            dofs = fem.locate_dofs_topological(V, dim - 1, tags.find(Tag.UPPER_TOP))
            bcs.append(fem.dirichletbc(self.top, dofs))
        floor = tool(domain)
        bottom = cx.Surface(tags, Tag.UPPER_CONTACT)
        self.contact = cx.Contact(bottom, floor.obstacle, **options)
        problem = cx.ContactProblem(
            F, self.u, contacts=[self.contact], bcs=bcs, petsc_options_prefix="alone_"
        )
        self.case = Case(
            problem, [self.contact], F, bcs, lambda t: None, size=min(size), tools=[floor]
        )
