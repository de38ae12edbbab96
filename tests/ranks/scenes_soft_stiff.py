# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Soft bodies on stiff ones: factors of blocks that several ranks have parts of."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from unittest.mock import patch

import contactx as cx
from contactx._host.condensed import soft_stiff as solver
from dolfinx.mesh import CellType

from dam_face import Compression
from dam_results import joints, laws
from dam_scene import Dam, DamSetting
from duncan_chang import DuncanChang
from meshes import DamFace, Tag
from scenes import Blocks
from story import fix


def by_bodies() -> Iterator[cx.ContactProblem]:
    yield from _dragged(1e3, friction=0.3)


def by_bodies_alike() -> Iterator[cx.ContactProblem]:
    yield from _dragged(1.0, tied=True)


def by_bodies_coarse_model() -> Iterator[cx.ContactProblem]:
    """A coarse model stands for the soft body."""
    with patch.object(solver, "_MAX_ITERATIONS_WITH_SPRINGS", 0):
        yield from _dragged(1e3, friction=0.3)


def by_bodies_held() -> Iterator[cx.ContactProblem]:
    """Slave nodes along an edge are held along it, and their masters by them."""
    yield from _dragged(1e3, edges=(Tag.UPPER_X0,), friction=0.6)


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


def _dragged(
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
