# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A tube that is expanded into its plate, and the root of a blade in its slot; mm, MPa."""

from __future__ import annotations

import math
from functools import cache
from types import ModuleType
from typing import Any

from mpi4py import MPI

import hertz_axisymmetric
import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem

import story
from meshes import Tag
from meshes.build import build_mesh
from meshes.outline import POINT_SIZES
from published.drawing import curve, deformed
from published.record import Answer, Case, steps
from scenes.grids import create, faces, grid
from scenes.materials import axisymmetric_strain
from scenes.problems import make_problem, pair_of

# The tube, its clearance and the plate around it, of steel; the tube yields without hardening
BORE, OUTSIDE, CLEARANCE, PLATE = 8.0, 10.0, 0.05, 20.0
E, NU, YIELD, PRESSURE = 200e3, 0.3, 250.0, 220.0
# Slope of the blade's flanks, friction, and how much of the pull is left at the end
FLANK, FRICTION, LEFT = math.radians(45), 0.3, 0.1


def tube() -> Answer:
    """Pressure that remains between tube and plate, axisymmetric and in plane strain.

    The tube is plastic all through: the pressure outside it is less than that in its bore by
    2/sqrt(3) Y log(ro/ri), Y being the yield stress. When the bore's is let go both are elastic, as
    one thick ring after Lame.
    """
    low = OUTSIDE + CLEARANCE
    domain = create(
        grid((BORE, 0), (OUTSIDE, 0.25), (8, 1)), grid((low, 0), (PLATE, 0.25), (12, 1))
    )
    tags = faces(domain, ((0, BORE), (0, OUTSIDE), (0, low), (1, 0.0), (1, 0.25)))
    u = story.displacement(domain)
    V = u.function_space
    element = basix.ufl.quadrature_element(domain.basix_cell(), value_shape=(3, 3), degree=2)
    plastic = fem.Function(fem.functionspace(domain, element))
    r = ufl.SpatialCoordinate(domain)[0]
    weight = 2 * ufl.pi * r
    shear = E / (2 * (1 + NU))
    deviator = 2 * shear * ufl.dev(axisymmetric_strain(u) - plastic)
    mises = ufl.sqrt(1.5 * ufl.inner(deviator, deviator) + 1e-8)
    yields = ufl.conditional(ufl.lt(r, low - CLEARANCE / 2), YIELD, 1e9)
    flow = ufl.max_value(mises - yields, 0) / (2 * shear) * deviator / mises
    dx = ufl.dx(metadata={"quadrature_degree": 2, "quadrature_scheme": "default"})
    inside = fem.Constant(domain, (0.0, 0.0))
    test = axisymmetric_strain(ufl.TestFunction(V))
    F = hertz_axisymmetric.elasticity(u, E, NU)
    F -= 2 * shear * ufl.inner(plastic + flow, test) * weight * dx
    ds = ufl.Measure("ds", domain=domain, subdomain_data=tags)
    F -= ufl.inner(inside, ufl.TestFunction(V)) * weight * ds(1)
    contact = cx.Contact(cx.Surface(tags, 2), cx.Surface(tags, 3), weight=weight)
    problem = make_problem(F, u, [contact], [story.fix(u, tags, 1, 0.0, 4, 5)])
    added = fem.Expression(plastic + flow, plastic.function_space.element.interpolation_points)

    def update(t: float) -> None:
        inside.value[0] = PRESSURE * min(2 * t, 2 - 2 * t)

    iterations, path = [], []
    for solves in steps(problem, 10, update, history=[plastic]):
        new = fem.Function(plastic.function_space)
        new.interpolate(added)
        plastic.x.array[:] = new.x.array
        iterations.append(solves)
        path.append((float(inside.value[0]), float(story.nodal_pressure(contact).mean())))
    through = BORE**2 / (PLATE**2 - BORE**2) * (PLATE**2 / OUTSIDE**2 - 1)
    loss = 2 / math.sqrt(3) * YIELD * math.log(OUTSIDE / BORE)
    drawn = curve(*np.array(path).T, ("pressure in the bore", "pressure outside the tube"))
    return Answer(path[-1][1], iterations, drawn, PRESSURE * (1 - through) - loss)


