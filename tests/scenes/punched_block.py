# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block under a rigid ball or a narrow punch, of which the mesh may be much finer."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
from dolfinx import fem, mesh

from scenes.grids import create, grid, middles, outside
from scenes.problems import make_problem
from story import displacement, elasticity

TOP, FOOT, BOTTOM, HEAD = 1, 2, 3, 4


class PunchedBlock:
    """The block is from -1 to 1, its top at height 0, its bottom fixed.

    Attributes:
        contact: Contact of its top with what presses it.
    """

    def __init__(
        self,
        gdim: int,
        *,
        n: int,
        ball: float | None = None,
        punch: int = 0,
        width: float = 0.2,
        lean: float = 0.0,
        around: bool = False,
        x0: float = 0.0,
        down: float = 0.02,
        swapped: bool = False,
        audit: str = "refuse",
        **options: Any,
    ):
        """Create the block.

        Args:
            ball: Radius of a rigid ball, or
            punch: cells along a deformable punch, in the plane.
            lean: By how much its head is wider, over its foot: its sides lean outward.
            around: Whether its sides are part of the foot's surface, to its edges.
            x0: Place of the ball or the middle of the punch along the top.
        """
        parts = [grid([-1] * gdim, [1] * (gdim - 1) + [0], [n] * (gdim - 1) + [max(2, n // 2)])]
        if punch:
            foot = [x0 - width / 2, 0]
            parts.append(grid(foot, [foot[0] + width, width], [punch, punch]))
            x = parts[-1][0]
            x[:, 0] = x0 + (x[:, 0] - x0) * (1 + lean * x[:, 1] / width)
        domain = create(*parts)
        self.u = u = displacement(domain)
        V, tags = u.function_space, _tagged(domain, width, around)

        def fixed(tag: int, value: np.ndarray) -> fem.DirichletBC:
            return fem.dirichletbc(
                value, fem.locate_dofs_topological(V, gdim - 1, tags.find(tag)), V
            )

        bcs, top = [fixed(BOTTOM, np.zeros(gdim))], cx.Surface(tags, TOP)
        if ball is None:
            bcs.append(fixed(HEAD, -down * np.eye(gdim)[-1]))
            foot_of_punch = cx.Surface(tags, FOOT)
            sides = (foot_of_punch, top) if swapped else (top, foot_of_punch)
            self.contact = cx.Contact(*sides, **options)
        else:
            self.centre = fem.Constant(domain, np.full(gdim, x0))
            self.centre.value[-1] = ball - down
            self.contact = cx.Contact(top, cx.Sphere(self.centre, ball), **options)
        self.problem = make_problem(elasticity(u, 1.0, 0.3), u, [self.contact], bcs, audit=audit)


def _tagged(domain: mesh.Mesh, height: float, around: bool) -> mesh.MeshTags:
    """Tags of top, foot, bottom and head, in that order; the foot's may go around its edges."""
    facets = outside(domain)
    at, of_cells = (points[:, -1] for points in middles(domain, facets))
    above = of_cells > 0
    size = domain.comm.allreduce(np.abs(domain.geometry.x).max(initial=0.0), MPI.MAX)
    bottom = domain.comm.allreduce(at.min(initial=np.inf), MPI.MIN)
    values = np.zeros(len(facets), dtype=np.int32)
    values[(np.abs(at) < 1e-9 * size) & ~above] = TOP
    values[above if around else (np.abs(at) < 1e-9 * size) & above] = FOOT
    values[np.abs(at - bottom) < 1e-9 * size] = BOTTOM
    values[(np.abs(at - height) < 1e-9 * size) & above] = HEAD
    return mesh.meshtags(domain, domain.topology.dim - 1, facets, values)
