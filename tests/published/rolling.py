# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A steel roller on rubber: rolling with friction, of which a part of the contact sticks.

The rubber is a half-plane that keeps its volume, the roller is rigid and has spun a little farther
than it has gone. Lengths are in half-widths of the contact, stresses in Young's moduli.
"""

from __future__ import annotations

import math

from mpi4py import MPI

import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem, mesh

from meshes.grids import graded
from published.drawing import curve
from published.record import Answer, Case, steps
from scenes.grids import faces
from scenes.problems import make_problem

E, NU, FRICTION = 1.0, 0.5, 0.5
MODULUS = E / (1 - NU**2)
# Radius of the roller, how deep it goes, size of the half-plane
RADIUS, DEPTH, FAR = 50.0, 0.0345, 40.0
# Way of the roller; its creepage, as a part of mu/R, at which a contact of half-width 1 slips
# everywhere; and how far its rim has spun before it rolls, for about the force that rolling needs
WAY, CREEP, AHEAD = 3.0, 0.5, 0.0165
# Steps
PRESS, SPIN = 2, 2


def _grid(h: float) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the cells along the surface and downward."""
    near = np.linspace(-1.5, 1.5 + WAY, round((3 + WAY) / h) + 1)
    away = graded(FAR, h, 1.2, FAR / 6)[1:]
    x = np.concatenate([-1.5 - away[::-1], near, 1.5 + WAY + away])
    return x, graded(FAR, h, 1.2, FAR / 6)


def carter(h: float = 0.125) -> Answer:
    """Tangential force of the roller by its vertical force and its creepage."""
    grid = _grid(h)
    n = [len(axis) - 1 for axis in grid]
    ends = [[0.0, 0.0], [float(count) for count in n]]
    domain = mesh.create_rectangle(MPI.COMM_WORLD, ends, n, mesh.CellType.quadrilateral)
    X = domain.geometry.x
    X[:, 0] = np.interp(X[:, 0], np.arange(n[0] + 1), grid[0])
    X[:, 1] = np.interp(X[:, 1], np.arange(n[1] + 1), -grid[1][::-1])
    tags = faces(domain, [(1, 0.0), (1, -FAR), (0, grid[0][0]), (0, grid[0][-1])])
    cell = domain.basix_cell()
    element = basix.ufl.mixed_element(
        [
            basix.ufl.element("Lagrange", cell, 2, shape=(2,)),
            basix.ufl.element("Lagrange", cell, 1),
        ]
    )
    W = fem.functionspace(domain, element)
    w = fem.Function(W)
    (u, p), (v, q) = ufl.split(w), ufl.TestFunctions(W)
    shear = E / (2 * (1 + NU))
    F = 2 * shear * ufl.inner(ufl.sym(ufl.grad(u)), ufl.grad(v)) * ufl.dx
    F -= (p * ufl.div(v) + q * ufl.div(u)) * ufl.dx
    held = np.concatenate([tags.find(tag) for tag in (2, 3, 4)])
    V = W.sub(0)
    bcs = [
        fem.dirichletbc(0.0, fem.locate_dofs_topological(V.sub(i), 1, held), V.sub(i))
        for i in range(2)
    ]
    centre = fem.Constant(domain, (0.0, RADIUS))
    spun = fem.Constant(domain, 0.0)
    roller = cx.Sphere(centre, RADIUS, angle=spun)
    contact = cx.Contact(cx.Surface(tags, 1), roller, friction=FRICTION)
    problem = make_problem(F, w, [contact], bcs, displacement=0)
    creepage = CREEP * FRICTION / RADIUS
    rolls = round(WAY / h)

    def update(t: float) -> None:
        step = t * (PRESS + SPIN + rolls)
        centre.value[1] = RADIUS - DEPTH * min(1.0, step / PRESS)
        step -= PRESS
        ahead = AHEAD * min(max(step / SPIN, 0.0), 1.0)
        centre.value[0] = way = WAY * max(0.0, step - SPIN) / rolls
        spun.value = -(ahead + way * (1 + creepage)) / RADIUS

    iterations = list(steps(problem, PRESS + SPIN + rolls, update))
    along, down = np.abs(contact.force)
    a = math.sqrt(4 * down * RADIUS / (math.pi * MODULUS))
    part = creepage * RADIUS / (FRICTION * a)
    expected = FRICTION * down * (1 - (1 - part) ** 2)
    displacement = problem.displacement.function_space
    x = displacement.tabulate_dof_coordinates()[contact.slave_nodes, 0] - WAY
    shear = np.abs(contact.traction.x.array.reshape(-1, 2)[contact.slave_nodes, 0])

    def exact(x: np.ndarray) -> np.ndarray:
        """The trailing part slips, the leading one, shorter by what the creepage is, sticks."""
        peak = 2 * FRICTION * down / (math.pi * a)
        d = a * part
        inner = np.maximum((a - d) ** 2 - (x - d) ** 2, 0)
        return peak / a * (np.sqrt(np.maximum(a**2 - x**2, 0)) - np.sqrt(inner))

    near = np.abs(x) < 1.4 * a
    drawn = curve(x[near], shear[near], ("x / a", "shear / E"), exact)
    return Answer(float(along), iterations, drawn, expected)


CASES = [
    Case(
        "carter",
        "Steel roller that drives on rubber, friction 0.5",
        "F. W. Carter, Proc. R. Soc. A 112, 1926, 151-157; K. L. Johnson, Contact Mechanics, "
        "Cambridge University Press, 1985, section 8.3",
        "tangential force by creepage",
        carter,
        note="It stands for NAFEMS R0094 problem 5, of which no number is public: its rubber, "
        "incompressible, is a half-plane here, and its roller rigid. It rolls 3 half-widths of the "
        "contact in steps as long as the cells, of which there are 16 in it. With 8 of them the "
        "force is 3.1 % too small.",
        slow=True,
    ),
]
