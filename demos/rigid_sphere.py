# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rigid ball pressed into an elastic block.

The ball, R = 1, moves into a quarter of a block, E = 1, nu = 0.3, in two steps: its centre is a
``fem.Constant``, and changing its value moves the obstacle. Hertz's formulas hold with
1/E* = (1 - nu^2)/E.

    python demos/rigid_sphere.py --h 0.02
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import contactx as cx
from dolfinx import fem

import meshes
import reference
import story
from meshes import Tag

E, NU = 1.0, 0.3
DEPTHS = (0.01, 0.02)


def block(h: float) -> tuple[fem.Function, list[fem.DirichletBC], cx.Surface]:
    """A quarter of an elastic block, fine about the origin, on a rigid base."""
    mesh, tags = meshes.single(meshes.hertz_sphere(h), Tag.LOWER)
    u = story.displacement(mesh)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.LOWER_X0),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_Y0),
        *(story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
    ]
    return u, bcs, cx.Surface(tags, Tag.LOWER_CONTACT)


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("A rigid ball pressed into an elastic block", 0.02, "in radii", argv)
    with story.progress("meshing"):
        u, bcs, surface = block(args.h)
    centre = fem.Constant(u.function_space.mesh, np.array([0.0, 0.0, 1.0]))
    contact = cx.Contact(surface, cx.Sphere(centre, radius=1.0), sliding=args.sliding)
    problem = cx.ContactProblem(
        story.elasticity(u, E, NU), u, contacts=[contact], bcs=bcs, petsc_options_prefix="ball_"
    )
    for depth in DEPTHS:
        centre.value[2] = 1 - depth
        story.solve(problem)

    modulus = reference.contact_modulus(E, NU, np.inf, NU)
    title = "Rigid ball in an elastic block"
    return story.hertz("rigid_sphere", title, args.output, problem, contact, modulus)


if __name__ == "__main__":
    main()
