# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""An elastic sphere on a rigid plane.

A quarter of a hemisphere, R = 1, E = 1, nu = 0.3, without friction, is pressed on the plane z = 0
by 0.02. A rigid obstacle has no mesh and no unknowns: there is no second surface to match, and
only the sphere is solved for. Hertz's formulas hold with 1/E* = (1 - nu^2)/E.

    python demos/rigid_plane.py --h 0.02
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
    """The sphere, its supports and the plane."""
    mesh, tags = meshes.single(meshes.hertz_sphere(h), Tag.UPPER)
    u = story.displacement(mesh)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0),
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0),
        story.fix(u, tags, 2, DISPLACEMENT, Tag.UPPER_TOP),
    ]
    plane = cx.Plane(point=(0, 0, 0), normal=(0, 0, 1))
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), plane, sliding=sliding)
    problem = cx.ContactProblem(
        story.elasticity(u, E, NU), u, contacts=[contact], bcs=bcs, petsc_options_prefix="plane_"
    )
    return problem, contact


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("An elastic sphere on a rigid plane", 0.02, "in radii", argv)
    with story.progress("meshing"):
        problem, contact = create(args.h, args.sliding)
    story.solve(problem)

    modulus = reference.contact_modulus(E, NU, np.inf, NU)
    title = "Elastic sphere on a rigid plane"
    return story.hertz("rigid_plane", title, args.output, problem, contact, modulus)


if __name__ == "__main__":
    main()
