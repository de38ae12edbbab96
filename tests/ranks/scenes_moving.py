# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia, a surface on itself, and bodies whose meshes do not fit, or have edges."""

from __future__ import annotations

from collections.abc import Iterator

from closing_clip import CLOSING, Clip
from settling_discs import Box

import contactx as cx
from dolfinx.mesh import CellType

from scenes import Blocks
from scenes.ball_at_edge import BallAtEdge
from scenes.flying import Flying
from scenes.free_rings import FreeRings, pulled
from scenes.thin_sheets import ThinSheets
from scenes.tip_on_arm import TipOnArm


def flying_2d() -> Iterator[cx.ContactProblem]:
    """A block hits another one askew, with friction, and bounces."""
    yield from _fly(Flying(CellType.quadrilateral, friction=0.2, impact_travel=1.0))


def flying_3d() -> Iterator[cx.ContactProblem]:
    """The same in space, with consistent masses."""
    yield from _fly(Flying(CellType.tetrahedron, friction=0.2, mass="consistent"))


def _fly(scene: Flying) -> Iterator[cx.ContactProblem]:
    impulse = 0.0
    for _ in range(12):
        scene.dynamics.solve()
        balance = scene.dynamics.report.balance
        assert balance is not None
        impulse += float(balance.impulse[0][-1])
        yield scene.dynamics
    assert impulse > 0.1


NODES = "node-to-surface"


def clip() -> Iterator[cx.ContactProblem]:
    """Tips that are far apart along the boundary come together."""
    clip = Clip(0.2, friction=0.2, method=NODES)
    for load in (0.5, 1.0, 1.5, 2.0):
        clip.press(load * CLOSING)
        clip.problem.solve()
        yield clip.problem


def sheets() -> Iterator[cx.ContactProblem]:
    """A sheet has contact on both sides."""
    sheets = ThinSheets(friction=0.3, method=NODES)
    sheets.problem.solve()
    yield sheets.problem


def discs() -> Iterator[cx.ContactProblem]:
    """Discs fall onto one another."""
    box = Box(0.2, rows=2, columns=2, method=NODES)
    for _ in box.fall():
        yield box.problem
        if box.steps >= 4:
            return


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
