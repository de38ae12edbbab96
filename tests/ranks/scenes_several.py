# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies on rigid obstacles, several contacts, nodes in more than one, load steps that are cut."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import stacked_blocks

import contactx as cx
import ufl
from contactx.obstacles import Obstacle
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag, block_tag
from scenes import NU, Blocks, slender
from scenes.balls import LooseBalls
from scenes.driven import DrivenBlock
from scenes.problems import make_problem
from scenes.steps import DentedBlock, Sheared
from story import displacement, elasticity, fix, traction


def plane() -> Iterator[cx.ContactProblem]:
    """With friction; the mesh is a part of another one, of which a rank may have nothing."""
    scene = DrivenBlock(
        CellType.tetrahedron, plane=cx.Plane((0, 0, 0), (0, 0, 1)), gap=0.01, n_upper=4
    )
    for place in ((0.0, 0.0, -0.05), (0.03, 0.0, -0.06), (0.2, 0.1, -0.06)):
        scene.top.move(place)
        scene.problem.solve()
        yield scene.problem


def beam() -> Iterator[cx.ContactProblem]:
    """Along the path of an interior point."""
    yield from _beam("lu")


def beam_condensed() -> Iterator[cx.ContactProblem]:
    """The same, by the condensed solver."""
    yield from _beam("condensed")


def _beam(solver: str) -> Iterator[cx.ContactProblem]:
    strip = slender.beam(200, "deep", petsc_options={"pc_type": solver})
    assert slender.press(strip, "deep").interior > 0
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


def corner_3d() -> Iterator[cx.ContactProblem]:
    """A block without supports in the corner of floor and wall, and another floor below."""
    scene = Blocks(CellType.tetrahedron, n_upper=3)
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
    problem = make_problem(elasticity(u, 1.0, NU), u, contacts, bcs, petsc_options=solver)
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
    assert scene.calls == [1.0, 0.5, 1.0, 0.75, 1.0]


def loose_discs() -> Iterator[cx.ContactProblem]:
    """Discs that nothing holds make room for a lid, and are pressed by it."""
    balls = LooseBalls(friction=0.3)
    for _ in cx.LoadSteps(balls.problem, 4, update=lambda t: balls.push(1.6 * t), progress=False):
        yield balls.problem


def penetrated() -> Iterator[cx.ContactProblem]:
    """A fluid goes round a block on a slab, and under it where the block is tilted."""
    scene = Blocks(CellType.tetrahedron, n_upper=3, n_lower=5)
    contact = scene.contact(friction=0.3)
    domain, faces = scene.u.function_space.mesh, (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
    fluid = cx.FluidPenetration(
        domain,
        cx.Surface(scene.tags, *faces),
        entry=lambda x: np.isclose(x[0], 0.0) | np.isclose(x[0], 0.23),
        contacts=[contact],
    )
    ds = ufl.Measure("ds", domain, subdomain_data=scene.tags)
    v, N = ufl.TestFunction(scene.u.function_space), ufl.FacetNormal(domain)
    p = fem.Constant(domain, 0.0)
    load = 0.05 + 0.16 * (ufl.SpatialCoordinate(domain)[0] - 0.73)
    F = scene.F + load * v[2] * ds(int(Tag.UPPER_TOP)) + p * fluid.wet * ufl.dot(v, N) * ds(faces)
    problem = make_problem(F, scene.u, [contact], scene.bcs[:3])
    for p.value in (0.0, 0.02):
        problem.solve()
        while fluid.update():
            problem.solve()
        yield problem
