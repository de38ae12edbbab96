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


def pin_in_plate(h: float, far: float, *, order: int = 1) -> MeshData:
    """Upper half of a pin of radius 1 and of a round plate with a hole that it just fills.

    The load goes along x. Tags: the pin is the upper body, ``UPPER_Y0`` and ``LOWER_Y0`` are the
    plane of symmetry, ``LOWER_BOTTOM`` is the rim.

    Args:
        h: Size of cells at the hole.
        far: Radius of the plate.
        order: Order of the cells.
    """

    def recipe(gmsh: ModuleType) -> None:
        occ = gmsh.model.occ

        def half(inner: float, outer: float) -> int:
            centre = occ.addPoint(0, 0, 0)
            arcs = []
            ends = []
            for radius in (inner, outer):
                if radius == 0:
                    continue
                p = [
                    occ.addPoint(radius * math.cos(t), radius * math.sin(t), 0)
                    for t in (0, math.pi / 2, math.pi)
                ]
                arcs.append(
                    [occ.addCircleArc(p[0], centre, p[1]), occ.addCircleArc(p[1], centre, p[2])]
                )
                ends.append((p[0], p[2]))
            if inner == 0:
                lines = [occ.addLine(ends[0][1], centre), occ.addLine(centre, ends[0][0])]
                loop = [*arcs[0], *lines]
            else:
                right = occ.addLine(ends[0][0], ends[1][0])
                left = occ.addLine(ends[1][1], ends[0][1])
                loop = [right, *arcs[1], left, *arcs[0]]
            return int(occ.addPlaneSurface([occ.addCurveLoop(loop)]))

        pin, plate = half(0, 1.0), half(1.0, far)
        occ.synchronize()
        names = {
            Tag.UPPER: (Tag.UPPER_CONTACT, Tag.UPPER_Y0),
            Tag.LOWER: (Tag.LOWER_CONTACT, Tag.LOWER_Y0),
        }
        for body, tag in ((pin, Tag.UPPER), (plate, Tag.LOWER)):
            gmsh.model.addPhysicalGroup(2, [body], int(tag))
            contact, axis = names[tag]
            faces: dict[Tag, list[int]] = {}
            for _, edge in gmsh.model.getBoundary([(2, body)], oriented=False):
                _, _, _, x1, y1, _ = gmsh.model.getBoundingBox(1, edge)
                name = contact if max(x1, y1) < 1.001 else Tag.LOWER_BOTTOM
                if y1 < 1e-3:
                    name = axis
                faces.setdefault(name, []).append(edge)
            for name, edges in faces.items():
                gmsh.model.addPhysicalGroup(1, edges, int(name))
        size = gmsh.model.mesh.field.add("MathEval")
        gmsh.model.mesh.field.setString(size, "F", f"{h} + 0.3*Abs(Sqrt(x*x + y*y) - 1)")
        gmsh.model.mesh.field.setAsBackgroundMesh(size)
        gmsh.model.mesh.generate(2)
        if order > 1:
            gmsh.model.mesh.setOrder(order)

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
    contact = cx.Contact(cx.Surface(tags, Tag.UPPER_CONTACT), cx.Surface(tags, Tag.LOWER_CONTACT))
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="persson_")
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


def loaded_pin(h: float = 0.04, *, load: float = 10e3, degree: int = 2) -> Answer:
    """NAFEMS' fourth problem as Code_Aster has it: in plane strain, upper half."""
    radius, length, outer = 50.0, 200.0, 100.0

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
        p = [occ.addPoint(radius * x, radius * y, 0) for x, y in ((1, 0), (0, 1), (-1, 0))]
        middle = occ.addPoint(0, 0, 0)
        around = [occ.addCircleArc(p[0], middle, p[1]), occ.addCircleArc(p[1], middle, p[2])]
        across = [occ.addLine(p[2], middle), occ.addLine(middle, p[0])]
        pin = occ.addPlaneSurface([occ.addCurveLoop([*around, *across])])
        occ.synchronize()
        add = gmsh.model.addPhysicalGroup
        add(2, [pin], int(Tag.UPPER))
        add(2, [sheet], int(Tag.LOWER))
        add(1, around, int(Tag.UPPER_CONTACT))
        add(1, across, int(Tag.UPPER_Y0))
        add(1, loop[5:], int(Tag.LOWER_CONTACT))
        add(1, [loop[0], loop[4]], int(Tag.LOWER_Y0))
        add(1, [loop[3]], int(Tag.LOWER_BOTTOM))
        size = gmsh.model.mesh.field.add("MathEval")
        grown = f"{h * radius} + 0.2*Abs(Sqrt(x*x + y*y) - {radius})"
        gmsh.model.mesh.field.setString(size, "F", grown)
        gmsh.model.mesh.field.setAsBackgroundMesh(size)
        gmsh.model.mesh.generate(2)

    data = build_mesh("loaded_pin", 2, recipe, MPI.COMM_WORLD)
    mesh, tags = data.mesh, data.facet_tags
    u = story.displacement(mesh, degree)
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
    problem = cx.ContactProblem(F, u, contacts=[contact], bcs=bcs, petsc_options_prefix="pin_")
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
    ),
]
