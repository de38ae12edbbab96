# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A shallow arch snaps through and lands on a floor: an arc-length method of one's own.

The arch spans 10, rises by 1, is 0.3 thick and clamped at its ends. A load on its back grows to a
limit, beyond which the arch carries less and less while it goes down; on the floor it carries more
again. With given loads no solver follows it. The method of Riks and Ramm takes the factor of the
load as another unknown and the length of the way as another equation: each iteration solves

    J dv = P,   J du = -R,   dlambda = -(D . du)/(D . dv),

with the way D of the step so far. Contact does not notice: a ``ContactAssembler`` gives R and J.

    python demos/arc_length.py
"""

from __future__ import annotations

import contactx as cx  # isort: skip

from mpi4py import MPI
from petsc4py import PETSc

import numpy as np

import ufl
from dolfinx import fem, la, mesh

SPAN, RISE, THICKNESS, FLOOR = 10.0, 1.0, 0.3, -0.5
LENGTH, STEPS = 1.0, 16


class Arch:
    """The arch over its floor.

    Attributes:
        u: Displacement.
        F: Residual, with the factor of the load.
        factor: The factor.
        load: Load of factor one, on the displacements of this rank.
        bcs: Dirichlet conditions.
        contact: The arch's lower face on the floor.
    """

    def __init__(self) -> None:
        """Make the mesh and the load."""
        box = [[0.0, 0.0], [SPAN, THICKNESS]]
        cells = mesh.CellType.quadrilateral
        domain = mesh.create_rectangle(MPI.COMM_WORLD, box, [60, 3], cells)
        flat = domain.geometry.x.copy()
        domain.geometry.x[:, 1] += RISE * np.sin(np.pi * flat[:, 0] / SPAN)
        V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
        self.u, v = fem.Function(V), ufl.TestFunction(V)
        F = ufl.Identity(2) + ufl.grad(self.u)
        E = (F.T * F - ufl.Identity(2)) / 2
        self.factor = fem.Constant(domain, 0.0)

        def arch(x: np.ndarray) -> np.ndarray:
            shape: np.ndarray = RISE * np.sin(np.pi * x[0] / SPAN)
            return shape

        ends = mesh.locate_entities_boundary(
            domain, 1, lambda x: np.isclose(x[0], 0) | np.isclose(x[0], SPAN)
        )
        lower = mesh.locate_entities_boundary(domain, 1, lambda x: np.isclose(x[1], arch(x)))
        back = mesh.locate_entities_boundary(
            domain, 1, lambda x: np.isclose(x[1], arch(x) + THICKNESS) & (abs(x[0] - 5) < 2)
        )
        facets = np.concatenate([lower, back])
        values = np.repeat([1, 2], [len(lower), len(back)]).astype(np.int32)
        order = np.argsort(facets)
        tags = mesh.meshtags(domain, 1, facets[order], values[order])
        push = -v[1] * ufl.ds(domain=domain, subdomain_data=tags, subdomain_id=2)
        inner = ufl.inner(F * (2 * E + ufl.tr(E) * ufl.Identity(2)), ufl.grad(v)) * ufl.dx
        self.F = inner - self.factor * push
        load = fem.assemble_vector(fem.form(push))
        load.scatter_reverse(la.InsertMode.add)
        self.load = load.array[: 2 * V.dofmap.index_map.size_local].copy()
        clamped = fem.locate_dofs_topological(V, 1, ends)
        self.bcs = [fem.dirichletbc(np.zeros(2), clamped, V)]
        floor = cx.Plane(point=(0, FLOOR), normal=(0, 1))
        self.contact = cx.Contact(slave=cx.Surface(tags, 1), master=floor)


def follow(arch: Arch) -> list[tuple[float, float, float]]:
    """Follow the arch through its snap; factors, deflections and the floor's forces."""
    assembler = cx.ContactAssembler(arch.F, arch.u, contacts=[arch.contact], bcs=arch.bcs)
    P, b, du, dv, way = (assembler.create_vector() for _ in range(5))
    n = len(arch.load)
    P.array[:n] = arch.load
    ksp = PETSc.KSP().create(P.comm)
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    path = []
    for _ in range(STEPS):
        assembler.begin_step()
        assembler.settle()
        assembler.set_up(ksp)
        ksp.solve(P, dv)
        # Forward along the last step's way, multipliers apart
        forward = way.dot(dv)
        way.array[:n], way.array[n:] = dv.array_r[:n], 0
        change = np.copysign(LENGTH / way.norm(), forward)
        way.scale(change)
        dv.scale(change)
        arch.factor.value += change
        assembler.update(dv)
        while not assembler.settle().converged:
            assembler.residual(b)
            assembler.set_up(ksp)
            ksp.solve(P, dv)
            ksp.solve(-b, du)
            change = -way.dot(du) / way.dot(dv)
            du.axpy(change, dv)
            part = assembler.limit(du)
            arch.factor.value += part * change
            assembler.update(du, part)
        assembler.accept()
        sag = MPI.COMM_WORLD.allreduce(arch.u.x.array[1::2].min(), MPI.MIN)
        path.append((float(arch.factor.value), float(sag), float(arch.contact.force[1])))
    return path


def main() -> None:
    """Follow the path and print it."""
    path = follow(Arch())
    if MPI.COMM_WORLD.rank == 0:
        print("load    deflection  floor")
        for factor, sag, force in path:
            print(f"{factor:.5f}  {sag:9.4f}  {force:.5f}")


if __name__ == "__main__":
    main()
