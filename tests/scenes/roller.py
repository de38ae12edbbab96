# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A steel roller that is pressed into a soft block."""

from __future__ import annotations

from typing import Any

import contactx as cx

from scenes.problems import make_problem
from stress.grids import disc, even, grid
from stress.parts import Parts

# How deep it goes, by its radius
DEPTH = 0.3


class Roller:
    """The roller and the block, which is the slave."""

    def __init__(self, material: str, method: str, friction: float, *, n: int = 16, **options: Any):
        block = grid(even(-3, 3, 3 * n), even(-3, 0, n))
        parts = Parts(block, disc(n, 1.0, (0.02, 1.0)), material=material, young=(1.0, 1e3))
        parts.hold(0, "y0")
        self._top = parts.hold(1, "y1")
        slave, master = parts.surface(0, "y1"), parts.surface(1, "y0", "x0", "x1")
        self.u = parts.u
        self.contact = cx.Contact(slave, master, method=method, friction=friction)
        self.problem = make_problem(parts.F, parts.u, [self.contact], parts.bcs, **options)

    def move(self, depth: float) -> None:
        """Set how deep the roller is, by its radius."""
        self._top.move((0.0, -depth))

    def press(self, depth: float = DEPTH) -> cx.Report:
        """Press it in."""
        self.move(depth)
        self.problem.solve()
        return self.problem.report
