# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz: an elastic sphere on an elastic block.

A quarter of a hemisphere, R = 1, rests on a quarter of a block; E = 1, nu = 0.3 for both, without
friction. The top of the sphere moves down by 0.02. The force F of the whole sphere follows from
the reaction, and Hertz gives the contact radius and the pressure for it,

    a = (3 F R / (4 E*))^(1/3),   p(r) = p0 sqrt(1 - r^2/a^2),   p0 = 3 F / (2 pi a^2),

with 1/E* = 2 (1 - nu^2)/E. Node-to-surface contact carries the right force; its nodal pressures
scatter about Hertz's on meshes that do not match.

    python demos/hertz_sphere.py --h 0.02
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import story

import contactx as cx
import ufl
from contactx import meshes, plot, reference
from contactx.meshes import Tag
from dolfinx import fem

E, NU = 1.0, 0.3
DISPLACEMENT = -0.02


def create(h: float, sliding: str) -> tuple[cx.ContactProblem, cx.Contact, fem.Form]:
    """The bodies, their supports and the contact."""
    data = meshes.hertz_sphere(h)
    mesh, tags = data.mesh, data.facet_tags
    V = fem.functionspace(mesh, ("Lagrange", 1, (3,)))
    u = fem.Function(V, name="displacement")
    v = ufl.TestFunction(V)

    def strain(w):
        return ufl.sym(ufl.grad(w))

    mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
    stress = 2 * mu * strain(u) + lmbda * ufl.tr(strain(u)) * ufl.Identity(3)
    F = ufl.inner(stress, strain(v)) * ufl.dx

    def fix(component: int, value: float, *faces: Tag) -> fem.DirichletBC:
        facets = np.concatenate([tags.find(face) for face in faces])
        dofs = fem.locate_dofs_topological(V.sub(component), 2, facets)
        return fem.dirichletbc(np.float64(value), dofs, V.sub(component))

    bcs = [
        fix(0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        fix(1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        fix(2, DISPLACEMENT, Tag.UPPER_TOP),
        *(fix(i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
    ]
    sphere = cx.Surface(tags, Tag.UPPER_CONTACT)
    block = cx.Surface(tags, Tag.LOWER_CONTACT)
    contact = cx.Contact(slave=sphere, master=block, sliding=sliding)
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="hertz_")
    return problem, contact, fem.form(F)


def reaction(problem: cx.ContactProblem, F: fem.Form) -> float:
    """Vertical force on the whole block: four times the sum of the quarter's lower supports."""
    forces = fem.assemble_vector(F).array.reshape(-1, 3)
    x = problem.u.function_space.tabulate_dof_coordinates()
    return float(4 * forces[np.isclose(x[:, 2], -1), 2].sum())


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("An elastic sphere on an elastic block", 0.02, "in radii", argv)
    with story.progress("meshing"):
        problem, contact, F = create(args.h, args.sliding)
    story.solve(problem)

    force = reaction(problem, F)
    hertz = reference.HertzSphere(
        force=force, radius=1.0, modulus=reference.contact_modulus(E, NU, E, NU)
    )
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    r = np.hypot(x[:, 0], x[:, 1])
    closed = contact.multiplier > 0
    radius = np.sqrt(4 * contact.area[closed].sum() / np.pi)
    results = [
        story.Result("force on the sphere against the reaction", force, 4 * contact.force[2]),
        story.Result("contact radius", hertz.contact_radius, radius),
        story.Result("peak pressure", hertz.peak_pressure, contact.multiplier.max()),
    ]

    folder: Path = args.output
    files = [folder / f"hertz_sphere{end}" for end in (".png", "_pressure.png", ".pvd")]
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], problem.u, [contact]) as output:
            output.write(0.0)
        plot.deformed_bodies(
            problem.u,
            contact.pressure,
            files[0],
            title="Elastic sphere on an elastic block",
            label="contact pressure / E",
            mirror=("x", "y"),
        )
        near = r < 1.5 * hertz.contact_radius
        curve = np.linspace(0, 1.5 * hertz.contact_radius, 400)
        plot.pressure_curve(
            r[near],
            contact.multiplier[near],
            curve,
            hertz.pressure(curve),
            files[1],
            labels=("distance from the axis / R", "contact pressure / E"),
            title="Pressure of the slave nodes against Hertz",
        )
    story.show("Hertz: sphere on block", results, files)
    return results


if __name__ == "__main__":
    main()
