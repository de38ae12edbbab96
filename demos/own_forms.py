# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A loop of one's own on forms: SNES with bulk and contact in one matrix.

A neo-Hookean block is pressed on a stiffer one and pushed sideways, with friction. The script
assembles the bulk itself, as DOLFINx's own demos do, and gives SNES its callbacks. The lines marked
"contact" add the contact's forms to the same vector and matrix, and let pairs, active set and law
follow each iterate.

    python demos/own_forms.py
    mpiexec -n 2 python demos/own_forms.py
"""

from __future__ import annotations

import contactx as cx  # contact  # isort: skip

from petsc4py import PETSc

import numpy as np
import own_newton

import ufl
from dolfinx import fem, la
from dolfinx.fem.petsc import assemble_matrix

import story


def solve(scene: own_newton.Scene) -> list[int]:
    """Solve in steps; returns the numbers of iterations."""
    u, bcs = scene.u, scene.bcs
    F, J = fem.form(scene.F), fem.form(ufl.derivative(scene.F, u))
    V = u.function_space
    force = la.vector(V.dofmap.index_map, V.dofmap.index_map_bs)
    assembler = cx.ContactAssembler(scene.F, u, contacts=[scene.contact], bcs=bcs)  # contact
    forms = cx.Forms(assembler, J)  # contact
    b = assembler.create_vector()  # contact

    def residual(snes: PETSc.SNES, x: PETSc.Vec, b: PETSc.Vec) -> None:
        forms.update(x)  # contact: u and multipliers are those of x
        force.array[:] = 0
        fem.assemble_vector(force.array, F)
        fem.apply_lifting(force.array, [J], bcs=[bcs], x0=[u.x.array], alpha=-1)
        force.scatter_reverse(la.InsertMode.add)
        for bc in bcs:
            bc.set(force.array, u.x.array, -1)
        b.zeroEntries()
        n = force.index_map.size_local * force.block_size
        b.array[:n] = force.array[:n]
        forms.assemble_vector(b)  # contact

    def jacobian(snes: PETSc.SNES, x: PETSc.Vec, A: PETSc.Mat, P: PETSc.Mat) -> None:
        assemble_matrix(A, [[J]], bcs=bcs)
        forms.assemble_matrix(A)  # contact

    def converged(snes: PETSc.SNES, number: int, norms: tuple[float, float, float]) -> bool:
        x = snes.getSolution()
        found = forms.settle(x)  # contact: pairs, active set and law follow the iterate
        snes.computeFunction(x, b)  # contact
        snes.setJacobian(jacobian, forms.matrix())  # contact: zero, with places for these pairs
        return found.converged

    def shorten(x: PETSc.Vec, step: PETSc.Vec) -> bool:
        step.scale(-1)  # contact: no cell may turn inside out
        step.scale(-assembler.limit(step))  # contact
        return True

    snes = PETSc.SNES().create(b.comm)
    snes.setFunction(residual, b)
    snes.setJacobian(jacobian, forms.matrix())
    snes.setConvergenceTest(converged)
    snes.setLineSearchPreCheck(shorten)
    snes.getLineSearch().setType("basic")
    snes.getKSP().setType("preonly")
    snes.getKSP().getPC().setType("lu")
    snes.getKSP().getPC().setFactorSolverType("mumps")
    counts = []
    for step in range(own_newton.STEPS):
        scene.load((step + 1) / own_newton.STEPS)
        assembler.begin_step()  # contact
        snes.solve(None, assembler.x)
        assembler.accept()  # contact
        counts.append(snes.getIterationNumber())
    return counts


def main() -> None:
    """Solve and print the forces."""
    scene = own_newton.Scene()
    counts = solve(scene)
    force = scene.contact.force
    text = f"iterations {counts}, force on the upper block {np.round(force, 6)}"
    story.console.print(text, highlight=False)


if __name__ == "__main__":
    main()
