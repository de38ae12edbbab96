# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Several contacts, nodes in more than one, and load steps that are cut."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import stacked_blocks

import contactx as cx
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag, block_tag
from scenes import NU, Blocks
from scenes.steps import Sheared
from story import displacement, elasticity, fix, traction


def corner_2d() -> Iterator[cx.ContactProblem]:
    yield from _corner(CellType.quadrilateral, 6)


def corner_3d() -> Iterator[cx.ContactProblem]:
    yield from _corner(CellType.tetrahedron, 3)


def _corner(cell: CellType, n: int) -> Iterator[cx.ContactProblem]:
    """A block without supports in the corner of floor and wall, and another floor below."""
    scene = Blocks(cell, n_upper=n)
    u, tags, gdim = scene.u, scene.tags, len(scene.u)
    up, aside = np.eye(gdim)[-1], np.eye(gdim)[0]
    for face, load in ((Tag.UPPER_TOP, up), (Tag.UPPER_X1, aside)):
        scene.F += traction(u, tags, face, fem.Constant(u.function_space.mesh, -0.01 * load))
    scene.bcs = scene.bcs[:gdim]
    foot, side = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.UPPER_X0)
    planes = [(foot, 0 * up, up), (side, 0.23 * aside, aside), (foot, -0.001 * up, up)]
    problem = scene.problem(
        *(cx.Contact(face, cx.Plane(point, n), friction=0.3) for face, point, n in planes)
    )
    problem.solve()
    yield problem


def chain() -> Iterator[cx.ContactProblem]:
    """The middle one of three blocks is slave below and master above, on edge nodes both."""
    yield from _chain(None)


def chain_condensed() -> Iterator[cx.ContactProblem]:
    yield from _chain({"pc_type": "condensed"})


def _chain(solver: Any) -> Iterator[cx.ContactProblem]:
    data = meshes.stack(CellType.hexahedron, [(3,) * 3, (4,) * 3, (5,) * 3])
    tags, u = data.facet_tags, displacement(data.mesh)
    bcs = [
        *(fix(u, tags, i, 0.0, block_tag(0, "bottom")) for i in range(3)),
        *(fix(u, tags, i, 0.0, block_tag(2, "top")) for i in range(2)),
        fix(u, tags, 2, -0.05, block_tag(2, "top")),
    ]
    surface = {k: [cx.Surface(tags, block_tag(k, s)) for s in ("bottom", "top")] for k in range(3)}
    contacts = [
        cx.Contact(surface[1][0], surface[0][1], friction=0.3),
        cx.Contact(surface[2][0], surface[1][1], tied=True),
    ]
    problem = cx.ContactProblem(
        elasticity(u, 1.0, NU),
        u,
        contacts=contacts,
        bcs=bcs,
        petsc_options_prefix="chain_",
        petsc_options=solver,
    )
    problem.solve()
    yield problem


def stack() -> Iterator[cx.ContactProblem]:
    """Five free blocks on a floor that nothing but friction holds."""
    problem, _, load = stacked_blocks.create(0.2, "finite", 2)
    for t in (0.5, 1.0):
        load.value[:] = t * stacked_blocks.SHEAR, -t * stacked_blocks.PRESSURE
        problem.solve()
        yield problem


def cut() -> Iterator[cx.ContactProblem]:
    """A step whose cells turn inside out is halved."""
    scene = Sheared()
    for _ in scene.steps(1):
        yield scene.problem
    assert scene.calls == [1.0, 0.5, 1.0]


def valley() -> Iterator[cx.ContactProblem]:
    """Two planes, and a node at the bottom that may need both."""
    data = meshes.blocks(CellType.quadrilateral, (9, 4), (1, 1))
    domain, tags = meshes.single(data, Tag.UPPER)
    u = displacement(domain)
    foot = cx.Surface(tags, Tag.UPPER_CONTACT)
    normals = [(np.sin(angle), np.cos(angle)) for angle in (0.2, -0.2)]
    contacts = [cx.Contact(foot, cx.Plane((1 / 3, 0), n), friction=0.3) for n in normals]
    down = fix(u, tags, 1, 0.0, Tag.UPPER_TOP)
    problem = cx.ContactProblem(
        elasticity(u, 1.0, NU),
        u,
        contacts=contacts,
        bcs=[fix(u, tags, 0, 0.0, Tag.UPPER_TOP), down],
        petsc_options_prefix="valley_",
    )
    for depth in (0.03, 0.06, 0.09):
        down.g.value[...] = -depth
        problem.solve()
        yield problem
