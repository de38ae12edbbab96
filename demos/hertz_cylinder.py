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

import numpy as np

import contactx as cx

import meshes
import reference
import story
from meshes import Tag

E, NU = 1.0, 0.3
DISPLACEMENT = -0.02


def create(h: float, sliding: str) -> tuple[cx.ContactProblem, cx.Contact]:
    """The bodies, their supports and the contact."""
    data = meshes.hertz_cylinder(h, h_master=h)
    mesh, tags = data.mesh, data.facet_tags
    u = story.displacement(mesh)
    F = story.elasticity(u, E, NU)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, DISPLACEMENT, Tag.UPPER_TOP),
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
    pressure = story.nodal_pressure(contact)
    carried = 2 * np.dot(contact.area, pressure)
    results = [
        story.Result("force per length, sum of the pressures", force, carried),
        story.Result("contact half-width", hertz.half_width, half_width(x, pressure)),
        story.Result("peak pressure", hertz.peak_pressure, pressure.max()),
    ]

    title = "Elastic cylinder on an elastic block"
    story.show("Hertz: cylinder on block, plane strain", results)
    files = story.draw(
        "hertz_cylinder", title, args.output, problem, contact, x, hertz, mirror=("x",)
    )
    story.see(files)
    return results


if __name__ == "__main__":
    main()
