# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Round bodies between plates, of other codes' tests; lengths in mm, stresses in MPa."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from types import ModuleType

from mpi4py import MPI

import hertz_axisymmetric
import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

import story
from meshes.build import build_mesh
from published.drawing import curve, deformed
from published.record import Answer, Case, solve, steps
from scenes.materials import st_venant_kirchhoff
from scenes.problems import make_problem

# Faces of the tower: that of each body upward, that downward, and the supports
_DOWN, _UP, _TOP, _RIM, _AXIS = 10, 20, 31, 32, 33


def _sizes(gmsh: ModuleType, places: Sequence[tuple[float, float]], h: float, grow: float) -> None:
    """Sizes that grow with the distance from where bodies touch."""
    fields = []
    for x, y in places:
        field = gmsh.model.mesh.field.add("MathEval")
        away = f"Sqrt((x - {x})^2 + (y - {y})^2)"
        gmsh.model.mesh.field.setString(field, "F", f"{h} + {grow}*Max({away} - {8 * h}, 0)")
        fields.append(field)
    least = gmsh.model.mesh.field.add("Min")
    gmsh.model.mesh.field.setNumbers(least, "FieldsList", fields)
    gmsh.model.mesh.field.setAsBackgroundMesh(least)


def _tower(h: float) -> MeshData:
    """Sections of a plate, a sphere of radius 5, one of radius 10 and a plate that is held."""

    def recipe(gmsh: ModuleType) -> None:
        occ, add = gmsh.model.occ, gmsh.model.addPhysicalGroup

        def plate(bottom: float, top: float, radius: float) -> tuple[int, list[int]]:
            p = [
                occ.addPoint(x, y, 0)
                for x, y in ((0, bottom), (radius, bottom), (radius, top), (0, top))
            ]
            edges = [occ.addLine(p[i], p[(i + 1) % 4]) for i in range(4)]
            return occ.addPlaneSurface([occ.addCurveLoop(edges)]), edges

        def ball(bottom: float, radius: float) -> tuple[int, list[int]]:
            p = [occ.addPoint(0, bottom + i * radius, 0) for i in range(3)]
            side = occ.addPoint(radius, bottom + radius, 0)
            edges = [
                occ.addCircleArc(p[0], p[1], side),
                occ.addCircleArc(side, p[1], p[2]),
                occ.addLine(p[2], p[0]),
            ]
            return occ.addPlaneSurface([occ.addCurveLoop(edges)]), edges

        lower, lower_edges = plate(0, 4, 20)
        large, large_edges = ball(4, 10)
        small, small_edges = ball(24, 5)
        upper, upper_edges = plate(34, 36, 10)
        occ.synchronize()
        for i, body in enumerate((lower, large, small, upper)):
            add(2, [body], i + 1)
        add(1, [lower_edges[2]], _UP)
        add(1, [lower_edges[1]], _RIM)
        for i, edges in ((1, large_edges), (2, small_edges)):
            add(1, [edges[0]], _DOWN + i)
            add(1, [edges[1]], _UP + i)
        add(1, [upper_edges[0]], _DOWN + 3)
        add(1, [upper_edges[2]], _TOP)
        axis = [lower_edges[3], large_edges[2], small_edges[2], upper_edges[3]]
        add(1, axis, _AXIS)
        _sizes(gmsh, [(0, 4), (0, 24), (0, 34)], h, 0.15)
        gmsh.model.mesh.generate(2)

    return build_mesh("tower", 2, recipe, MPI.COMM_WORLD)


@cache
def _ssna102() -> tuple[fem.Function, list[int], float]:
    """The upper plate goes down by 2; the spheres are free. Its force per radian."""
    data = _tower(0.15)
    tags = data.facet_tags
    u = story.displacement(data.mesh, 2)
    moved = story.fix(u, tags, 1, 0.0, _TOP)
    bcs = [moved, story.fix(u, tags, 0, 0.0, _AXIS, _RIM), story.fix(u, tags, 1, 0.0, _RIM)]
    weight = 2 * ufl.pi * ufl.SpatialCoordinate(data.mesh)[0]
    pairs = ((_DOWN + 1, _UP), (_DOWN + 2, _UP + 1), (_UP + 2, _DOWN + 3))
    contacts = [
        cx.Contact(cx.Surface(tags, slave), cx.Surface(tags, master), weight=weight)
        for slave, master in pairs
    ]
    problem = make_problem(hertz_axisymmetric.elasticity(u, 2e5, 0.3), u, contacts, bcs)

    def update(t: float) -> None:
        moved.g.value[...] = -2.0 * t

    iterations = list(steps(problem, 4, update))
    return u, iterations, float(contacts[0].force[1]) / (2 * np.pi)


def ssna102() -> Answer:
    u, iterations, force = _ssna102()
    return Answer(force, iterations, deformed(u))


def moose() -> Answer:
    """A quarter of a disc of radius 3 on a rigid plane, whose middle plane goes down by 0.002."""

    def recipe(gmsh: ModuleType) -> None:
        occ, add = gmsh.model.occ, gmsh.model.addPhysicalGroup
        p = [occ.addPoint(x, y, 0) for x, y in ((0, 1), (0, 4), (3, 4))]
        edges = [
            occ.addCircleArc(p[0], p[1], p[2]),
            occ.addLine(p[2], p[1]),
            occ.addLine(p[1], p[0]),
        ]
        body = occ.addPlaneSurface([occ.addCurveLoop(edges)])
        occ.synchronize()
        add(2, [body], 1)
        for tag, edge in enumerate(edges, 1):
            add(1, [edge], tag)
        _sizes(gmsh, [(0, 1)], 0.004, 0.15)
        gmsh.model.mesh.generate(2)

    data = build_mesh("moose", 2, recipe, MPI.COMM_WORLD)
    tags = data.facet_tags
    u = story.displacement(data.mesh)
    bcs = [story.fix(u, tags, 0, 0.0, 2, 3), story.fix(u, tags, 1, -0.002, 2)]
    contact = cx.Contact(cx.Surface(tags, 1), cx.Plane((0, 1), (0, 1)))
    problem = make_problem(st_venant_kirchhoff(u, 1e6, 0.3), u, [contact], bcs)
    iterations = solve(problem)
    x = u.function_space.tabulate_dof_coordinates()[contact.slave_nodes, 0]
    p = story.nodal_pressure(contact)
    drawn = curve(x, p, ("x", "pressure"), None, 0.08)
    return Answer(float(p[np.argmin(x)]), iterations, drawn)


CASES = [
    Case(
        "ssna102",
        "Plate, two free spheres and a plate on each other (Code_Aster SSNA102)",
        "Code_Aster, astest/ssna102a.comm: mean of Abaqus, Systus and Samcef",
        "force per radian, N",
        ssna102,
        published=1.7229580e4,
        note="Code_Aster itself gives 17496.6.",
    ),
    Case(
        "moose_hertz",
        "Disc on a rigid plate",
        "MOOSE, modules/contact/test/tests/verification/hertz_cyl/half_symm_q4/gold/"
        "hertz_cyl_half_1deg_frictionless_kin_check_cont_press_0035.csv",
        "pressure in the middle",
        moose,
        published=9190.7185512553,
    ),
]
