# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A disc that nothing but its weight and an obstacle without friction holds."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl

from meshes.build import build_mesh
from scenes.materials import neo_hookean
from scenes.problems import make_problem
from story import displacement, elasticity

WEIGHT = 0.005
FINE, COARSE = 0.01, 0.15


class FreeDisc:
    """A disc of radius 1 over the lowest point of a plane or a cup, finest below.

    Args:
        cup: Radius of the cup; None for a plane.
        gap: How far it falls.
        linear: Whether strains are linear, else the disc is neo-Hookean.
    """

    def __init__(self, cup: float | None, gap: float = 0.0, *, linear: bool = False):
        def recipe(gmsh: ModuleType) -> None:
            occ, model = gmsh.model.occ, gmsh.model
            disc = occ.addDisk(0, 1 + gap, 0, 1, 1)
            occ.synchronize()
            model.addPhysicalGroup(2, [disc], 1)
            skin = model.getBoundary([(2, disc)], oriented=False)
            model.addPhysicalGroup(1, [line for _, line in skin], 1)
            field = model.mesh.field.add("MathEval")
            growth = f"{COARSE - FINE} * Sqrt(x * x + (y - {gap}) * (y - {gap}))"
            model.mesh.field.setString(field, "F", f"{FINE} + {growth}")
            model.mesh.field.setAsBackgroundMesh(field)
            model.mesh.generate(2)

        options = {"Mesh.MeshSizeExtendFromBoundary": 0}
        data = build_mesh("disc", 2, recipe, MPI.COMM_WORLD, options)
        assert data.facet_tags is not None
        self.u = displacement(data.mesh)
        v = ufl.TestFunction(self.u.function_space)
        F = (elasticity if linear else neo_hookean)(self.u, 1.0, 0.3)
        F += WEIGHT / np.pi * v[1] * ufl.dx
        ground = cx.Plane((0, 0), (0, 1)) if cup is None else cx.Sphere((0, cup), cup, hollow=True)
        self.contact = cx.Contact(cx.Surface(data.facet_tags, 1), ground)
        self.problem = make_problem(F, self.u, [self.contact])

    @property
    def moved(self) -> tuple[float, float]:
        """How far it has turned, in radians, and moved aside, both of the mean motion."""
        x = self.u.function_space.tabulate_dof_coordinates()[:, :2]
        at = x - x.mean(0)
        now = x + self.u.x.array.reshape(-1, 2)
        aside = float(now.mean(0)[0] - x.mean(0)[0])
        now -= now.mean(0)
        sine = (at[:, 0] * now[:, 1] - at[:, 1] * now[:, 0]).sum()
        return float(np.arctan2(sine, (at * now).sum())), aside