def _root(gmsh: ModuleType) -> None:
    """Half of a blade with its root, which is the upper body, and of the disc around the slot."""
    geo, add = gmsh.model.geo, gmsh.model.addPhysicalGroup

    def polygon(corners: list[tuple[float, float, float]]) -> tuple[int, list[int]]:
        p = [geo.addPoint(x, y, 0, size) for x, y, size in corners]
        edges = [geo.addLine(p[i], p[(i + 1) % len(p)]) for i in range(len(p))]
        return geo.addPlaneSurface([geo.addCurveLoop(edges)]), edges

    fine, coarse = 0.25, 1.5
    blade, around = polygon(
        [
            (0, -9, coarse),
            (9, -9, coarse),
            (10, -8, 1),
            (10, -5, fine),
            (5, 0, fine),
            (5, 12, coarse),
            (0, 12, coarse),
        ]
    )
    disc, slot = polygon(
        [
            (5, 0, fine),
            (11, -6, fine),
            (11, -12, coarse),
            (30, -12, 3),
            (30, 6, 3),
            (6.5, 6, coarse),
        ]
    )
    geo.synchronize()
    add(2, [blade], int(Tag.UPPER))
    add(2, [disc], int(Tag.LOWER))
    for tag, edges in (
        (Tag.UPPER_CONTACT, [around[3]]),
        (Tag.LOWER_CONTACT, [slot[0]]),
        (Tag.UPPER_X0, [around[6]]),
        (Tag.UPPER_TOP, [around[5]]),
        (Tag.LOWER_BOTTOM, [slot[2], slot[3]]),
    ):
        add(1, edges, int(tag))
    gmsh.model.mesh.generate(2)


@cache
def _pulled() -> tuple[fem.Function, list[int], tuple[float, float]]:
    """Pull the blade and let it go, all but a part.

    Returns:
        Displacement, linear solves of the steps, and the normal force of a flank over half of the
        pull, at its largest and at the end.
    """
    data = build_mesh("blade", 2, _root, MPI.COMM_WORLD, POINT_SIZES)
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    pull = fem.Constant(data.mesh, (0.0, 0.0))
    F = story.elasticity(u, 115e3, 0.32) + story.traction(u, tags, Tag.UPPER_TOP, pull)
    bcs = [story.fix(u, tags, 0, 0.0, Tag.UPPER_X0)]
    bcs += [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(2)]
    contact = pair_of(tags, friction=FRICTION)
    problem = make_problem(F, u, [contact], bcs)

    def update(t: float) -> None:
        pull.value[1] = 200 * (2 * t if t < 0.5 else 1 - (1 - LEFT) * (2 * t - 1))

    iterations, ratios = [], []
    for solves in steps(problem, 10, update):
        iterations.append(solves)
        normal = -contact.force @ (math.sin(FLANK), math.cos(FLANK))
        ratios.append(float(normal / (5 * pull.value[1])))
    return u, iterations, (ratios[4], ratios[-1])


def blade(let_go: bool) -> Answer:
    """Normal force of a flank: the root slides out, or is about to slide back."""
    u, iterations, ratios = _pulled()
    sign = -1 if let_go else 1
    exact = 1 / (math.cos(FLANK) + sign * FRICTION * math.sin(FLANK))
    return Answer(ratios[let_go], iterations, deformed(u, scale=100), exact)


_BLADE: dict[str, Any] = {
    "source": "P. H. B. Boddington, K. Chen and C. Ruiz, Comput. Struct. 20, 1985, 731-735",
    "problem": "blade",
}
CASES = [
    Case(
        "tube",
        "Plastic tube expanded by pressure into its plate, and let go",
        "U. A. Abdelsalam and M. A. Dokainish, WIT Trans. Model. Simul. 12, 1995; R. Hill, The "
        "Mathematical Theory of Plasticity, 1950, chapter 5; Lame 1852",
        "pressure that remains, MPa",
        tube,
        note="The difference of two larger pressures; the greatest pressure is within 0.1 %.",
    ),
    Case(
        "blade_pulled",
        "Root of a blade pulled in its slot, friction 0.3",
        quantity="normal force of a flank over half of the pull, 1/(cos + mu sin)",
        run=lambda: blade(False),
        **_BLADE,
    ),
    Case(
        "blade_let_go",
        "Root of a blade, let go after the pull, friction 0.3",
        quantity="normal force of a flank over half of the pull, 1/(cos - mu sin)",
        run=lambda: blade(True),
        **_BLADE,
    ),
]
