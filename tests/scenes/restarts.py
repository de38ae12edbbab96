# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes whose steps are gone on with from a checkpoint."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

from scenes.steps import DentedBlock, LooseBlock, SlidingBlocks

FACETS = {"method": "surface-to-surface"}
SCENES = {
    "triangles": lambda: SlidingBlocks(CellType.triangle),
    "hexahedra": lambda: SlidingBlocks(CellType.hexahedron),
    "small sliding": lambda: SlidingBlocks(CellType.tetrahedron, sliding="small"),
    "friction": lambda: SlidingBlocks(CellType.tetrahedron, friction=0.2),
    # One pair goes back and forth and is frozen
    "friction, plane": lambda: SlidingBlocks(CellType.quadrilateral, friction=0.2),
    "friction, small": lambda: SlidingBlocks(CellType.triangle, friction=0.2, sliding="small"),
    "tied": lambda: SlidingBlocks(CellType.tetrahedron, tied=True, offset=0.01),
    "facets, small": lambda: SlidingBlocks(CellType.hexahedron, sliding="small", **FACETS),
    "facets, friction": lambda: SlidingBlocks(CellType.tetrahedron, friction=0.2, **FACETS),
    "free body": LooseBlock,
    "plastic under a ball": DentedBlock,
    "plastic with friction": lambda: DentedBlock(friction=0.3),
    "plastic, tied to a ball": lambda: DentedBlock(0.01, tied=True, search_distance=0.03),
}

# The rest takes longer
QUICK = ("friction, plane", "facets, small", "plastic, tied to a ball")


def run(scene: Any, until: int | None = None, **options: Any) -> tuple[list[bytes], cx.LoadSteps]:
    """Take steps, six in all if none is cut, and return the bits of their results."""
    steps = cx.LoadSteps(
        scene.problem, 6, scene.update, history=scene.history, progress=False, **options
    )
    for step in steps:
        scene.commit()
        if step.index == until:
            break
    discrete = scene.contact.discrete
    arrays = [scene.u.x.array, *(f.x.array for f in scene.history)]
    arrays += [*discrete.save().values(), scene.contact.force]
    return [a.tobytes() for a in arrays], steps


def check_restart(name: str, file: Path) -> None:
    """Steps that are gone on with from a file end in the same bits as without it."""
    first = SCENES[name]()
    straight, _ = run(first)
    assert first.contact.multiplier.any()
    assert all(f.x.array.any() for f in first.history)
    middle, _ = run(SCENES[name](), until=4, checkpoint=file)
    assert middle != straight
    scene = SCENES[name]()
    restarted, steps = run(scene, restart=file)
    assert restarted == straight
    assert steps.t == 1
    lines = [line.split("│")[1:3] for line in steps.table().splitlines() if "│" in line]
    assert [int(index) for index, _ in lines] == list(range(1, len(lines) + 1))
    assert np.all(np.diff([float(t) for _, t in lines]) > 0)
