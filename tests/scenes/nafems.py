# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two contact benchmarks of NAFEMS, by quadratic displacements.

Source: A. W. A. Konter, Advanced Finite Element Contact Benchmarks, NAFEMS R0094, 2006, problems 1
and 2. Lengths in mm, forces in N. Steel presses on aluminium: a roller, in plane strain, and a
punch with a rounded edge, as a quarter in space or by its section. The values are those of finite
displacements: strains under the roller reach several per cent, where Saint Venant and Kirchhoff's
material, which is meant, gives 2.6 % more than small strains or a neo-Hookean material.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

import story
from meshes import Tag
from meshes.build import build_mesh
from scenes.problems import make_problem

STEEL, ALUMINIUM, NU = 210e3, 70e3, 0.3
# Vertical displacement of the foundation at the middle of the contact, by friction
PUNCH = {0.0: -0.13294, 0.1: -0.13079}
# The same under the roller
ROLLER = -1.3069
_PRESSURE, _LINE_FORCE = 100.0, 35e3
_RADIUS, _FILLET = 50.0, 10.0


class Benchmark:
    """Steel on aluminium.

    Attributes:
        contact: The contact, whose slave is the softer foundation.
    """

    def __init__(
        self,
        data: MeshData,
        load: Callable[[ufl.core.expr.Expr, ufl.Measure], ufl.Form],
        *,
        axisymmetric: bool = False,
        degree: int = 2,
        **options: Any,
    ):
        """Set up.

        Args:
            load: Virtual work of the load on the upper body, by the test function and the measure
                of faces.
        """
        mesh, tags = data.mesh, data.facet_tags
        self.u = u = story.displacement(mesh, degree)
        young = fem.Function(fem.functionspace(mesh, ("DG", 0)))
        for tag, value in ((Tag.UPPER, STEEL), (Tag.LOWER, ALUMINIUM)):
            young.x.array[data.cell_tags.find(tag)] = value
        x = ufl.SpatialCoordinate(mesh)
        ds = ufl.Measure("ds", domain=mesh, subdomain_data=tags)
        weight = 2 * ufl.pi * x[0] if axisymmetric else 1.0
        grad = ufl.grad(u)
        if axisymmetric:
            grad = ufl.as_tensor(
                [[grad[0, 0], grad[0, 1], 0], [grad[1, 0], grad[1, 1], 0], [0, 0, u[0] / x[0]]]
            )
        one = ufl.Identity(grad.ufl_shape[0])
        strain = ((one + grad).T * (one + grad) - one) / 2
        mu, lmbda = young / (2 * (1 + NU)), young * NU / ((1 + NU) * (1 - 2 * NU))
        density = mu * ufl.inner(strain, strain) + lmbda / 2 * ufl.tr(strain) ** 2
        F = ufl.derivative(weight * density * ufl.dx, u)
        F -= load(weight * ufl.TestFunction(u.function_space), ds)
        gdim = mesh.geometry.dim
        bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim)]
        bcs.append(story.fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0))
        if gdim == 3:
            bcs.append(story.fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0))
        self.contact = cx.Contact(
            slave=cx.Surface(tags, Tag.LOWER_CONTACT),
            master=cx.Surface(tags, Tag.UPPER_CONTACT),
            weight=weight,
            **options,
        )
        self.problem = make_problem(F, u, [self.contact], bcs)

    def depth(self) -> float:
        """Vertical displacement of the foundation at the middle of the contact."""
        x = self.u.function_space.tabulate_dof_coordinates()
        slaves = self.contact.slave_nodes
        middle = slaves[np.argmin(np.linalg.norm(x[slaves], axis=1))]
        assert np.abs(x[middle]).max() < 1e-9
        gdim = self.u.function_space.mesh.geometry.dim
        return float(self.u.x.array.reshape(-1, gdim)[middle, -1])


def punch(h: float, *, dim: int = 3, order: int = 1, degree: int = 2, **options: Any) -> Benchmark:
    """The punch, with cells of size h at the edge of the contact."""

    def recipe(gmsh: ModuleType) -> None:
        occ = gmsh.model.occ
        inner = _RADIUS - _FILLET
        corners = ((0, 0), (inner, 0), (_RADIUS, _FILLET), (_RADIUS, 100), (0, 100))
        p = [occ.addPoint(x, 0 if dim == 3 else y, y if dim == 3 else 0) for x, y in corners]
        centre = occ.addPoint(inner, 0 if dim == 3 else _FILLET, _FILLET if dim == 3 else 0)
        edges = [occ.addLine(p[0], p[1]), occ.addCircleArc(p[1], centre, p[2])]
        edges += [occ.addLine(p[k], p[(k + 1) % 5]) for k in (2, 3, 4)]
        upper = occ.addPlaneSurface([occ.addCurveLoop(edges)])
        q = [
            occ.addPoint(x, 0 if dim == 3 else y, y if dim == 3 else 0)
            for x, y in ((0, 0), (100, 0), (100, -200), (0, -200))
        ]
        sides = [occ.addLine(q[k], q[(k + 1) % 4]) for k in range(4)]
        lower = occ.addPlaneSurface([occ.addCurveLoop(sides)])
        bodies = [(2, upper), (2, lower)]
        if dim == 3:
            turned = [occ.revolve([body], 0, 0, 0, 0, 0, 1, np.pi / 2) for body in bodies]
            bodies = [next(t for t in found if t[0] == 3) for found in turned]
        occ.synchronize()
        _tag(gmsh, bodies, dim)
        size = _graded(gmsh, dim, h, inner)
        gmsh.model.mesh.field.setAsBackgroundMesh(size)
        gmsh.model.mesh.generate(dim)
        if order > 1:
            gmsh.model.mesh.setOrder(order)

    data = build_mesh("punch", dim, recipe, MPI.COMM_WORLD, _OPTIONS)

    def load(v: ufl.core.expr.Expr, ds: ufl.Measure) -> ufl.Form:
        return -_PRESSURE * v[dim - 1] * ds(int(Tag.UPPER_TOP))

    return Benchmark(data, load, axisymmetric=dim == 2, degree=degree, **options)


