# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Deformable bodies: pressed, tied, free, and rubbing: they stick, slip and are dragged far."""

from __future__ import annotations

from collections.abc import Iterator

import cattaneo_mindlin
import hertz_axisymmetric
import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import NU, Blocks, HertzSphere
from scenes.driven import DrivenBlock
from scenes.problems import make_problem, pair_of
from scenes.tower import Tower
from story import displacement, elasticity, fix, traction


def axisymmetric() -> Iterator[cx.ContactProblem]:
    """Areas and integrals are weighted with the radius."""
    scene = Blocks(CellType.quadrilateral, n_upper=7, n_lower=8)
    scene.F = hertz_axisymmetric.elasticity(scene.u, 1.0, 0.3)
    r = ufl.SpatialCoordinate(scene.u.function_space.mesh)[0]
    problem = scene.problem(scene.contact(friction=0.1, weight=2 * ufl.pi * r))
    problem.solve()
    yield problem


def hertz_3d() -> Iterator[cx.ContactProblem]:
    scene = HertzSphere(meshes.hertz_sphere(0.05), "finite")
    for t in (0.5, 1.0, 0.3):
        scene.update(t)
        scene.problem.solve()
        yield scene.problem


def hertz_condensed() -> Iterator[cx.ContactProblem]:
    scene = HertzSphere(meshes.hertz_sphere(0.1), "small", petsc_options={"pc_type": "condensed"})
    for t in (0.5, 1.0):
        scene.update(t)
        scene.problem.solve()
        yield scene.problem


def tied() -> Iterator[cx.ContactProblem]:
    tower = Tower(CellType.tetrahedron, 3, 2, tied=True, nu=0.3, shift=0.2)
    tower.solve(0.02, 0.01, 0.05)
    yield tower.problem


def tied_turning() -> Iterator[cx.ContactProblem]:
    """A tie of soft bodies that turn as a whole."""
    tower = Tower(CellType.quadrilateral, 9, 7, tied=True, nu=0.3, neo=True)
    for angle in (0.2, 0.4):
        c, s = np.cos(angle), np.sin(angle)
        tower.move(lambda x, c=c, s=s: x @ np.array([[c, s], [-s, 1.05 * c]]))
        yield tower.problem


def floating_2d() -> Iterator[cx.ContactProblem]:
    yield from _floating(CellType.triangle, 7, 9)


def floating_3d() -> Iterator[cx.ContactProblem]:
    yield from _floating(CellType.hexahedron, 3, 4)


def _floating(cell: CellType, n_upper: int, n_lower: int) -> Iterator[cx.ContactProblem]:
    """A block without supports falls through a gap and comes to rest under a push."""
    scene = Blocks(cell, gap=0.1, n_upper=n_upper, n_lower=n_lower)
    gdim = len(scene.u)
    scene.bcs = scene.bcs[:gdim]
    force = np.zeros(gdim)
    force[0], force[-1] = 0.003, -0.01
    load = fem.Constant(scene.u.function_space.mesh, force)
    scene.F += traction(scene.u, scene.tags, Tag.UPPER_TOP, load)
    problem = scene.problem(scene.contact(friction=0.5))
    problem.solve()
    yield problem


def floating_smooth() -> Iterator[cx.ContactProblem]:
    """A block that is only guided sideways, without friction."""
    scene = Blocks(CellType.quadrilateral, n_upper=8, n_lower=11)
    load = fem.Constant(scene.u.function_space.mesh, (0.0, -0.05))
    scene.F += traction(scene.u, scene.tags, Tag.UPPER_TOP, load)
    scene.bcs = [*scene.bcs[:2], fix(scene.u, scene.tags, 0, 0.0, Tag.UPPER_X0)]
    problem = scene.problem(scene.contact("small"))
    for value in (-0.05, -0.1):
        load.value[1] = value
        problem.solve()
        yield problem


def sliding_block() -> Iterator[cx.ContactProblem]:
    """Over an elastic base, to and fro: open, sticking and slipping nodes."""
    scene = DrivenBlock(CellType.quadrilateral, n_upper=9, n_lower=12)
    for x, y in ((0.0, -0.05), (0.02, -0.05), (0.3, -0.06), (0.25, -0.06)):
        scene.top.move((x, y))
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
    contact = pair_of(tags, friction=0.2)
    problem = make_problem(
        elasticity(u, 1.0, NU),
        u,
        [contact],
        [*moved, *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim))],
        petsc_options=options,
    )
    for x in np.linspace(0, 3.7, steps + 1):
        moved[0].g.value[...] = x
        moved[-1].g.value[...] = -0.02
        problem.solve()
        yield problem
