# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slender bodies that lie along each other: a cantilever over a circle, leaves of a spring."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.grids import chosen, create, grid, middles, outside
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem
from story import displacement

# Cantilever: length, thickness, radius of the circle, length that lies on it, Young's modulus
LENGTH, THICKNESS, RADIUS, LYING, YOUNG = 1.2, 0.02, 12.0, 0.6, 1e6
# Leaves: number, length of the longest, thickness, way of the clamp
LEAVES, LONGEST, LEAF, LIFT = 5, 300.0, 5.0, 10.0


def cantilever(
    cells: int, material: Callable[..., ufl.Form], nu: float = 0.0, **options: Any
) -> cx.Report:
    """Bend a cantilever over a circle by a force at its end, in one step.

    In theory of beams half of it lies on the circle, without pressure but at both ends of that
    part.
    """
    domain = mesh.create_rectangle(
        MPI.COMM_WORLD, [[0, 0], [LENGTH, THICKNESS]], [cells, 6], mesh.CellType.quadrilateral
    )
    facets = outside(domain)
    at, _ = middles(domain, facets)
    bottom, end = np.isclose(at[:, 1], 0), np.isclose(at[:, 0], LENGTH)
    values = np.where(bottom, 1, np.where(end, 2, 0))
    tags = chosen(domain, facets, values)
    u = displacement(domain)
    V = u.function_space
    moment = YOUNG * THICKNESS**3 / 12 / (RADIUS + THICKNESS / 2)
    load = moment / (LENGTH - LYING) / THICKNESS
    ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
    F = material(u, YOUNG, nu) + load * ufl.TestFunction(V)[1] * ds(2)
    clamped = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[0], 0))
    bc = fem.dirichletbc(np.zeros(2), clamped, V)
    contact = cx.Contact(cx.Surface(tags, 1), cx.Sphere((0.0, -RADIUS), RADIUS), **options)
    problem = make_problem(F, u, [contact], [bc])
    problem.solve()
    return problem.report


def leaves(cells: int, **options: Any) -> cx.Report:
    """Lift the clamp of a spring whose end is held, in one step.

    Its leaves touch along their whole length at the start.
    """
    parts = []
    for i in range(LEAVES):
        length = LONGEST * (i + 1) / LEAVES
        n = round(cells * (i + 1) / LEAVES)
        parts.append(grid([0, LEAF * i], [length, LEAF * (i + 1)], [n, 1]))
    domain = create(*parts)
    facets = outside(domain)
    at, of_cell = middles(domain, facets)
    leaf = (of_cell[:, 1] / LEAF).astype(np.int32)
    top, bottom = np.isclose(at[:, 1], LEAF * (leaf + 1)), np.isclose(at[:, 1], LEAF * leaf)
    values = np.where(top, 10 + leaf, np.where(bottom, 20 + leaf, 0))
    tags = chosen(domain, facets, values)
    u = fem.Function(fem.functionspace(domain, ("Lagrange", 2, (2,))))
    V = u.function_space
    held, _ = V.sub(1).collapse()
    corner = fem.locate_dofs_geometrical(
        (V.sub(1), held), lambda x: np.isclose(x[0], LONGEST) & np.isclose(x[1], LEAF * LEAVES)
    )[0]
    clamped = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[0], 0))
    bcs = [
        fem.dirichletbc(np.array([0.0, LIFT]), clamped, V),
        fem.dirichletbc(0.0, corner, V.sub(1)),
    ]
    contacts = [
        cx.Contact(cx.Surface(tags, 10 + i), cx.Surface(tags, 21 + i), **options)
        for i in range(LEAVES - 1)
    ]
    problem = make_problem(st_venant_kirchhoff(u, 2.1e5, 0.3), u, contacts, bcs)
    problem.solve()
    return problem.report
