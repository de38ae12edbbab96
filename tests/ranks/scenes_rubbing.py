# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Friction: blocks that stick, slip and are dragged far."""

from __future__ import annotations

from collections.abc import Iterator

import cattaneo_mindlin
import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import NU, HertzSphere
from scenes.driven import DrivenBlock
from story import displacement, elasticity, fix


def sliding_block() -> Iterator[cx.ContactProblem]:
    """Over an elastic base, to and fro: open, sticking and slipping nodes."""
    scene = DrivenBlock(CellType.quadrilateral, n_upper=9, n_lower=12)
    for x, y in ((0.0, -0.05), (0.02, -0.05), (0.3, -0.06), (0.25, -0.06)):
        scene.top.move((x, y))
        scene.problem.solve()
        yield scene.problem


def sliding_3d() -> Iterator[cx.ContactProblem]:
    scene = DrivenBlock(CellType.hexahedron, n_upper=4, n_lower=5, width=2.0, shift=0.4)
    for place in ((0.0, 0.0, -0.05), (0.1, 0.02, -0.05), (0.2, 0.15, -0.05)):
        scene.top.move(place)
        scene.problem.solve()
        yield scene.problem


def friction_condensed() -> Iterator[cx.ContactProblem]:
    scene = HertzSphere(
        meshes.hertz_sphere(0.1), "finite", friction=0.3, petsc_options={"pc_type": "condensed"}
    )
    for t in (0.5, 1.0):
        scene.update(t)
        scene.problem.solve()
        yield scene.problem


def dragged_condensed() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.hexahedron, (4, 3, 2), (16, 4, 2), 2, pc_type="condensed")


def partial_slip() -> Iterator[cx.ContactProblem]:
    """Cattaneo and Mindlin: two cylinders pressed without friction, then pushed with it."""
    scene = cattaneo_mindlin.create(0.15, "finite")
    for press, push in ((-0.09, 0.0), (-0.18, 0.0), (-0.18, 0.012), (-0.18, 0.024)):
        scene.friction.value = cattaneo_mindlin.FRICTION if push else 0.0
        scene.press.g.value[...], scene.push.g.value[...] = press, push
        scene.problem.solve()
        yield scene.problem


def dragged_2d() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.triangle, (6, 3), (36, 3), 8)


def dragged_3d() -> Iterator[cx.ContactProblem]:
    yield from _dragged(CellType.hexahedron, (4, 3, 2), (16, 4, 2), 6)


def _dragged(
    cell: CellType, n_upper: tuple[int, ...], n_lower: tuple[int, ...], steps: int, **options: str
) -> Iterator[cx.ContactProblem]:
    """A block dragged over a base five times its length: from the parts of one rank to others."""
    gdim = len(n_upper)
    data = meshes.blocks(
        cell,
        n_upper,
        n_lower,
        size_upper=(*(1.0, 0.7, 0.5)[: gdim - 1], 0.5),
        size_lower=(*(5.0, 1.0, 0.5)[: gdim - 1], 0.5),
        shift=(0.1, 0.15)[: gdim - 1],
    )
    tags, u = data.facet_tags, displacement(data.mesh)
    moved = [fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(gdim)]
    contact = cx.Contact(
        cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT), friction=0.2
    )
    problem = cx.ContactProblem(
        elasticity(u, 1.0, NU),
        u,
        contacts=[contact],
        bcs=[*moved, *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim))],
        petsc_options_prefix="dragged_",
        petsc_options=options,
    )
    for x in np.linspace(0, 3.7, steps + 1):
        moved[0].g.value[...] = x
        moved[-1].g.value[...] = -0.02
        problem.solve()
        yield problem
