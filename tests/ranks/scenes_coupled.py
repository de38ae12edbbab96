# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pressures and temperatures, quadratic displacements, and soft bodies on stiff ones."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import contactx as cx
from dolfinx.mesh import CellType

from dam_face import Compression
from dam_results import joints, laws
from dam_scene import Dam, DamSetting
from duncan_chang import DuncanChang
from meshes import DamFace, Tag
from scenes import Blocks
from scenes.coupled import Coupled, thermal
from scenes.heat import HeatedBlocks
from scenes.problems import make_problem
from scenes.tuning import tuned
from story import fix


def pressure_of_cells() -> Iterator[cx.ContactProblem]:
    yield from _solved("mixed, pressure first", CellType.tetrahedron)


def pressure_block() -> Iterator[cx.ContactProblem]:
    yield from _solved("blocks")


def bubbles() -> Iterator[cx.ContactProblem]:
    yield from _solved("neo-Hooke")


def heat() -> Iterator[cx.ContactProblem]:
    F, u, T, warm, hold, contact = thermal()
    problem = make_problem(F, [u, T], [contact], warm + hold, displacement=0)
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


def pressure_condensed() -> Iterator[cx.ContactProblem]:
    yield from _solved("mixed", CellType.tetrahedron, {"pc_type": "condensed"})


def _solved(
    kind: str, cell: CellType = CellType.triangle, solver: Any = None
) -> Iterator[cx.ContactProblem]:
    scene = Coupled(kind, cell, petsc_options=solver, friction=0.2)
    for down in (-0.03, -0.05):
        scene.down.value = down
        scene.problem.solve()
        yield scene.problem


def quadratic_triangles() -> Iterator[cx.ContactProblem]:
    yield from _dragged_quadratic(CellType.triangle, 6, 7, friction=0.3)


def quadratic_tetrahedra() -> Iterator[cx.ContactProblem]:
    yield from _dragged_quadratic(CellType.tetrahedron, 3, 4, friction=0.3)


def quadratic_hexahedra() -> Iterator[cx.ContactProblem]:
    # Nodes slide along edges: rough early solves decide which facet they are paired with
    yield from _dragged_quadratic(CellType.hexahedron, 3, 4, solver={"pc_type": "lu"})


def quadratic_tie() -> Iterator[cx.ContactProblem]:
    yield from _dragged_quadratic(CellType.tetrahedron, 2, 3, tied=True)


def quadratic_condensed() -> Iterator[cx.ContactProblem]:
    solver = {"pc_type": "condensed"}
    yield from _dragged_quadratic(CellType.tetrahedron, 3, 4, solver=solver, friction=0.2)


def _dragged_quadratic(
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


def by_bodies() -> Iterator[cx.ContactProblem]:
    yield from _dragged_by_bodies(1e3, friction=0.3)


def by_bodies_alike() -> Iterator[cx.ContactProblem]:
    yield from _dragged_by_bodies(1.0, tied=True)


def by_bodies_coarse_model() -> Iterator[cx.ContactProblem]:
    """A coarse model stands for the soft body."""
    with tuned(max_iterations=0):
        yield from _dragged_by_bodies(1e3, friction=0.3)


def by_bodies_held() -> Iterator[cx.ContactProblem]:
    """Slave nodes along an edge are held along it, and their masters by them."""
    yield from _dragged_by_bodies(1e3, edges=(Tag.UPPER_X0,), friction=0.6)


def dam_face() -> Iterator[cx.ContactProblem]:
    """Slabs on rockfill: nodes of corners are masters of two bodies and slaves of one."""
    yield from _dam(80.0)


def dam_face_in_increments() -> Iterator[cx.ContactProblem]:
    """The same with the E-B model, whose stress each rank has in its own cells."""
    yield from _dam(DuncanChang())


def _dam(rockfill: float | DuncanChang) -> Iterator[cx.ContactProblem]:
    model = DamFace(
        slabs=3,
        height=12.0,
        bed=0.2,
        shortest=0.5,
        rows=8,
        layers=1,
        joint_size=1.0,
        rockfill_cells=3,
        rockfill_rows=6,
    )
    options = (("pc_type", "condensed"), ("condensed_pc_type", "bodies"))
    # With so few cells friction in the joints leaves a choice
    dam = Dam(DamSetting(model, rockfill, joint_friction=0.0, options=options))
    compression = Compression(dam)
    for t in (1.0, 2.0, 3.0):
        dam.update(t, 2)
        dam.problem.solve()
        if dam.increments:
            dam.increments.commit()
        found = laws(dam)
        assert found.balance < 1e-7 and found.reactions < 1e-8 and found.coulomb < 1e-8
        assert found.penetration < 1e-9
        assert len(joints(dam, compression.update())) == 2
        yield dam.problem


def _dragged_by_bodies(
    stiffness: float, edges: tuple[int, ...] = (), **options: Any
) -> Iterator[cx.ContactProblem]:
    scene = Blocks(CellType.hexahedron, n_upper=3, n_lower=4, stiffness=stiffness)
    if edges:
        scene.bcs += [fix(scene.u, scene.tags, 0, 0.0, *edges)]
    else:
        push = fix(scene.u, scene.tags, 1, 0.0, Tag.UPPER_TOP)
        scene.bcs[scene.u.function_space.mesh.geometry.dim + 1] = push
    problem = scene.problem(
        scene.contact("small", **options),
        petsc_options={"pc_type": "condensed", "condensed_pc_type": "bodies"},
    )
    for way in (0.05, 0.06):
        if not edges:
            push.g.value[...] = way - 0.05
        scene.bcs[-2 if edges else -1].g.value[...] = -way
        problem.solve()
        yield problem
