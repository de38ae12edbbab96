# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rings that are pressed into one another, and a pin in a hole."""

from __future__ import annotations

import math
from types import ModuleType

from mpi4py import MPI

import numpy as np
import press_fit
from scipy.optimize import brentq

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

import story
from meshes import Tag
from meshes.build import build_mesh
from published.drawing import curve, deformed
from published.record import Answer, Case, solve
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem, pair_of


def _pin(gmsh: ModuleType, radius: float) -> int:
    """Draw and tag the upper half of a pin, and return its surface."""
    occ, add = gmsh.model.occ, gmsh.model.addPhysicalGroup
    middle = occ.addPoint(0, 0, 0)
    p = [occ.addPoint(radius * x, radius * y, 0) for x, y in ((1, 0), (0, 1), (-1, 0))]
    around = [occ.addCircleArc(p[0], middle, p[1]), occ.addCircleArc(p[1], middle, p[2])]
    across = [occ.addLine(p[2], middle), occ.addLine(middle, p[0])]
    pin = occ.addPlaneSurface([occ.addCurveLoop([*around, *across])])
    occ.synchronize()
    add(2, [pin], int(Tag.UPPER))
    add(1, around, int(Tag.UPPER_CONTACT))
    add(1, across, int(Tag.UPPER_Y0))
    return int(pin)


def _mesh(gmsh: ModuleType, radius: float, h: float, grow: float) -> None:
    """Mesh with sizes that grow with the distance from the hole."""
    size = gmsh.model.mesh.field.add("MathEval")
    grown = f"{h} + {grow}*Abs(Sqrt(x*x + y*y) - {radius})"
    gmsh.model.mesh.field.setString(size, "F", grown)
    gmsh.model.mesh.field.setAsBackgroundMesh(size)
    gmsh.model.mesh.generate(2)


def pin_in_plate(h: float, far: float) -> MeshData:
    """Upper half of a pin of radius 1 and of a round plate with a hole that it just fills.

    The load goes along x. The pin is the upper body; ``UPPER_Y0`` and ``LOWER_Y0`` are the plane of
    symmetry, ``LOWER_BOTTOM`` is the rim.
    """

    def recipe(gmsh: ModuleType) -> None:
        occ, add = gmsh.model.occ, gmsh.model.addPhysicalGroup
        centre = occ.addPoint(0, 0, 0)
        hole, rim = (
            [occ.addPoint(r * x, r * y, 0) for x, y in ((1, 0), (0, 1), (-1, 0))]
            for r in (1.0, far)
        )
        loop = [
            occ.addLine(hole[0], rim[0]),
            occ.addCircleArc(rim[0], centre, rim[1]),
            occ.addCircleArc(rim[1], centre, rim[2]),
            occ.addLine(rim[2], hole[2]),
            occ.addCircleArc(hole[2], centre, hole[1]),
            occ.addCircleArc(hole[1], centre, hole[0]),
        ]
        plate = occ.addPlaneSurface([occ.addCurveLoop(loop)])
        occ.synchronize()
        add(2, [plate], int(Tag.LOWER))
        add(1, loop[4:], int(Tag.LOWER_CONTACT))
        add(1, [loop[0], loop[3]], int(Tag.LOWER_Y0))
        add(1, loop[1:3], int(Tag.LOWER_BOTTOM))
        _pin(gmsh, 1.0)
        _mesh(gmsh, 1.0, h, 0.3)

    return build_mesh("pin", 2, recipe, MPI.COMM_WORLD)


def pulled(u: fem.Function, load: float, width: float) -> ufl.Form:
    """Residual of a force along x in the origin, spread over a width."""
    x = ufl.SpatialCoordinate(u.function_space.mesh)
    spread = ufl.exp(-(x[0] ** 2 + x[1] ** 2) / width**2)
    measure = ufl.dx(metadata={"quadrature_degree": 6})
    total = fem.assemble_scalar(fem.form(spread * measure))
    return -load / total * spread * ufl.TestFunction(u.function_space)[0] * measure


def lame() -> Answer:
    problem, contact = press_fit.create(0.05, "finite")
    iterations = solve(problem)
    exact = press_fit.lame()
    pressure = story.nodal_pressure(contact)
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    angle = np.degrees(np.arctan2(x[:, 1], x[:, 0]))
    drawn = curve(
        angle, pressure, ("angle", "pressure / E"), lambda t: np.full_like(t, exact.pressure)
    )
    mean = float(np.average(pressure, weights=contact.area))
    return Answer(mean, iterations, drawn, exact.pressure)


