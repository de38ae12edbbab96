# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Quadratic displacements: facets whose parts other ranks need."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import contactx as cx
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from story import fix


def quadratic_triangles() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.triangle, 6, 7, friction=0.3)


def quadratic_quadrilaterals() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.quadrilateral, 6, 7)


def quadratic_tetrahedra() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.tetrahedron, 3, 4, friction=0.3)


def quadratic_hexahedra() -> Iterator[cx.ContactProblem]:
    # Nodes slide along edges: rough early solves decide which facet they are paired with
    yield from _dragged(CellType.hexahedron, 3, 4, solver={"pc_type": "lu"})


def quadratic_tie() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.tetrahedron, 2, 3, tied=True)


def quadratic_condensed() -> Iterator[cx.ContactProblem]:
    solver = {"pc_type": "condensed"}
    yield from _dragged(CellType.tetrahedron, 3, 4, solver=solver, friction=0.2)


def _dragged(
    cell: CellType, n_upper: int, n_lower: int, solver: Any = None, **options: Any
) -> Iterator[cx.ContactProblem]:
    """A block that is pressed and dragged over many facets."""
    scene = Blocks(cell, n_upper=n_upper, n_lower=n_lower, degree=2)
    push = fix(scene.u, scene.tags, 0, 0.0, Tag.UPPER_TOP)
    scene.bcs[scene.u.function_space.mesh.geometry.dim] = push
    problem = scene.problem(scene.contact(**options), petsc_options=solver)
    for way in (0.0, 0.02) if options.get("tied") else (0.0, 0.1, 0.2):
        push.g.value[...] = way
        problem.solve()
        yield problem
