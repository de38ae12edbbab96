# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rigid cylinder pressed into an elastic block that cannot expand along it: plane strain in 3D.

The cylinder, R = 1, lies along y on a block of unit height, E = 1, nu = 0.3, one cell thick along y
and with u_y = 0. Hertz's line contact holds with 1/E* = (1 - nu^2)/E.

    python demos/rigid_cylinder.py --h 0.01
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import contactx as cx
from dolfinx.mesh import CellType

import meshes
import reference
import story
from meshes import Tag

E, NU = 1.0, 0.3
DEPTH = 0.02


def create(h: float, sliding: str) -> tuple[cx.ContactProblem, cx.Contact]:
    """The half x >= 0 of the block and the cylinder."""
    n = int(np.ceil(1 / h))
    coarse = meshes.blocks(
        CellType.hexahedron, (1, 1, 1), (n // 2, 1, n // 2), size_lower=(1.0, h, 1.0)
    )
    mesh, tags = meshes.single(coarse, Tag.LOWER)
    # Cells grow away from the contact, at the edge x = z = 0
    x = mesh.geometry.x
    x[:, 0] **= 2
    x[:, 2] = -(x[:, 2] ** 2)
    u = story.displacement(mesh)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_Y0, Tag.LOWER_Y1),
        story.fix(u, tags, 2, 0.0, Tag.LOWER_BOTTOM),
    ]
    cylinder = cx.Cylinder(point=(0, 0, 1 - DEPTH), axis=(0, 1, 0), radius=1.0)
    contact = cx.Contact(cx.Surface(tags, Tag.LOWER_CONTACT), cylinder, sliding=sliding)
    problem = cx.ContactProblem(
        story.elasticity(u, E, NU), u, contacts=[contact], bcs=bcs, petsc_options_prefix="rod_"
    )
    return problem, contact


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("A rigid cylinder in an elastic block", 0.01, "in radii", argv)
    with story.progress("meshing"):
        problem, contact = create(args.h, args.sliding)
    story.solve(problem)

    x = problem.u.function_space.tabulate_dof_coordinates()
    thickness = np.ptp(x[:, 1])
    force = -2 * contact.force[2] / thickness
    hertz = reference.HertzCylinder(
        force=force, radius=1.0, modulus=reference.contact_modulus(E, NU, np.inf, NU)
    )
    slave = x[contact.slave_nodes]
    pressure, width = story.nodal_pressure(contact), contact.area / thickness
    results = [
        story.Result("force per length, sum of pressures", force, 2 * np.dot(width, pressure)),
        story.Result("contact half-width", hertz.half_width, width[pressure > 0].sum()),
        story.Result("peak pressure", hertz.peak_pressure, pressure.max()),
    ]
    title = "Rigid cylinder in an elastic block"
    story.show(title, results)
    files = story.draw(
        "rigid_cylinder", title, args.output, problem, contact, slave[:, 0], hertz, mirror=("x",)
    )
    story.see(files)
    return results


if __name__ == "__main__":
    main()