def persson() -> Answer:
    """A pin that just fills its hole: where the contact ends, whatever the load.

    The half-angle e has b = tan(e/2) with log(b^2 + 1) + 2 b^4 = 2 for like materials.
    """
    data = pin_in_plate(0.02, 60.0)
    u = story.displacement(data.mesh)
    tags = data.facet_tags
    E, nu = 1.0, 0.3
    force = 1e-3
    F = story.elasticity(u, E, nu) + pulled(u, force, 0.2)
    bcs = [
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
        story.fix(u, tags, 0, 0.0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 1, 0.0, Tag.LOWER_BOTTOM),
    ]
    contact = pair_of(tags)
    problem = make_problem(F, u, [contact], bcs)
    iterations = solve(problem)
    p = story.nodal_pressure(contact)
    place = u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    angle = np.degrees(np.arctan2(place[:, 1], place[:, 0]))
    order = np.argsort(angle)
    last = np.flatnonzero(p[order] > 0)[-1]
    end = float(angle[order][last : last + 2].mean())
    b = brentq(lambda b: math.log(b * b + 1) + 2 * b**4 - 2, 0.5, 1.5)
    drawn = curve(angle, p / force, ("angle", "pressure R / half of the load"))
    return Answer(end, iterations, drawn, math.degrees(2 * math.atan(b)))


def loaded_pin(h: float = 0.04) -> Answer:
    """NAFEMS' fourth problem as Code_Aster has it: in plane strain, upper half."""
    radius, length, outer, load = 50.0, 200.0, 100.0, 10e3

    def recipe(gmsh: ModuleType) -> None:
        occ = gmsh.model.occ
        centre = occ.addPoint(0, 0, 0)
        hole = [occ.addPoint(radius * x, radius * y, 0) for x, y in ((1, 0), (0, 1), (-1, 0))]
        rim = [occ.addPoint(x, y, 0) for x, y in ((outer, 0), (0, outer), (-length, outer))]
        left = occ.addPoint(-length, 0, 0)
        loop = [
            occ.addLine(hole[0], rim[0]),
            occ.addCircleArc(rim[0], centre, rim[1]),
            occ.addLine(rim[1], rim[2]),
            occ.addLine(rim[2], left),
            occ.addLine(left, hole[2]),
            occ.addCircleArc(hole[2], centre, hole[1]),
            occ.addCircleArc(hole[1], centre, hole[0]),
        ]
        sheet = occ.addPlaneSurface([occ.addCurveLoop(loop)])
        occ.synchronize()
        add = gmsh.model.addPhysicalGroup
        add(2, [sheet], int(Tag.LOWER))
        add(1, loop[5:], int(Tag.LOWER_CONTACT))
        add(1, [loop[0], loop[4]], int(Tag.LOWER_Y0))
        add(1, [loop[3]], int(Tag.LOWER_BOTTOM))
        _pin(gmsh, radius)
        _mesh(gmsh, radius, h * radius, 0.2)

    data = build_mesh("loaded_pin", 2, recipe, MPI.COMM_WORLD)
    mesh, tags = data.mesh, data.facet_tags
    u = story.displacement(mesh, 2)
    young = fem.Function(fem.functionspace(mesh, ("DG", 0)))
    for tag, value in ((Tag.UPPER, 210e3), (Tag.LOWER, 70e3)):
        young.x.array[data.cell_tags.find(tag)] = value
    F = st_venant_kirchhoff(u, young, 0.3) + pulled(u, load, 8.0)
    bcs = [
        story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0, Tag.LOWER_BOTTOM),
        story.fix(u, tags, 0, 0.0, Tag.LOWER_BOTTOM),
    ]
    contact = cx.Contact(
        cx.Surface(tags, Tag.LOWER_CONTACT), cx.Surface(tags, Tag.UPPER_CONTACT), friction=0.1
    )
    problem = make_problem(F, u, [contact], bcs)
    iterations = solve(problem)
    slaves = contact.slave_nodes
    place = u.function_space.tabulate_dof_coordinates()[slaves]
    far = slaves[np.argmin(np.linalg.norm(place - [radius, 0, 0], axis=1))]
    return Answer(float(u.x.array[2 * far]), iterations, deformed(u, scale=20))


CASES = [
    Case(
        "lame",
        "Ring pressed into a ring",
        "Lame 1852; S. P. Timoshenko and J. N. Goodier, Theory of Elasticity, 1970, chapter 4",
        "mean pressure",
        lame,
    ),
    Case(
        "persson",
        "Pin that just fills its hole",
        "Persson 1964; M. Ciavarella and P. Decuzzi, Int. J. Solids Struct. 38, 2001",
        "half-angle of the contact, degrees",
        persson,
    ),
    Case(
        "ssnp156",
        "Loaded pin, NAFEMS R0094 problem 4 in plane strain, friction 0.1",
        "Code_Aster, astest/ssnp156b.com1",
        "displacement of the hole's far end, mm",
        loaded_pin,
        published=0.73617,
        note="Code_Aster loads the half by 10 kN per mm. Its other model, ssnp156a, gives 0.71799 "
        "for the same problem.",
    ),
]
