# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rigid punch that a function describes, pressed into an elastic block.

The punch is the paraboloid z > r^2 / (2 R) - 0.02, R = 1, given as a UFL function that is negative
inside; contactx differentiates it. Hertz's theory takes a sphere for this very paraboloid.

    python demos/level_set.py --h 0.02
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rigid_sphere

import contactx as cx

import reference
import story

DEPTH = 0.02


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments("A rigid paraboloid in an elastic block", 0.02, "in radii", argv)
    with story.progress("meshing"):
        u, bcs, surface = rigid_sphere.block(args.h)
    punch = cx.LevelSet(lambda x: (x[0] ** 2 + x[1] ** 2) / 2 - DEPTH - x[2])
    contact = cx.Contact(surface, punch, sliding=args.sliding)
    F = story.elasticity(u, rigid_sphere.E, rigid_sphere.NU)
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="punch_")
    story.solve(problem)

    modulus = reference.contact_modulus(rigid_sphere.E, rigid_sphere.NU, np.inf, 0.3)
    title = "Rigid paraboloid in an elastic block"
    return story.hertz("level_set", title, args.output, problem, contact, modulus)


if __name__ == "__main__":
    main()
