# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Heat through a contact: it flows where bodies are pressed together, and it presses them.

Half of a hot cylinder, R = 1, rests on a cold block, plane strain. Its flat top is held at T = 100,
the bottom of the block at 0; all else is insulated, but for the contact, where the flow per area is

    q = h(p, g) (T_cylinder - T_block),   h = 400 p / E + 0.02 / (1 + g / 0.01),

by asperities that the pressure p brings together and by a gas in the gap g. The cylinder expands as
it gets warm and is pressed the more: displacement and temperature depend on each other both ways.
They are solved for

- together: one ``ContactProblem`` of both fields with a ``Conductance``;
- in turns: the displacement for a temperature, the temperature for a pressure and a gap.

Both come to the same, and what the hot end gives crosses the contact and leaves at the cold one.

    python demos/heat_conductance.py --h 0.01
"""

from __future__ import annotations

from collections.abc import Sequence

import contactx as cx  # isort: skip

from petsc4py import PETSc

import numpy as np

import dolfinx.fem.petsc
import ufl
from dolfinx import fem

import meshes
import plot
import story
from meshes import Tag

E, NU, EXPANSION, CONDUCTIVITY, HOT = 1.0, 0.3, 1e-4, 1.0, 100.0
DISPLACEMENT = -0.01


def coefficient(p: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """Conductance of asperities and of gas."""
    return 400 * p / E + 0.02 / (1 + gap / 0.01)


class Bodies:
    """Cylinder and block with their displacement u and temperature T.

    Attributes:
        u: Displacement.
        T: Temperature.
        mechanics: Residual of the forces.
        heat: Residual of the heat, without what crosses the contact.
        held: Conditions on the displacement.
        ends: Conditions on the temperature, the hot end first.
        contact: The contact.
        conductance: What flows across it.
    """

    def __init__(self, h: float, sliding: str = "finite"):
        """Make the mesh, with cells of size h in the contact."""
        data = meshes.hertz_cylinder(h, h_master=h)
        mesh, tags = data.mesh, data.facet_tags
        self.u = u = story.displacement(mesh)
        self.T = T = fem.Function(fem.functionspace(mesh, ("Lagrange", 1)), name="temperature")
        v, q = ufl.TestFunction(u.function_space), ufl.TestFunction(T.function_space)
        mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
        # In plane strain heat presses across the plane, too
        strain = ufl.sym(ufl.grad(u))
        swelling = (3 * lmbda + 2 * mu) * EXPANSION * T
        stress = 2 * mu * strain + (lmbda * ufl.tr(strain) - swelling) * ufl.Identity(2)
        self.mechanics = ufl.inner(stress, ufl.grad(v)) * ufl.dx
        self.heat = CONDUCTIVITY * ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx
        self.held = [
            story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
            story.fix(u, tags, 1, 0.0, Tag.LOWER_BOTTOM),
            story.fix(u, tags, 1, DISPLACEMENT, Tag.UPPER_TOP),
        ]
        self.ends = [
            fem.dirichletbc(value, self._dofs(tags, face), T.function_space)
            for value, face in ((HOT, Tag.UPPER_TOP), (0.0, Tag.LOWER_BOTTOM))
        ]
        cylinder, block = cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT)
        self.contact = cx.Contact(
            slave=cylinder, master=block, sliding=sliding, method="surface-to-surface"
        )
        self.conductance = cx.Conductance(self.contact, T, coefficient)

    def _dofs(self, tags: object, face: int) -> np.ndarray:
        return fem.locate_dofs_topological(self.T.function_space, tags.dim, tags.find(face))

    def given(self) -> float:
        """Heat that the hot end gives."""
        b = fem.assemble_vector(fem.form(self.heat))
        return float(b.array[self.ends[0].dof_indices()[0]].sum())


def together(bodies: Bodies) -> cx.ContactProblem:
    """Solve for both fields at once."""
    problem = cx.ContactProblem(
        [bodies.mechanics, bodies.heat],
        [bodies.u, bodies.T],
        displacement=0,
        contacts=[bodies.contact],
        bcs=bodies.held + bodies.ends,
        conductances=[bodies.conductance],
        petsc_options_prefix="heat_",
    )
    story.solve(problem)
    return problem


def in_turns(bodies: Bodies, rtol: float = 1e-9) -> int:
    """Solve for one field after the other until the temperature stays; returns the rounds."""
    mechanics = cx.ContactProblem(
        bodies.mechanics,
        bodies.u,
        contacts=[bodies.contact],
        bcs=bodies.held,
        petsc_options_prefix="turns_",
    )
    T, space = bodies.T, bodies.T.function_space
    trial, test = ufl.TrialFunction(space), ufl.TestFunction(space)
    a = fem.form(CONDUCTIVITY * ufl.inner(ufl.grad(trial), ufl.grad(test)) * ufl.dx)
    L = fem.form(fem.Constant(space.mesh, 0.0) * test * ufl.dx)
    ksp = PETSc.KSP().create(space.mesh.comm)
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    for number in range(1, 101):
        mechanics.solve()
        A = dolfinx.fem.petsc.assemble_matrix(a, bcs=bodies.ends)
        A.assemble()
        # The ends are far from the contact, so that its rows are none of theirs
        A.axpy(1.0, bodies.conductance.matrix())
        b = dolfinx.fem.petsc.assemble_vector(L)
        dolfinx.fem.petsc.apply_lifting(b, [a], bcs=[bodies.ends])
        b.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
        dolfinx.fem.petsc.set_bc(b, bodies.ends)
        before = T.x.array.copy()
        ksp.setOperators(A)
        ksp.solve(b, T.x.petsc_vec)
        T.x.scatter_forward()
        if np.abs(T.x.array - before).max() < rtol * HOT:
            return number
    raise RuntimeError("the fields do not come to rest in turns: solve for them together")


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve in both ways, compare and draw."""
    args = story.arguments("Heat through the contact of two bodies", 0.01, "in radii", argv)
    with story.progress("meshing"):
        first, second = (Bodies(args.h, args.sliding) for _ in range(2))
    problem = together(first)
    with story.progress("solving in turns"):
        rounds = in_turns(second)
    story.console.print(
        f"together {problem.report.iterations} iterations, in turns {rounds} rounds"
    )
    flow, peak = first.conductance.flow, first.contact.pressure.x.array.max()
    cold = Bodies(args.h, args.sliding)
    cx.ContactProblem(
        cold.mechanics, cold.u, contacts=[cold.contact], bcs=cold.held, petsc_options_prefix="cold_"
    ).solve()
    pressed = first.contact.force[1] / cold.contact.force[1]
    story.console.print(f"the heat presses {pressed:.3f} times as much as the supports alone")
    results = [
        story.Result("heat across, of what the hot end gives", first.given(), flow),
        story.Result("heat across, in turns and together", flow, second.conductance.flow),
        story.Result("peak pressure, likewise", peak, second.contact.pressure.x.array.max()),
    ]
    story.show("Hot cylinder on a cold block", results)
    files = [args.output / f"heat_conductance{end}" for end in (".png", ".pvd")]
    with story.progress("drawing"):
        plot.deformed_bodies(
            first.u,
            first.T,
            files[0],
            title="Heat from a cylinder to a block",
            label="temperature",
            mirror=("x",),
        )
        with cx.VTKOutput(files[1], first.u, [first.contact]) as output:
            output.write(0.0)
    story.see(files)
    return results


if __name__ == "__main__":
    main()
