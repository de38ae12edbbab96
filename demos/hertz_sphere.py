# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz: an elastic sphere on an elastic block.

A quarter of a hemisphere, R = 1, rests on a quarter of a block; E = 1, nu = 0.3 for both, without
friction. The top of the sphere moves down by 0.02. The force F of the whole sphere follows from
the reaction, and Hertz gives the contact radius and the pressure for it,

    a = (3 F R / (4 E*))^(1/3),   p(r) = p0 sqrt(1 - r^2/a^2),   p0 = 3 F / (2 pi a^2),

with 1/E* = 2 (1 - nu^2)/E. Node-to-surface contact carries the right force; its multipliers scatter
about Hertz's pressure on meshes that do not match, and ``contact.pressure`` is recovered from them.

    python demos/hertz_sphere.py --h 0.02
"""

from __future__ import annotations

from collections.abc import Sequence

from mpi4py import MPI

import numpy as np

import contactx as cx
from dolfinx import fem

import meshes
import reference
import story
from meshes import Tag

E, NU = 1.0, 0.3
DISPLACEMENT = -0.02


def create(
    h: float, sliding: str, comm: MPI.Comm = MPI.COMM_WORLD
) -> tuple[cx.ContactProblem, cx.Contact, fem.Form]:
    """The bodies, their supports and the contact."""
    data = meshes.hertz_sphere(h, comm=comm)
    mesh, tags = data.mesh, data.facet_tags
    u = story.displacement(mesh)
    F = story.elasticity(u, E, NU)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        story.fix(u, tags, 2, DISPLACEMENT, Tag.UPPER_TOP),
        *(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
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
        story.Result("peak pressure", hertz.peak_pressure, story.nodal_pressure(contact).max()),
        story.Result("largest multiplier", hertz.peak_pressure, contact.multiplier.max()),
    ]

    title = "Elastic sphere on an elastic block"
    story.show("Hertz: sphere on block", results)
    files = story.draw(
        "hertz_sphere", title, args.output, problem, contact, r, hertz, mirror=("x", "y")
    )
    story.see(files)
    return results


if __name__ == "__main__":
    main()
