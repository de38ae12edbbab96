# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia."""

from __future__ import annotations

from collections.abc import Iterator

import contactx as cx
from dolfinx.mesh import CellType

from scenes.flying import Flying


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
