# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Loose balls of rubber, or discs in 2D, in a rigid box under a lid, in mm and N."""

from __future__ import annotations

from itertools import product
from typing import Any

from mpi4py import MPI

import gmsh
import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io import gmsh as gmshio

from scenes.problems import make_problem

RADIUS, PITCH = 5.0, 10.4
# Of one layer over the other, so that balls of both are about 1 apart
RISE = {2: 9.7, 3: 8.2}
YOUNG, POISSON = 10.0, 0.3


def stack(gdim: int, layers: int, width: int) -> np.ndarray:
    """Centres of layers of balls, every other one with one ball less, a little off their places."""
    centres = [
        [PITCH * (i + (k % 2) / 2) + PITCH / 2 for i in at] + [RISE[gdim] * k + RADIUS + 0.05]
        for k in range(layers)
        for at in product(range(width - k % 2), repeat=gdim - 1)
    ]
    random = np.random.default_rng(3)
    return np.array(centres) + 0.08 * random.uniform(-1, 1, (len(centres), gdim))


class LooseBalls:
    """Nothing but contact holds the balls; there is no weight.

    Attributes:
        contacts: Of all balls with each other, with the floor, the lid and the walls.
    """

    def __init__(
        self, gdim: int = 2, *, layers: int = 2, width: int = 3, size: float = 1.5, **options: Any
    ):
        self.centres = stack(gdim, layers, width)
        data = self._mesh(size)
        assert data.cell_tags is not None and data.facet_tags is not None
        self._cells = data.cell_tags
        V = fem.functionspace(data.mesh, ("Lagrange", 1, (gdim,)))
        self.u = fem.Function(V, name="displacement")
        mu, lame = (
            YOUNG / (2 * (1 + POISSON)),
            YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)),
        )
        grad = ufl.Identity(gdim) + ufl.grad(self.u)
        log = ufl.ln(ufl.det(grad))
        energy = mu / 2 * (ufl.tr(grad.T * grad) - gdim - 2 * log) + lame / 2 * log**2
        F = ufl.derivative(energy * ufl.dx, self.u)
        self._top = self.centres[:, -1].max() + RADIUS + 0.02
        self._lid = fem.Constant(data.mesh, (*[0.0] * (gdim - 1), self._top))
        axes, box = np.eye(gdim), PITCH * width
        walls = [(0 * axes[0], axes[-1]), (self._lid, -axes[-1])]
        for axis in axes[:-1]:
            walls += [(0 * axis, axis), (box * axis, -axis)]
        skin = cx.Surface(data.facet_tags, *range(1, len(self.centres) + 1))
        self.contacts = [cx.Contact.all(data.facet_tags, **options)]
        self.contacts += [cx.Contact(skin, cx.Plane(*wall), **options) for wall in walls]
        self.problem = make_problem(F, self.u, self.contacts)

    def _mesh(self, size: float) -> Any:
        gdim = self.centres.shape[1]
        gmsh.initialize()
        try:
            gmsh.option.setNumber("General.Verbosity", 1)
            gmsh.option.setNumber("Mesh.MeshSizeMax", size)
            occ = gmsh.model.occ
            if gdim == 2:
                bodies = [occ.addDisk(*c, 0, RADIUS, RADIUS) for c in self.centres]
            else:
                bodies = [occ.addSphere(*c, RADIUS) for c in self.centres]
            occ.synchronize()
            for tag, body in enumerate(bodies, start=1):
                skin = gmsh.model.getBoundary([(gdim, body)], oriented=False)
                gmsh.model.addPhysicalGroup(gdim, [body], tag)
                gmsh.model.addPhysicalGroup(gdim - 1, [facet for _, facet in skin], tag)
            gmsh.model.mesh.generate(gdim)
            return gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=gdim)
        finally:
            gmsh.finalize()

    def push(self, depth: float) -> None:
        """Set how far the lid is down."""
        self._lid.value[-1] = self._top - depth

    def largest_strain(self) -> float:
        """Largest component of Green's strain in any cell: rigid bodies have none."""
        u, comm = self.u, self.u.function_space.mesh.comm
        strain = (ufl.grad(u) + ufl.grad(u).T + ufl.grad(u).T * ufl.grad(u)) / 2
        space = fem.functionspace(u.function_space.mesh, ("DG", 0, strain.ufl_shape))
        values = fem.Function(space)
        values.interpolate(fem.Expression(strain, space.element.interpolation_points))
        largest = float(np.abs(values.x.array).max(initial=0))
        return float(comm.allreduce(largest, op=MPI.MAX))

    def nearest(self) -> float:
        """Least distance of the middles of two balls, in diameters; on one rank."""
        V, gdim = self.u.function_space, self.centres.shape[1]
        x = V.tabulate_dof_coordinates()[:, :gdim] + self.u.x.array.reshape(-1, gdim)
        nodes = (
            np.unique(V.dofmap.list[self._cells.find(tag + 1)]) for tag in range(len(self.centres))
        )
        middles = np.array([x[some].mean(axis=0) for some in nodes])
        apart = np.linalg.norm(middles[:, None] - middles[None], axis=2)
        return float(apart[~np.eye(len(middles), dtype=bool)].min() / (2 * RADIUS))
