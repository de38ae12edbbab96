# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Leaf springs: leaves that are clamped at one end and lie on each other; mm, MPa, per mm of width.

Deflections are small, as beams and linear elasticity want them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

import story
from plot.style import INK
from published.drawing import deformed
from published.record import Answer, Case, solve, steps
from scenes.grids import chosen, create, grid, middles, outside
from scenes.problems import make_problem

E = 210e3
# Tags of the clamp, and of the tops, bottoms and tips of the leaves from these numbers on
_CLAMP, _TOP, _BOTTOM, _TIP = 1, 10, 20, 30


class Leaves:
    """Leaves below y = 0, each of its own length, the first one at the top.

    Attributes:
        F: Residual of the leaves alone, in plane stress without a Poisson's ratio.
        contacts: Contact of each leaf with the one above it.
    """

    def __init__(self, lengths: Sequence[float], thick: float, h: float, friction: float):
        """Create them, without a load.

        Args:
            h: Length of the cells, of which there are two over the thickness.
        """
        parts = [
            grid((0, -(k + 1) * thick), (length, -k * thick), (round(length / h), 2))
            for k, length in enumerate(lengths)
        ]
        domain = create(*parts)
        facets = outside(domain)
        (x, y), (_, inside) = (points.T for points in middles(domain, facets))
        leaf = np.floor(-inside / thick).astype(int)
        sides = [np.isclose(x, 0), np.isclose(x, np.asarray(lengths)[leaf])]
        sides.append(np.isclose(y, -leaf * thick))
        tags = np.select(sides, [_CLAMP, _TIP + leaf, _TOP + leaf], _BOTTOM + leaf)
        self.tags = chosen(domain, facets, tags)
        self.u = story.displacement(domain, 2)
        self.F = story.elasticity(self.u, E, 0.0)
        self.ds = ufl.Measure("ds", domain=domain, subdomain_data=self.tags)
        self.bcs = [story.fix(self.u, self.tags, i, 0.0, _CLAMP) for i in range(2)]
        self.contacts = [
            cx.Contact(
                cx.Surface(self.tags, _TOP + k),
                cx.Surface(self.tags, _BOTTOM + k - 1),
                friction=friction,
            )
            for k in range(1, len(lengths))
        ]

    def deflection(self, x: float) -> float:
        """How far the leaf at the top has come down at a place."""
        there = self.u.function_space.tabulate_dof_coordinates()
        node = np.argmin(np.hypot(there[:, 0] - x, there[:, 1]))
        return -float(self.u.x.array[2 * node + 1])


def graduated() -> Answer:
    """Four leaves of 200, 150, 100 and 50 mm, a force at the tip of the longest.

    Beams press on each other at the ends of the shorter ones alone, with forces that are found from
    equal deflections there.
    """
    lengths, thick, force = np.array([200.0, 150.0, 100.0, 50.0]), 4.0, 1.0
    leaves = Leaves(lengths, thick, 2.5, 0.0)
    leaves.F += force / thick * ufl.TestFunction(leaves.u.function_space)[1] * leaves.ds(_TIP)
    problem = make_problem(leaves.F, leaves.u, leaves.contacts, leaves.bcs)
    iterations = solve(problem)

    def give(at: float, x: float) -> float:
        """Deflection at x by a unit force."""
        near, far = min(at, x), max(at, x)
        return near**2 * (3 * far - near) / (6 * E * thick**3 / 12)

    # Row k: where leaf k + 1 ends, it and the one above have one deflection
    n = len(lengths) - 1
    pressed = np.zeros((n, n + 2))
    for k, end in enumerate(lengths[1:]):
        pressed[k, k] = -give(lengths[k], end)
        pressed[k, k + 1] = 2 * give(end, end)
        if k + 1 < n:
            pressed[k, k + 2] = -give(lengths[k + 2], end)
    forces = np.linalg.solve(pressed[:, 1:-1], -force * pressed[:, 0])
    exact = force * give(200.0, 200.0) - forces[0] * give(lengths[1], 200.0)
    return Answer(leaves.deflection(200.0), iterations, deformed(leaves.u, scale=40), exact)


def damped() -> Answer:
    """Two leaves that are pressed together, bent to and fro: work lost in a cycle.

    They stick up to the force F0 = 4 mu p h/3, then they slip all along their length at once. A
    cycle between the forces -F and F takes 6 F0 (F - F0) L^3/(E h^3).
    """
    length, thick, friction, pressure = 100.0, 5.0, 0.3, 0.1
    leaves = Leaves([length, length], thick, 2.5, friction)
    v = ufl.TestFunction(leaves.u.function_space)[1]
    tip = fem.Constant(leaves.u.function_space.mesh, 0.0)
    leaves.F += pressure * v * leaves.ds(_TOP) - pressure * v * leaves.ds(_BOTTOM + 1)
    leaves.F += tip / (2 * thick) * v * leaves.ds((_TIP, _TIP + 1))
    problem = make_problem(leaves.F, leaves.u, leaves.contacts, leaves.bcs)
    stuck = 4 * friction * pressure * thick / 3
    most = 2 * stuck
    path, iterations, lost = [], [], 0.0

    def between(start: float, end: float, number: int) -> None:
        def update(t: float) -> None:
            tip.value = start + t * (end - start)

        for solves in steps(problem, number, update):
            iterations.append(solves)
            path.append((leaves.deflection(length), float(tip.value)))

    between(0.0, most, 4)
    lost -= problem.report.dissipation
    between(most, -most, 8)
    between(-most, most, 8)
    lost += problem.report.dissipation
    exact = 6 * stuck * (most - stuck) * length**3 / (E * thick**3)
    deflections, forces = np.array(path).T

    def draw(axes: Any) -> None:
        axes.plot(deflections, forces, "o-", color=INK, markersize=2)
        axes.set_xlabel("deflection")
        axes.set_ylabel("force")

    return Answer(lost, iterations, draw, exact)


CASES = [
    Case(
        "leaf_spring",
        "Leaf spring of four leaves, without friction",
        "Beams that press on each other at their ends (S. Timoshenko, Strength of Materials); "
        "asked for in CalculiX's forum, calculix.discourse.group/t/no-separation-contact/916",
        "deflection of the tip, mm",
        graduated,
    ),
    Case(
        "slip_damping",
        "Two leaves pressed together and bent to and fro, friction 0.3",
        "L. E. Goodman and J. H. Klumpp, J. Appl. Mech. 23, 1956, 421-429",
        "work lost in a cycle, 6 F0 (F - F0) L^3/(E h^3), mJ/mm",
        damped,
    ),
]
