# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies on rigid obstacles, some of which move."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import rigid_cylinder

import contactx as cx
from contactx.obstacles import Obstacle
from dolfinx.mesh import CellType

from scenes import Blocks, slender
from scenes.driven import DrivenBlock
from scenes.steps import DentedBlock, Sheared


def plane() -> Iterator[cx.ContactProblem]:
    """With friction; the mesh is a part of another one, of which a rank may have nothing."""
    scene = DrivenBlock(
        CellType.tetrahedron, plane=cx.Plane((0, 0, 0), (0, 0, 1)), gap=0.01, n_upper=4
    )
    for place in ((0.0, 0.0, -0.05), (0.03, 0.0, -0.06), (0.2, 0.1, -0.06)):
        scene.top.move(place)
        scene.problem.solve()
        yield scene.problem


def cylinder() -> Iterator[cx.ContactProblem]:
    problem, _ = rigid_cylinder.create(0.04, "finite")
    problem.solve()
    yield problem


def beam() -> Iterator[cx.ContactProblem]:
    """Through soft contact."""
    yield from _beam("lu")


def beam_condensed() -> Iterator[cx.ContactProblem]:
    """The same, by the condensed solver."""
    yield from _beam("condensed")


def _beam(solver: str) -> Iterator[cx.ContactProblem]:
    strip = slender.beam(120, "thin", petsc_options={"pc_type": solver})
    assert slender.press(strip, "thin").soft > 0
    yield strip.problem


def squeezed() -> Iterator[cx.ContactProblem]:
    """Steps are shortened so as to turn no cell inside out."""
    scene = Sheared(far=12.0, snes_max_it=50)
    scene.update(1.0)
    scene.problem.solve()
    assert scene.problem.report.limited > 0
    yield scene.problem


def level_set() -> Iterator[cx.ContactProblem]:
    yield from _pressed(cx.LevelSet(lambda x: x[0] ** 2 + (x[1] - 0.4) ** 2 + (x[2] + 2) ** 2 - 4))


def sphere() -> Iterator[cx.ContactProblem]:
    yield from _pressed(cx.Sphere((0.7, 0.6, -2.0), 2.0), friction=0.3)


def plastic() -> Iterator[cx.ContactProblem]:
    """A ball leaves a dent, whose history is that of the material; load steps."""
    scene = DentedBlock(aside=0.05)
    for _ in cx.LoadSteps(
        scene.problem, 3, update=scene.update, history=scene.history, progress=False
    ):
        scene.commit()
        yield scene.problem


def _pressed(obstacle: Obstacle, **options: Any) -> Iterator[cx.ContactProblem]:
    scene = Blocks(CellType.hexahedron, n_upper=5, n_lower=1)
    problem = scene.problem(scene.contact(master=obstacle, **options))
    for down in (0.05, 0.1):
        scene.bcs[-1].g.value[...] = -down
        scene.bcs[-2].g.value[...] = 0.1 * np.sign(down - 0.06)
        problem.solve()
        yield problem
