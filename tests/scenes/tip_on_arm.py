# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The corner of a block pushes a cantilever down and slides along it."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, la, mesh

from scenes.grids import create, grid, outside
from scenes.materials import neo_hookean
from scenes.problems import make_problem
from story import displacement

THICKNESS, AT, SIDE = 0.1, 0.8, 0.2
ARM, TIP, FIXED, HEAD = 1, 2, 3, 4


class TipOnArm:
    """The arm is fixed at its left end, the block's upper sides are moved down.

    Attributes:
        contact: Contact of the block's lower sides with the arm's top; frictionless.
    """

    def __init__(self, n: int = 20, *, swapped: bool = False, **options: Any):
        parts = []
        for k, (length, height) in enumerate([(1.0, THICKNESS), (SIDE, SIDE)]):
            points, cells = grid([0, 0], [length, height], [round(n * length), round(n * height)])
            if k == 1:
                # A corner down
                turn = np.array([[1, -1], [1, 1]]) / np.sqrt(2)
                points = points @ turn.T + [AT, THICKNESS + 1e-4]
            parts.append((points, cells))
        domain = create(*parts)
        facets = outside(domain)
        at = mesh.compute_midpoints(domain, 1, facets)[:, :2]
        # Along the sides of the block
        s, t = ((at - [AT, THICKNESS + 1e-4]) @ np.array([[1, -1], [1, 1]]) / np.sqrt(2)).T
        values = np.zeros(len(facets), dtype=np.int32)
        values[np.isclose(at[:, 1], THICKNESS)] = ARM
        values[np.isclose(at[:, 0], 0)] = FIXED
        values[(np.isclose(t, 0) | np.isclose(s, 0)) & (at[:, 1] > THICKNESS)] = TIP
        values[(np.isclose(t, SIDE) | np.isclose(s, SIDE)) & (at[:, 1] > THICKNESS)] = HEAD
        tags = mesh.meshtags(domain, 1, facets, values)
        self.u = u = displacement(domain)
        V = u.function_space
        self.F = neo_hookean(u, 1.0, 0.3)
        self.way = fem.Constant(domain, np.zeros(2))
        self._head = fem.locate_dofs_topological(V, 1, tags.find(HEAD))
        fixed = fem.locate_dofs_topological(V, 1, tags.find(FIXED))
        self.bcs = [
            fem.dirichletbc(self.way, self._head, V),
            fem.dirichletbc(np.zeros(2), fixed, V),
        ]
        tip, arm = cx.Surface(tags, TIP), cx.Surface(tags, ARM)
        slave, master = (arm, tip) if swapped else (tip, arm)
        self.contact = cx.Contact(slave, master, **options)
        self.problem = make_problem(self.F, u, [self.contact], self.bcs)

    def pushed(self, depth: float = 0.3, steps: int = 30) -> tuple[np.ndarray, float]:
        """Push the block down.

        Returns:
            What the block's head is held with, and the work of that force.
        """
        form = fem.form(self.F)
        force, work = np.zeros(2), 0.0

        def update(t: float) -> None:
            self.way.value[1] = -depth * t

        before = np.zeros(2)
        for _ in cx.LoadSteps(self.problem, steps, update=update, progress=False):
            b = fem.assemble_vector(form)
            b.scatter_reverse(la.InsertMode.add)
            now = b.array.reshape(-1, 2)[self._head].sum(axis=0)
            work += (now + force) @ (self.way.value - before) / 2
            force, before = now, self.way.value.copy()
        return force, work

    def energy(self) -> float:
        """Energy that the bodies have stored."""
        u = self.u
        mu, lmbda = 1 / 2.6, 0.3 / (1.3 * 0.4)
        F = ufl.Identity(2) + ufl.grad(u)
        log_j = ufl.ln(ufl.det(F))
        density = mu / 2 * (ufl.tr(F.T * F) - 2 - 2 * log_j) + lmbda / 2 * log_j**2
        return float(fem.assemble_scalar(fem.form(density * ufl.dx)))
