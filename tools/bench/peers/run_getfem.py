# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem by GetFEM: each body is a mesh, supports are multipliers.

Time counts from the meshes in memory.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

import common
import getfem as gf
import numpy as np
from common import BLOCK, BOTTOM, MASTER, SLAVE, SPHERE, TOP, Answer, Floats, Mesh

NODAL = "nodal multipliers (node-to-surface)"
RAYTRACING = "large-sliding ray tracing"
# Largest residual at the end; the largest nodal force is about 1e-5
RESIDUAL = 1e-9
# How far ray tracing looks
RELEASE = 0.1


class Body:
    """One of the two bodies as GetFEM has it.

    Attributes:
        name: Name of its displacement.
        mesh: Its mesh; regions have the numbers of the tags.
        mf: Linear displacements.
        mim: Integration on it.
        fine: Integration of the contact.
        freedoms: Components of the nodes of its cells, shape (m, 4, 3).
        nodes: These nodes in the whole mesh, shape (m, 4).
    """

    def __init__(self, whole: Mesh, tag: int, sides: Sequence[int]) -> None:
        self.name = f"u{tag}"
        cells = np.flatnonzero(whole.bodies == tag)
        self.nodes = whole.cells[cells]
        self.mesh = gf.Mesh("empty", 3)
        points = np.asfortranarray(whole.x[self.nodes].transpose(2, 1, 0))
        numbers = self.mesh.add_convex(gf.GeoTrans("GT_PK(3,1)"), points)
        for side in sides:
            of_side, opposite = whole.sides(side).T
            places = numbers[np.searchsorted(cells, of_side)]
            self.mesh.set_region(side, np.array([places, opposite], dtype=np.int32))
        self.mf = gf.MeshFem(self.mesh, 3)
        self.mf.set_fem(gf.Fem("FEM_PK(3,1)"))
        self.mim = gf.MeshIm(self.mesh, gf.Integ("IM_TETRAHEDRON(3)"))
        self.fine = gf.MeshIm(self.mesh, gf.Integ("IM_TETRAHEDRON(5)"))
        freedoms, _ = self.mf.basic_dof_from_cvid(numbers)
        self.freedoms = freedoms.reshape(-1, 4, 3)


def solve(mesh: Mesh, setting: str, folder: Path) -> Answer:
    """Solve in this process.

    Args:
        mesh: Mesh of the problem.
        setting: ``NODAL`` or ``RAYTRACING``.
        folder: Not used.
    """
    gf.util("trace level", 0)
    sphere = Body(mesh, SPHERE, (SLAVE, TOP, 13, 14))
    block = Body(mesh, BLOCK, (MASTER, BOTTOM, 23, 24))
    meter = common.Meter()
    model = gf.Model("real")
    model.add_initialized_data("lambda", [common.LAMBDA])
    model.add_initialized_data("mu", [common.MU])
    for body, sides in ((sphere, (TOP, 13, 14)), (block, (BOTTOM, 23, 24))):
        model.add_fem_variable(body.name, body.mf)
        model.add_isotropic_linearized_elasticity_brick(body.mim, body.name, "lambda", "mu")
        support(model, body, sides)
    model.add_initialized_data("r", [common.YOUNG])
    {NODAL: add_nodal, RAYTRACING: add_raytracing}[setting](model, sphere, block)
    iterations, converged = model.solve("max_res", RESIDUAL, "max_iter", 50, "lsolver", "mumps")
    if not converged:
        raise RuntimeError(f"GetFEM did not converge in {iterations} iterations")
    measured = meter.read()
    u = np.zeros_like(mesh.x)
    for body in (sphere, block):
        u[body.nodes] = model.variable(body.name)[body.freedoms]
    counts = {"dofs": model.nbdof(), "iterations": iterations, **measured, "version": version()}
    return Answer(u, pressures(mesh, model, sphere, setting), counts)


def support(model: gf.Model, body: Body, sides: Sequence[int]) -> None:
    """Planes of symmetry, the top that moves and the bottom that is fixed."""
    for side in sides:
        given = [body.mim, body.name, 1, side]
        if side == BOTTOM:
            model.add_Dirichlet_condition_with_multipliers(*given)
        elif side == TOP:
            model.add_initialized_data("top", [-common.DOWN])
            model.add_normal_Dirichlet_condition_with_multipliers(*given, "top")
        elif side not in (SLAVE, MASTER):
            model.add_normal_Dirichlet_condition_with_multipliers(*given)


def add_nodal(model: gf.Model, sphere: Body, block: Body) -> None:
    """Forces of the sphere's nodes as multipliers."""
    model.add_nodal_contact_between_nonmatching_meshes_brick(
        sphere.mim, block.mim, sphere.name, block.name, "forces", "r", SLAVE, MASTER
    )


def add_raytracing(model: gf.Model, sphere: Body, block: Body) -> None:
    """Linear tractions of the sphere's surface as multipliers."""
    model.add_filtered_fem_variable("tractions", sphere.mf, SLAVE)
    brick = model.add_integral_large_sliding_contact_brick_raytracing("r", RELEASE)
    model.add_slave_contact_boundary_to_large_sliding_contact_brick(
        brick, sphere.fine, SLAVE, sphere.name, "tractions"
    )
    model.add_master_contact_boundary_to_large_sliding_contact_brick(
        brick, block.fine, MASTER, block.name
    )


def pressures(mesh: Mesh, model: gf.Model, sphere: Body, setting: str) -> Floats:
    """Pressures of the slave nodes: forces over areas, or the normal parts of the tractions."""
    freedoms = np.unique(sphere.mf.basic_dof_on_region(SLAVE))
    # The node of each vertical component
    node_of = np.zeros(sphere.mf.nbdof(), dtype=np.int64)
    node_of[sphere.freedoms[:, :, 2]] = sphere.nodes
    nodes = node_of[freedoms[2::3]]
    found = np.zeros(len(mesh.x))
    if setting == NODAL:
        found[nodes] = -model.variable("forces")
        return found[mesh.nodes(SLAVE)] / mesh.areas()
    found[nodes] = np.linalg.norm(model.variable("tractions").reshape(-1, 3), axis=1)
    return found[mesh.nodes(SLAVE)]


def version() -> str:
    """Version of GetFEM, which its module does not tell."""
    command = ["dpkg-query", "-W", "-f", "${Version}", "python3-getfem"]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return text.split("+")[0]


if __name__ == "__main__":
    common.main(solve)
