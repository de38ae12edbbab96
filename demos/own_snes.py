# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""DOLFINx's NonlinearProblem and its SNES, with contact added to it.

The script is one of DOLFINx's own: a hyperelastic block that is pressed down. The lines marked
"contact" let a rigid ball stand below it.

    python demos/own_snes.py
"""

from __future__ import annotations

import contactx as cx  # contact  # isort: skip

from mpi4py import MPI

import numpy as np

import ufl
from dolfinx import fem, mesh
from dolfinx.fem.petsc import NonlinearProblem

OPTIONS = {
    "snes_linesearch_type": "basic",
    "snes_rtol": 1e-11,
    "ksp_type": "preonly",
    "pc_type": "lu",
    "pc_factor_mat_solver_type": "mumps",
}


class Scene:
    """A block over a rigid ball, moved by its top.

    Attributes:
        u: Displacement.
        F: Residual.
        bcs: Dirichlet conditions.
        contact: The block's lower face on the ball.
    """

    def __init__(self) -> None:
        """Make the mesh, the material and the conditions."""
        domain = mesh.create_box(
            MPI.COMM_WORLD, [[-1, -1, 0], [1, 1, 1]], [8, 8, 4], mesh.CellType.hexahedron
        )
        V = fem.functionspace(domain, ("Lagrange", 1, (3,)))
        self.u = u = fem.Function(V)
        F = ufl.Identity(3) + ufl.grad(u)
        energy = 0.5 * (ufl.tr(F.T * F) - 3 - 2 * ufl.ln(ufl.det(F))) + ufl.ln(ufl.det(F)) ** 2
        self.F = ufl.derivative(energy * ufl.dx, u)
        top = mesh.locate_entities_boundary(domain, 2, lambda x: np.isclose(x[2], 1))
        down = np.array([0.0, 0.0, -0.15])
        self.bcs = [fem.dirichletbc(down, fem.locate_dofs_topological(V, 2, top), V)]
        bottom = mesh.locate_entities_boundary(domain, 2, lambda x: np.isclose(x[2], 0))  # contact
        ones = np.ones(len(bottom), dtype=np.int32)  # contact
        lower = cx.Surface(mesh.meshtags(domain, 2, bottom, ones), 1)  # contact
        self.contact = cx.Contact(lower, cx.Sphere((0, 0, -1), 1.0), friction=0.1)  # contact


def solve(scene: Scene) -> cx.Report:
    """Solve with the SNES of a NonlinearProblem."""
    F, u, bcs = scene.F, scene.u, scene.bcs
    problem = NonlinearProblem(F, u, bcs=bcs, petsc_options_prefix="snes_", petsc_options=OPTIONS)
    assembler = cx.ContactAssembler(F, u, contacts=[scene.contact], bcs=bcs)  # contact
    assembler.attach(problem.solver)  # contact
    assembler.begin_step()  # contact
    problem.solver.solve(None, assembler.x)  # contact
    assembler.accept()  # contact
    return assembler.report


def main() -> None:
    """Solve and print."""
    scene = Scene()
    report = solve(scene)
    if MPI.COMM_WORLD.rank == 0:
        # Adding zero takes the sign off zeros
        force = np.round(scene.contact.force, 6) + 0.0
        print(f"{report.iterations} iterations, force on the block {force}")


if __name__ == "__main__":
    main()
