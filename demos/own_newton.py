# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A Newton loop of one's own, written out with petsc4py.

A neo-Hookean block is pressed on a stiffer one and pushed sideways, with friction, in three load
steps. ``ContactProblem`` would do all this. Whoever needs the loop itself, to couple other
equations or to solve the linear systems in another way, takes a ``ContactAssembler``: it pairs the
nodes and finds out which are in contact (``settle``), says how far a step may go (``limit``) and
assembles the residual and the Jacobian of bulk and contact.

    python demos/own_newton.py
    mpiexec -n 2 python demos/own_newton.py
"""

from __future__ import annotations

import contactx as cx  # isort: skip

from petsc4py import PETSc

import numpy as np

import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
import story
from meshes import Tag

STEPS = 3


class Scene:
    """Two blocks in contact, the upper one moved by its top.

    Attributes:
        u: Displacement.
        F: Residual of the blocks.
        bcs: Dirichlet conditions.
        contact: The upper block's lower face on the lower one's upper face.
    """

    def __init__(self) -> None:
        """Make the meshes and the conditions."""
        data = meshes.blocks(CellType.quadrilateral, [8, 8], [12, 6], size_lower=[2.0, 1.0])
        mesh, tags = data.mesh, data.facet_tags
        self.u = u = story.displacement(mesh)
        F = ufl.Identity(2) + ufl.grad(u)
        log = ufl.ln(ufl.det(F))
        energy = 0.5 * (ufl.tr(F.T * F) - 2 - 2 * log) + log**2
        self.F = ufl.derivative(energy * ufl.dx, u)
        self.top = [fem.Constant(mesh, 0.0), fem.Constant(mesh, 0.0)]
        V = u.function_space
        self.bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2)]
        for i, value in enumerate(self.top):
            sub = V.sub(i)
            dofs = fem.locate_dofs_topological(sub, 1, tags.find(Tag.UPPER_TOP))
            self.bcs.append(fem.dirichletbc(value, dofs, sub))
        upper, lower = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT)
        self.contact = cx.Contact(slave=upper, master=lower, friction=0.2)

    def load(self, t: float) -> None:
        """Move the top, t in (0, 1]."""
        self.top[0].value, self.top[1].value = 0.1 * t, -0.2 * t


def solve(scene: Scene, *, condensed: bool = False) -> list[int]:
    """Solve in steps; returns the numbers of iterations."""
    assembler = cx.ContactAssembler(scene.F, scene.u, contacts=[scene.contact], bcs=scene.bcs)
    b, dx = assembler.create_vector(), assembler.create_vector()
    ksp = PETSc.KSP().create(b.comm)
    ksp.setOptionsPrefix("own_")
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    counts = []
    for step in range(STEPS):
        scene.load((step + 1) / STEPS)
        assembler.begin_step()
        while not assembler.settle().converged:
            assembler.residual(b)
            b.scale(-1)
            assembler.set_up(ksp, condensed=condensed)
            ksp.solve(b, dx)
            assembler.update(dx, assembler.limit(dx))
        assembler.accept()
        counts.append(assembler.report.iterations)
    return counts


def main() -> None:
    """Solve and print the forces."""
    scene = Scene()
    counts = solve(scene)
    force = scene.contact.force
    text = f"iterations {counts}, force on the upper block {np.round(force, 6)}"
    story.console.print(text, highlight=False)


if __name__ == "__main__":
    main()
