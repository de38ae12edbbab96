# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block with a closed crack, whose faces share the nodes of its tip."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx
from dolfinx import fem, mesh

from scenes.grids import create, grid, middles, outside
from scenes.problems import make_problem
from story import displacement, elasticity

ABOVE, BELOW, BOTTOM, TOP = 1, 2, 3, 4
# Cells along each side
N = 8


class Cracked:
    """A unit block, its bottom fixed and its top moved, with a crack in the middle of it.

    Attributes:
        tags: Facet tags of the faces of the crack, the bottom and the top.
    """

    def __init__(self, gdim: int, *, crack: bool = True, stitch: bool = False):
        """Create the block.

        Args:
            stitch: Whether its faces share the node in the middle of them, too.
        """
        x, cells = grid([0.0] * gdim, [1.0] * gdim, [N] * gdim)
        if crack:
            # Nodes within the crack, without its tip, are twice there
            inner = np.abs(x[:, :-1] - 0.5).max(axis=1) < 0.25 - 1e-9
            inner &= np.isclose(x[:, -1], 0.5)
            if stitch:
                inner &= np.abs(x - 0.5).max(axis=1) > 1e-9
            twin = np.arange(len(x))
            twin[inner] = len(x) + np.arange(inner.sum())
            above = x[cells].mean(axis=1)[:, -1] > 0.5
            cells = np.where(above[:, None], twin[cells], cells)
            x = np.concatenate([x, x[inner]])
        domain = create((x, cells))
        self.u = displacement(domain)
        self.tags = self._tagged(domain)

    @staticmethod
    def _tagged(domain: mesh.Mesh) -> mesh.MeshTags:
        facets = outside(domain)
        at, of_cells = middles(domain, facets)
        height = at[:, -1]
        above = of_cells[:, -1] > 0.5
        values = np.zeros(len(facets), dtype=np.int32)
        on_side = np.isclose(np.abs(at[:, :-1] - 0.5).max(axis=1), 0.5)
        values[np.isclose(height, 0.5) & ~on_side] = BELOW
        values[np.isclose(height, 0.5) & ~on_side & above] = ABOVE
        values[np.isclose(height, 0)] = BOTTOM
        values[np.isclose(height, 1)] = TOP
        return mesh.meshtags(domain, domain.topology.dim - 1, facets, values)

    def contact(self, **options: Any) -> cx.Contact:
        return cx.Contact(cx.Surface(self.tags, ABOVE), cx.Surface(self.tags, BELOW), **options)

    def problem(self, contacts: list[cx.Contact], **options: Any) -> cx.ContactProblem:
        """The top goes down by a hundredth."""
        u = self.u
        V, gdim = u.function_space, len(u)
        moved = np.zeros(gdim)
        moved[-1] = -0.01
        bcs = [
            fem.dirichletbc(value, fem.locate_dofs_topological(V, gdim - 1, self.tags.find(tag)), V)
            for tag, value in ((BOTTOM, np.zeros(gdim)), (TOP, moved))
        ]
        return make_problem(elasticity(u, 1.0, 0.3), u, contacts, bcs, **options)

    def at_nodes(self) -> np.ndarray:
        """Positions and displacements of all nodes in the order of the positions."""
        gdim = len(self.u)
        x = self.u.function_space.tabulate_dof_coordinates()[:, :gdim]
        rows = np.hstack([x.round(9), self.u.x.array.reshape(-1, gdim)])
        return rows[np.lexsort(rows.T[::-1])]
