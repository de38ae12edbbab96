# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks in line between two walls, hot above and cold below, that press as they expand.

All moves and flows in one direction, so that the answer follows from one equation of one unknown.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.blocks import dimension
from scenes.coupled import EXPANSION, LAMBDA, MU, fix, strain
from scenes.problems import make_problem, pair_of

Array = npt.NDArray[np.float64]
CONDUCTIVITY, HOT = 2.0, 100.0


def coefficient(p: Array, gap: Array) -> Array:
    """Conductance of touching asperities, and of a gas in the gap."""
    return 50 * p + 0.5 / (1 + gap / 0.02)


class HeatedBlocks:
    """The blocks, each of height 1."""

    def __init__(
        self,
        cell: CellType = CellType.quadrilateral,
        *,
        degree: int = 1,
        gap: float = 0.0,
        h: Callable[[Array, Array], Array] = coefficient,
        **options: Any,
    ):
        self.dim = dim = dimension(cell)
        n = ((4, 3), (5, 3)) if dim == 2 else ((3, 3, 2), (4, 4, 2))
        data = meshes.blocks(cell, *n)
        self.tags, domain = data.facet_tags, data.mesh
        V = fem.functionspace(domain, ("Lagrange", degree, (dim,)))
        Q = fem.functionspace(domain, ("Lagrange", degree))
        self.u, self.T, self.gap = fem.Function(V), fem.Function(Q, name="temperature"), gap
        v, q = ufl.TestFunction(V), ufl.TestFunction(Q)
        e = strain(self.u) - EXPANSION * self.T * ufl.Identity(dim)
        stress = 2 * MU * e + LAMBDA * ufl.tr(e) * ufl.Identity(dim)
        self.F = [
            ufl.inner(stress, strain(v)) * ufl.dx,
            CONDUCTIVITY * ufl.inner(ufl.grad(self.T), ufl.grad(q)) * ufl.dx,
        ]
        ends = Tag.LOWER_BOTTOM, Tag.UPPER_TOP
        self.heat = [fix(Q, self.tags, HOT, ends[1]), fix(Q, self.tags, 0.0, ends[0])]
        self.hold = [fix(V.sub(dim - 1), self.tags, 0.0, *ends)]
        for i in range(dim - 1):
            sides = [
                Tag[f"{body}_{'XY'[i]}{side}"] for body in ("UPPER", "LOWER") for side in (0, 1)
            ]
            self.hold.append(fix(V.sub(i), self.tags, 0.0, *ends, *sides))
        self.contact = pair_of(self.tags, offset=-gap, **options)
        self.conductance = cx.Conductance(self.contact, self.T, h)
        self.h = h

    def problem(self) -> cx.ContactProblem:
        """Both fields as one problem."""
        return make_problem(
            self.F,
            [self.u, self.T],
            [self.contact],
            self.heat + self.hold,
            displacement=0,
            conductances=[self.conductance],
        )

    def exact(self) -> tuple[float, float, float]:
        """Pressure, gap and flow per area."""
        modulus = LAMBDA + 2 * MU
        swelling = (2 * MU + LAMBDA * self.dim) / modulus * EXPANSION

        def flow(p: float, gap: float) -> float:
            h = float(np.asarray(self.h(np.array([p]), np.array([gap])))[0])
            return HOT * h / (2 * h / CONDUCTIVITY + 1)

        def excess(x: float) -> float:
            """Length that is too much, for the pressure x, or the gap -x."""
            p, gap = max(x, 0.0), max(-x, 0.0)
            q = flow(p, gap)
            upper, lower = HOT - q / (2 * CONDUCTIVITY), q / (2 * CONDUCTIVITY)
            return swelling * (upper + lower) - 2 * p / modulus - self.gap + gap

        low, high = -1.0, 1.0
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if excess(middle) * excess(low) > 0 else (low, middle)
        p, gap = max(low, 0.0), max(-low, 0.0)
        return p, gap, flow(p, gap)
