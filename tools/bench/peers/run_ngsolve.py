# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem by NGSolve, by energies of its contact boundary.

Time counts from NGSolve's mesh in memory. Pressures are the contact forces of the slave nodes over
their areas, from the residual of the bodies.
"""

from __future__ import annotations

from importlib import metadata
from pathlib import Path

import common
import netgen.meshing as netgen
import ngsolve as ng
import numpy as np
from common import BLOCK, MASTER, SLAVE, SPHERE, TOP, Answer, Mesh

# Stiffness over E / h, and the solver of the linear systems
SETTINGS = {
    "penalty gamma 10, Cholesky": (10.0, "sparsecholesky"),
    "penalty gamma 3, CG": (3.0, "CG"),
}
# Largest residual at the end; the largest nodal force is about 1e-5
RESIDUAL = 1e-10
MAXIMUM = 50
# Order of integration, and how far partners are looked for
ORDER, DISTANCE = 4, 0.1


def solve(mesh: Mesh, setting: str, folder: Path) -> Answer:
    """Solve in this process.

    Args:
        mesh: Mesh of the problem.
        setting: One of ``SETTINGS``.
        folder: Not used.
    """
    gamma, solver = SETTINGS[setting]
    domain = read(mesh)
    meter = common.Meter()
    supports = {
        f"dirichlet{'xyz'[k]}": "|".join(f"f{tag}" for tag in tags + (TOP,) * (k == 2))
        for k, tags in common.FIXED.items()
    }
    space = ng.VectorH1(domain, order=1, **supports)
    u = space.TrialFunction()
    strain = ng.Sym(ng.Grad(u))
    energy = common.MU * ng.InnerProduct(strain, strain) + common.LAMBDA / 2 * ng.Trace(strain) ** 2
    bodies, form = (ng.BilinearForm(space, symmetric=True) for _ in range(2))
    bodies += ng.Variation(energy * ng.dx)
    form += ng.Variation(energy * ng.dx)
    contact = ng.ContactBoundary(domain.Boundaries(f"f{SLAVE}"), domain.Boundaries(f"f{MASTER}"))
    place = ng.CF((ng.x, ng.y, ng.z))
    depth = (place - place.Other() + u - u.Other()) * contact.normal
    stiffness = gamma * common.YOUNG / float(mesh.h)
    contact.AddEnergy(ng.IfPos(depth, stiffness / 2 * depth**2, 0))

    found = ng.GridFunction(space)
    found.components[2].Set(-common.DOWN, definedon=domain.Boundaries(f"f{TOP}"))
    residual, step = found.vec.CreateVector(), found.vec.CreateVector()
    free = ng.Projector(space.FreeDofs(), True)
    preconditioner = ng.Preconditioner(form, "local") if solver == "CG" else None
    for iteration in range(1, MAXIMUM + 1):
        contact.Update(found, form, intorder=ORDER, maxdist=DISTANCE)
        form.Apply(found.vec, residual)
        residual.data = free * residual
        size = residual.Norm()
        if size < RESIDUAL:
            break
        form.AssembleLinearization(found.vec)
        if preconditioner is None:
            step.data = form.mat.Inverse(space.FreeDofs(), inverse=solver) * residual
        else:
            inverse = ng.CGSolver(form.mat, preconditioner.mat, tol=1e-8, maxiter=5000)
            step.data = inverse * residual
        found.vec.data -= step
    else:
        raise RuntimeError(f"NGSolve did not converge in {MAXIMUM} iterations")
    measured = meter.read()
    counts = {
        "dofs": space.ndof,
        "iterations": iteration - 1,
        **measured,
        "version": metadata.version("ngsolve"),
    }
    bodies.Apply(found.vec, residual)
    displacement, forces = (v.FV().NumPy().reshape(3, -1).T for v in (found.vec, residual))
    pressure = np.abs(forces[mesh.nodes(SLAVE), 2]) / mesh.areas()
    return Answer(displacement, pressure, counts)


def read(mesh: Mesh) -> ng.Mesh:
    """NGSolve's mesh; nodes keep their order, sides are named by their tags."""
    found = netgen.Mesh(dim=3)
    found.AddPoints(np.ascontiguousarray(mesh.x))
    for body in (SPHERE, BLOCK):
        cells = mesh.cells[mesh.bodies == body] + 1
        found.SetMaterial(body, f"b{body}")
        found.AddElements(dim=3, index=body, data=cells.astype(np.int32), base=1)
    for number, tag in enumerate(np.unique(mesh.tags), 1):
        body = SPHERE if tag < MASTER else BLOCK
        side = netgen.FaceDescriptor(surfnr=number, domin=body, domout=0, bc=number)
        index = found.Add(side)
        found.SetBCName(number - 1, f"f{tag}")
        facets = (mesh.on(tag) + 1).astype(np.int32)
        found.AddElements(dim=2, index=index, data=facets, base=1)
    return ng.Mesh(found)


if __name__ == "__main__":
    common.main(solve)
