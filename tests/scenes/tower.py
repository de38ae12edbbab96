# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two unit boxes on each other, tied or not, held at their far ends."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from contactx.obstacles import Obstacle
from dolfinx import fem, mesh

import meshes
from meshes import Tag
from scenes.blocks import dimension
from scenes.materials import neo_hookean
from scenes.problems import make_problem
from scenes.supports import DrivenFaces
from story import displacement, elasticity


class Tower:
    """An upper box on a lower one of the same width.

    Attributes:
        X: Reference positions of the nodes, shape (num_nodes, gdim).
        stress: What loads the side faces, if they are asked for.
    """

    def __init__(
        self,
        cell: mesh.CellType,
        n_upper: int,
        n_lower: int,
        *,
        master: Obstacle | None = None,
        nu: float = 0.0,
        gap: float = 0.0,
        shift: float = 0.0,
        neo: bool = False,
        free_top: bool = False,
        sides: bool = False,
        **options: Any,
    ):
        gdim = dimension(cell)
        data = meshes.blocks(
            cell, (n_upper,) * gdim, (n_lower,) * gdim, gap=gap, shift=(shift,) * (gdim - 1)
        )
        self.mesh, self.tags, self.gdim = data.mesh, data.facet_tags, gdim
        self.u = displacement(data.mesh)
        V = self.u.function_space
        self.X = V.tabulate_dof_coordinates()[:, :gdim]
        self.upper = np.unique(V.dofmap.list[data.cell_tags.find(Tag.UPPER)])
        self.top = DrivenFaces(self.u, self.tags, Tag.UPPER_TOP)
        self.bottom = DrivenFaces(self.u, self.tags, Tag.LOWER_BOTTOM)
        self.contact = cx.Contact(
            cx.Surface(self.tags, Tag.UPPER_CONTACT),
            master or cx.Surface(self.tags, Tag.LOWER_CONTACT),
            **options,
        )
        F = (neo_hookean if neo else elasticity)(self.u, 1.0, nu)
        self.stress = fem.Constant(data.mesh, np.zeros((gdim, gdim)))
        if sides:
            F -= self._side_forces()
        self.problem = make_problem(
            F,
            self.u,
            [self.contact],
            [end.bc for end in ([self.bottom] if free_top else [self.top, self.bottom])],
        )

    def _side_forces(self) -> ufl.Form:
        """Virtual work of the stress on all side faces."""
        sides = [t for t in Tag if t.name[-2:] in ("X0", "X1", "Y0", "Y1")]
        faces = tuple(int(t) for t in sides if t in self.tags.values)
        ds = ufl.Measure("ds", self.mesh, subdomain_data=self.tags)(faces)
        v = ufl.TestFunction(self.u.function_space)
        return ufl.inner(self.stress * ufl.FacetNormal(self.mesh), v) * ds

    def solve(self, *top: float) -> Tower:
        """Move the top by a vector."""
        self.top.move(top)
        self.problem.solve()
        return self

    def move(self, motion: Any) -> None:
        """Move both ends as a motion of points does, and solve."""
        for end in (self.top, self.bottom):
            end.move(motion(end.x) - end.x)
        self.problem.solve()

    @property
    def moved(self) -> np.ndarray:
        """Current positions of the nodes, shape (num_nodes, gdim)."""
        return self.X + self.u.x.array.reshape(-1, self.gdim)


def lift(gdim: int, height: float, aside: float = 0.0) -> np.ndarray:
    """A displacement up and along the first axis."""
    d = np.zeros(gdim)
    d[0], d[-1] = aside, height
    return d


def one_body(tower: Tower, top: np.ndarray, nu: float) -> np.ndarray:
    """Force on the top of the tower where the boxes have grown together, shape (gdim,).

    Nodes at one place become one node: the boxes must match.
    """
    old, gdim = tower.mesh, tower.gdim
    x = old.geometry.x[:, :gdim]
    _, first, node = np.unique(np.round(x, 9), axis=0, return_index=True, return_inverse=True)
    element = old.ufl_domain().ufl_coordinate_element()
    cells = node.ravel()[old.geometry.dofmaps[0]]
    domain = mesh.create_mesh(MPI.COMM_WORLD, cells, element, x[first])
    u = displacement(domain)
    V = u.function_space
    ends = []
    for height, value in ((1.0, top), (-1.0, np.zeros(gdim))):
        dofs = fem.locate_dofs_geometrical(V, lambda x, z=height: np.isclose(x[gdim - 1], z))
        ends.append(fem.dirichletbc(np.asarray(value, dtype=np.float64), dofs, V))
    F = elasticity(u, 1.0, nu)
    problem = fem.petsc.NonlinearProblem(
        F,
        u,
        bcs=ends,
        petsc_options_prefix="one_body_",
        petsc_options={"ksp_type": "preonly", "pc_type": "lu"},
    )
    problem.solve()
    reaction = fem.assemble_vector(fem.form(F)).array.reshape(-1, gdim)
    dofs = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[gdim - 1], 1.0))
    return reaction[dofs].sum(axis=0)
