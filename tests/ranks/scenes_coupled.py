# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Displacements that are solved for together with pressures and temperatures."""

from __future__ import annotations

from collections.abc import Iterator

import contactx as cx
from dolfinx.mesh import CellType

from scenes.coupled import Coupled, thermal
from scenes.heat import HeatedBlocks


def pressure_of_cells() -> Iterator[cx.ContactProblem]:
    yield from _solved("mixed, pressure first", CellType.tetrahedron)


def pressure_block() -> Iterator[cx.ContactProblem]:
    yield from _solved("blocks")


def bubbles() -> Iterator[cx.ContactProblem]:
    yield from _solved("neo-Hooke")


def heat() -> Iterator[cx.ContactProblem]:
    F, u, T, warm, hold, contact = thermal()
    problem = cx.ContactProblem(
        F, [u, T], contacts=[contact], bcs=warm + hold, displacement=0,
        petsc_options_prefix="heat_",
    )  # fmt: skip
    problem.solve()
    yield problem


def heat_across() -> Iterator[cx.ContactProblem]:
    """Heat from the one body to the other, which presses them; and what each sees of the other."""
    scene = HeatedBlocks(CellType.tetrahedron, friction=0.2, gap=0.01)
    problem = scene.problem()
    for hot in (40.0, 100.0):
        scene.heat[0].g.value[...] = hot
        problem.solve()
        yield problem


def _solved(kind: str, cell: CellType = CellType.triangle) -> Iterator[cx.ContactProblem]:
    scene = Coupled(kind, cell, friction=0.2)
    for down in (-0.03, -0.05):
        scene.down.value = down
        scene.problem.solve()
        yield scene.problem
