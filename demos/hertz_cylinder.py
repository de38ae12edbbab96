# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz: an elastic cylinder on an elastic block, plane strain.

Half of a cylinder, R = 1, rests on a block; E = 1, nu = 0.3 for both, without friction. Its flat
top moves down by 0.02. Hertz's line contact gives, for the force F per length,

    b = sqrt(4 F R / (pi E*)),   p(x) = p0 sqrt(1 - x^2/b^2),   p0 = 2 F / (pi b).

The block is not a half-space: with b/R = 0.12 the finite bodies differ from Hertz by half a per
cent on any mesh.

    python demos/hertz_cylinder.py --h 0.006
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


def create(h: float, sliding: str) -> tuple[cx.ContactProblem, cx.Contact]:
    """The bodies, their supports and the contact."""
    data = meshes.hertz_cylinder(h, h_master=h)
    mesh, tags = data.mesh, data.facet_tags
    V = fem.functionspace(mesh, ("Lagrange", 1, (2,)))
    u = fem.Function(V, name="displacement")
    v = ufl.TestFunction(V)

    def strain(w):
        return ufl.sym(ufl.grad(w))

    mu, lmbda = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
    stress = 2 * mu * strain(u) + lmbda * ufl.tr(strain(u)) * ufl.Identity(2)
    F = ufl.inner(stress, strain(v)) * ufl.dx

    def fix(component: int, value: float, *faces: Tag) -> fem.DirichletBC:
        facets = np.concatenate([tags.find(face) for face in faces])
        dofs = fem.locate_dofs_topological(V.sub(component), 1, facets)
        return fem.dirichletbc(np.float64(value), dofs, V.sub(component))

    bcs = [
        fix(0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
        fix(1, 0.0, Tag.LOWER_BOTTOM),
        fix(1, DISPLACEMENT, Tag.UPPER_TOP),
    ]
    cylinder = cx.Surface(tags, Tag.UPPER_CONTACT)
    block = cx.Surface(tags, Tag.LOWER_CONTACT)
    contact = cx.Contact(slave=cylinder, master=block, sliding=sliding)
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="line_")
    return problem, contact


def half_width(x: np.ndarray, pressure: np.ndarray) -> float:
    """Where the contact ends: half-way between the last closed and the first open node."""
    x, closed = np.sort(x), (pressure > 0)[np.argsort(x)]
    last = np.flatnonzero(closed)[-1]
    return float((x[last] + x[last + 1]) / 2)


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("An elastic cylinder on an elastic block", 0.006, "in radii", argv)
    with story.progress("meshing"):
        problem, contact = create(args.h, args.sliding)
    story.solve(problem)

    # Half of the cylinder carries half of the force
    force = 2 * contact.force[1]
    hertz = reference.HertzCylinder(
        force=force, radius=1.0, modulus=reference.contact_modulus(E, NU, E, NU)
    )
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    pressure = contact.multiplier
    carried = 2 * np.dot(contact.area, pressure)
    results = [
        story.Result("force per length, sum of the pressures", force, carried),
        story.Result("contact half-width", hertz.half_width, half_width(x, pressure)),
        story.Result("peak pressure", hertz.peak_pressure, pressure.max()),
    ]

    folder: Path = args.output
    files = [folder / f"hertz_cylinder{end}" for end in (".png", "_pressure.png", ".pvd")]
    with story.progress("drawing"):
        with cx.VTKOutput(files[2], problem.u, [contact]) as output:
            output.write(0.0)
        plot.deformed_bodies(
            problem.u,
            contact.pressure,
            files[0],
            title="Elastic cylinder on an elastic block",
            label="contact pressure / E",
            mirror=("x",),
        )
        near = x < 1.5 * hertz.half_width
        curve = np.linspace(0, 1.5 * hertz.half_width, 400)
        plot.pressure_curve(
            x[near],
            pressure[near],
            curve,
            hertz.pressure(curve),
            files[1],
            labels=("distance from the axis / R", "contact pressure / E"),
            title="Pressure of the slave nodes against Hertz",
        )
    story.show("Hertz: cylinder on block, plane strain", results, files)
    return results


if __name__ == "__main__":
    main()
