# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Hertz: an elastic sphere on an elastic block, as an axisymmetric model.

The meridian section of half of a sphere, R = 1, rests on that of a block; E = 1, nu = 0.3 for both,
without friction. The flat top moves down by 0.005. The bulk is integrated over the section with
2 pi r, and the contact is given the same weight: its force is that of the whole sphere. Hertz's
point contact gives, for the force F,

    a^3 = 3 F R / (4 E*),   p(r) = p0 sqrt(1 - r^2/a^2),   p0 = 3 F / (2 pi a^2).

    python demos/hertz_axisymmetric.py --h 0.003
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem

import meshes
import reference
import story
from meshes import Tag

E, NU = 1.0, 0.3
DISPLACEMENT = -0.005


def elasticity(u: fem.Function, young: float, nu: float) -> ufl.Form:
    """Residual of linear elasticity about the axis r = 0: u = (u_r, u_z), hoop strain u_r / r."""
    v = ufl.TestFunction(u.function_space)
    r, _ = ufl.SpatialCoordinate(u.function_space.mesh)
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))

    def strain(w: ufl.core.expr.Expr) -> ufl.core.expr.Expr:
        plane = ufl.sym(ufl.grad(w))
        return ufl.as_tensor(
            [[plane[0, 0], plane[0, 1], 0], [plane[1, 0], plane[1, 1], 0], [0, 0, w[0] / r]]
        )

    stress = 2 * mu * strain(u) + lmbda * ufl.tr(strain(u)) * ufl.Identity(3)
    return ufl.inner(stress, strain(v)) * 2 * ufl.pi * r * ufl.dx


def create(
    h: float, sliding: str = "finite", method: str = "surface-to-surface", friction: float = 0.0
) -> tuple[cx.ContactProblem, cx.Contact]:
    """The sections, their supports and the contact."""
    data = meshes.hertz_cylinder(h, h_master=h)
    mesh, tags = data.mesh, data.facet_tags
    u = story.displacement(mesh)
    bcs = [
        story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, DISPLACEMENT, Tag.UPPER_TOP),
    ]
    r, _ = ufl.SpatialCoordinate(mesh)
    contact = cx.Contact(
        slave=cx.Surface(tags, Tag.UPPER_CONTACT),
        master=cx.Surface(tags, Tag.LOWER_CONTACT),
        sliding=sliding,
        method=method,
        friction=friction,
        weight=2 * ufl.pi * r,
    )
    problem = cx.ContactProblem(
        elasticity(u, E, NU), u, contacts=[contact], bcs=bcs, petsc_options_prefix="axis_"
    )
    return problem, contact


def main(argv: Sequence[str] | None = None) -> list[story.Result]:
    """Solve, compare with Hertz and draw."""
    args = story.arguments(
        "An elastic sphere on an elastic block, axisymmetric", 0.003, "in radii", argv, methods=True
    )
    with story.progress("meshing"):
        problem, contact = create(args.h, args.sliding, args.method)
    story.solve(problem)

    force = contact.force[1]
    hertz = reference.HertzSphere(
        force=force, radius=1.0, modulus=reference.contact_modulus(E, NU, E, NU)
    )
    r = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    pressure = story.nodal_pressure(contact)
    closed = pressure > 0
    inside = closed & (r < 0.9 * hertz.contact_radius)
    worst = np.abs(pressure - hertz.pressure(r))[inside].max()
    results = [
        story.Result("force, sum of the pressures", force, float(contact.area @ pressure)),
        story.Result(
            "contact radius", hertz.contact_radius, np.sqrt(contact.area[closed].sum() / np.pi)
        ),
        story.Result("pressure on the axis", hertz.peak_pressure, pressure[np.argmin(r)]),
        story.Result(
            "pressure inside 0.9 a, at worst", hertz.peak_pressure, hertz.peak_pressure + worst
        ),
    ]
    story.show("Hertz: sphere on block, axisymmetric", results)
    files = story.draw(
        "hertz_axisymmetric",
        "Elastic sphere on an elastic block, meridian section",
        args.output,
        problem,
        contact,
        r,
        hertz,
        mirror=("x",),
    )
    story.see(files)
    return results


if __name__ == "__main__":
    main()
