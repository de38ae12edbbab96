# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A ball that is pushed on the edge of a plate, its middle beside the plate."""

from __future__ import annotations

from types import ModuleType
from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from scenes.problems import make_problem
from story import displacement, elasticity, fix

# Middle of the ball, of radius 1; the plate's edge is at x = SIDE, its top at z = 0
MIDDLE = (2.3, 0.1, 1.0001)
SIDE = 2.0
DOWN, STEPS = 0.12, 4
BALL, PLATE = 1, 2
ROUND, FACES, BOTTOM = 10, 21, 22
# Force across over force down: along the ball's normal, from the edge to its middle
RIGHT = (MIDDLE[0] - SIDE) / (MIDDLE[2] - DOWN)


def mesh(h: float) -> MeshData:
    """Mesh the ball and the plate, of which the whole boundaries are tagged."""

    def recipe(gmsh: ModuleType) -> None:
        occ, model = gmsh.model.occ, gmsh.model
        ball = occ.addSphere(*MIDDLE, 1.0)
        plate = occ.addBox(-SIDE, -SIDE, -1, 2 * SIDE, 2 * SIDE, 1)
        occ.synchronize()
        groups: dict[int, list[int]] = {}
        for body, number in ((ball, BALL), (plate, PLATE)):
            model.addPhysicalGroup(3, [body], number)
            for _, face in model.getBoundary([(3, body)], oriented=False):
                is_low = model.occ.getCenterOfMass(2, face)[2] < -1 + 1e-6
                tag = ROUND if number == BALL else (BOTTOM if is_low else FACES)
                groups.setdefault(tag, []).append(face)
        for tag, faces in groups.items():
            model.addPhysicalGroup(2, faces, tag)
        model.mesh.generate(3)

    return build_mesh("ball_at_edge", 3, recipe, MPI.COMM_WORLD, {"Mesh.MeshSizeMax": h})


class BallAtEdge:
    """The plate lies on its bottom, the ball's upper part is moved down; frictionless."""

    def __init__(self, h: float, *, swapped: bool = False, **options: Any):
        data = mesh(h)
        tags, u = data.facet_tags, displacement(data.mesh)
        V = u.function_space
        self._way = fem.Constant(data.mesh, np.zeros(3))
        head = fem.locate_dofs_geometrical(V, lambda x: x[2] > MIDDLE[2] + 0.5)
        bcs = [fem.dirichletbc(self._way, head, V)]
        bcs += [fix(u, tags, axis, 0.0, BOTTOM) for axis in range(3)]
        ball, plate = cx.Surface(tags, ROUND), cx.Surface(tags, FACES, BOTTOM)
        slave, master = (plate, ball) if swapped else (ball, plate)
        self._sign = 1 if swapped else -1
        self.contact = cx.Contact(slave, master, **options)
        self.problem = make_problem(elasticity(u, 1.0, 0.3), u, [self.contact], bcs)

    def push(self) -> int:
        """Push the ball down; number of iterations."""

        def update(t: float) -> None:
            self._way.value[2] = -DOWN * t

        steps = cx.LoadSteps(self.problem, STEPS, update=update, progress=False)
        return sum(step.iterations for step in steps)

    @property
    def force(self) -> np.ndarray:
        """What the ball exerts on the plate, shape (3,)."""
        return self._sign * self.contact.force
