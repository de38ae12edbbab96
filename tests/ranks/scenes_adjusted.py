# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies whose meshes do not fit, or have edges."""

from __future__ import annotations

from collections.abc import Iterator

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.ball_at_edge import BallAtEdge
from scenes.free_rings import FreeRings, pulled
from scenes.tip_on_arm import TipOnArm


def adjusted() -> Iterator[cx.ContactProblem]:
    """Blocks that overlap in the mesh, which counts as none."""
    scene = Blocks(CellType.quadrilateral, gap=-0.02, n_upper=7, n_lower=8)
    problem = scene.problem(scene.contact(friction=0.1, adjust=0.03))
    problem.solve()
    yield problem


def smooth_rings() -> Iterator[cx.ContactProblem]:
    """A ring of chords that stand for circles is pulled aside in another one."""
    rings = FreeRings(50, 80, fixed=True, smooth=True, adjust=0.02, friction=0.05, material=pulled)
    rings.problem.solve()
    yield rings.problem


def chords() -> Iterator[cx.ContactProblem]:
    """The same of chords as they are, with interference, as much as is warned of."""
    rings = FreeRings(24, 36, fixed=True, offset=0.05, friction=0.1, material=pulled)
    rings.problem.solve()
    assert rings.problem.report.audit.chords > 0
    yield rings.problem


def tip_on_arm() -> Iterator[cx.ContactProblem]:
    """A corner that slides along what it bends."""
    tip = TipOnArm(20)
    for depth in (0.05, 0.1):
        tip.way.value[1] = -depth
        tip.problem.solve()
        yield tip.problem


def edge() -> Iterator[cx.ContactProblem]:
    """A ball beside a plate's edge, which the ball's nodes do not see, as is warned of."""
    ball = BallAtEdge(0.28)
    ball.push()
    assert ball.problem.report.audit.edges > 0.1
    yield ball.problem
