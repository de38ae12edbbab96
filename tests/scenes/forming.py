# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A strip that yields while a punch bends it over a round support."""

from __future__ import annotations

import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem

from scenes.grids import chosen, create, grid, middles, outside
from scenes.problems import make_problem
from story import displacement, fix

# N and mm: steel, half of the strip from the punch on, and round tools of a radius
YOUNG, NU, YIELD, HARDENING = 210e3, 0.3, 300.0, 500.0
LENGTH, HEIGHT, RADIUS, SUPPORT = 60.0, 6.0, 8.0, 45.0
DEGREE = 4


class BentStrip:
    """Half of a strip in three-point bending, plane strain, the punch moved down.

    Von Mises plasticity of Green's strain and the second Piola-Kirchhoff stress, which add up
    (Green and Naghdi 1965), with linear hardening.

    Attributes:
        history: Plastic strain, and the equivalent one.
    """

    def __init__(self, cells: tuple[int, int] = (60, 4), friction: float = 0.1):
        domain = create(grid([0, 0], [LENGTH, HEIGHT], cells))
        u = displacement(domain, 2)
        facets = outside(domain)
        at, _ = middles(domain, facets)
        faces = [at[:, 1] < 1e-9, at[:, 1] > HEIGHT - 1e-9, at[:, 0] < 1e-9]
        tags = chosen(domain, facets, np.select(faces, [1, 2, 3]))
        element = basix.ufl.quadrature_element(
            domain.basix_cell(), value_shape=(3, 3), degree=DEGREE
        )
        scalar = basix.ufl.quadrature_element(domain.basix_cell(), degree=DEGREE)
        self._plastic, self._equivalent = self.history = [
            fem.Function(fem.functionspace(domain, e)) for e in (element, scalar)
        ]
        self._set_material(u)
        self._top = fem.Constant(domain, np.array([0.0, HEIGHT + RADIUS]))
        self.punch, self.support = (
            cx.Contact(cx.Surface(tags, tag), cx.Sphere(centre, RADIUS), friction=friction)
            for tag, centre in ((2, self._top), (1, (SUPPORT, -RADIUS)))
        )
        self.problem = make_problem(
            self._F, u, [self.punch, self.support], [fix(u, tags, 0, 0.0, 3)]
        )

    def _set_material(self, u: fem.Function) -> None:
        mu, lmbda = YOUNG / (2 * (1 + NU)), YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
        g, v = ufl.grad(u), ufl.grad(ufl.TestFunction(u.function_space))
        grad = ufl.as_tensor([[g[0, 0], g[0, 1], 0], [g[1, 0], g[1, 1], 0], [0, 0, 0]])
        virtual = ufl.as_tensor([[v[0, 0], v[0, 1], 0], [v[1, 0], v[1, 1], 0], [0, 0, 0]])
        F = ufl.Identity(3) + grad
        strain = (F.T * F - ufl.Identity(3)) / 2 - self._plastic
        trial = 2 * mu * strain + lmbda * ufl.tr(strain) * ufl.Identity(3)
        s = ufl.dev(trial)
        mises = ufl.sqrt(1.5 * ufl.inner(s, s) + 1e-12)
        excess = mises - YIELD - HARDENING * self._equivalent
        rate = ufl.max_value(excess, 0) / (3 * mu + HARDENING)
        flow = 1.5 * rate * s / mises
        measure = ufl.dx(metadata={"quadrature_degree": DEGREE, "quadrature_scheme": "default"})
        self._F = ufl.inner(F * (trial - 2 * mu * flow), virtual) * measure
        points = self._plastic.function_space.element.interpolation_points
        self._new = [
            fem.Expression(new, points) for new in (self._plastic + flow, self._equivalent + rate)
        ]

    def commit(self) -> None:
        """Take over the history of an accepted step."""
        values = [fem.Function(f.function_space) for f in self.history]
        for value, new in zip(values, self._new, strict=True):
            value.interpolate(new)
        for f, value in zip(self.history, values, strict=True):
            f.x.array[:] = value.x.array

    def bend(self, way: float, steps: int) -> tuple[int, int]:
        """Move the punch down; solves of accepted steps, and of attempts that failed."""

        def update(t: float) -> None:
            self._top.value[1] = HEIGHT + RADIUS - way * t

        solves = failed = 0
        for step in cx.LoadSteps(self.problem, steps, update, history=self.history, progress=False):
            self.commit()
            solves += step.iterations
            failed += step.report.discarded
        return solves, failed