def roller(h: float, *, order: int = 1, degree: int = 2, **options: Any) -> Benchmark:
    """Half of the roller, with cells of size h in the contact; its weight is the load."""

    def recipe(gmsh: ModuleType) -> None:
        occ = gmsh.model.occ
        p = [occ.addPoint(0, y, 0) for y in (0, _RADIUS, 2 * _RADIUS)]
        side = occ.addPoint(_RADIUS, _RADIUS, 0)
        edges = [
            occ.addCircleArc(p[0], p[1], side),
            occ.addCircleArc(side, p[1], p[2]),
            occ.addLine(p[2], p[0]),
        ]
        upper = occ.addPlaneSurface([occ.addCurveLoop(edges)])
        q = [occ.addPoint(x, y, 0) for x, y in ((0, 0), (100, 0), (100, -200), (0, -200))]
        sides = [occ.addLine(q[k], q[(k + 1) % 4]) for k in range(4)]
        lower = occ.addPlaneSurface([occ.addCurveLoop(sides)])
        occ.synchronize()
        _tag(gmsh, [(2, upper), (2, lower)], 2)
        size = gmsh.model.mesh.field.add("MathEval")
        gmsh.model.mesh.field.setString(size, "F", f"{h} + 0.15 * (Max(Sqrt(x*x + y*y) - 8, 0))")
        gmsh.model.mesh.field.setAsBackgroundMesh(size)
        gmsh.model.mesh.generate(2)
        if order > 1:
            gmsh.model.mesh.setOrder(order)

    data = build_mesh("roller", 2, recipe, MPI.COMM_WORLD, _OPTIONS)
    area = np.pi * _RADIUS**2 / 2
    dx = ufl.Measure("dx", domain=data.mesh, subdomain_data=data.cell_tags)

    def load(v: ufl.core.expr.Expr, ds: ufl.Measure) -> ufl.Form:
        return -_LINE_FORCE / 2 / area * v[1] * dx(int(Tag.UPPER))

    return Benchmark(data, load, degree=degree, **options)


_OPTIONS = {
    "Mesh.MeshSizeExtendFromBoundary": 0,
    "Mesh.MeshSizeFromPoints": 0,
    "Mesh.MeshSizeFromCurvature": 0,
}


def _graded(gmsh: ModuleType, dim: int, h: float, edge: float) -> int:
    """Sizes that grow with the distance from the edge of the contact."""
    r = "Sqrt(x*x + y*y)" if dim == 3 else "x"
    depth = "z" if dim == 3 else "y"
    size = gmsh.model.mesh.field.add("MathEval")
    away = f"Sqrt(({r} - {edge + 2})^2 + {depth}^2)"
    gmsh.model.mesh.field.setString(size, "F", f"{h} + 0.35 * Max({away} - {2 * h}, 0)")
    return int(size)


def _tag(gmsh: ModuleType, bodies: Sequence[tuple[int, int]], dim: int) -> None:
    """Tag the bodies and their faces by where these are."""
    names = {
        (Tag.UPPER, "x"): Tag.UPPER_X0, (Tag.UPPER, "y"): Tag.UPPER_Y0,
        (Tag.LOWER, "x"): Tag.LOWER_X0, (Tag.LOWER, "y"): Tag.LOWER_Y0,
    }  # fmt: skip
    for body, tag in zip(bodies, (Tag.UPPER, Tag.LOWER), strict=True):
        gmsh.model.addPhysicalGroup(dim, [body[1]], int(tag))
        faces: dict[int, list[int]] = {}
        for _, face in gmsh.model.getBoundary([body], oriented=False):
            low, high = np.split(np.array(gmsh.model.getBoundingBox(dim - 1, face)), 2)
            bottom, top = low[dim - 1], high[dim - 1]
            name = None
            if high[0] < 1e-3:
                name = names[tag, "x"]
            elif dim == 3 and high[1] < 1e-3:
                name = names[tag, "y"]
            elif tag == Tag.UPPER and bottom < 1e-3:
                name = Tag.UPPER_CONTACT
            elif tag == Tag.UPPER and bottom > 100 - 1e-3:
                name = Tag.UPPER_TOP
            elif tag == Tag.LOWER and bottom > -1e-3:
                name = Tag.LOWER_CONTACT
            elif tag == Tag.LOWER and top < -200 + 1e-3:
                name = Tag.LOWER_BOTTOM
            if name is not None:
                faces.setdefault(int(name), []).append(face)
        for name, found in faces.items():
            gmsh.model.addPhysicalGroup(dim - 1, found, name)
