# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks in contact whose exact solution is known: one that is smooth, and Hertz's half-planes.

Both are linear, on flat faces with small sliding, so that nothing but the discretisation errs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

import ufl
from dolfinx import fem, mesh

import meshes
from meshes import Tag
from scenes import exact
from scenes.blocks import dimension
from scenes.problems import make_problem, pair_of
from scenes.supports import prescribe
from story import displacement

Array = npt.NDArray[np.float64]
# Divisions of the master over those of the slave
COARSER = 2 / 3
# Exact functions are no polynomials
_DEGREE = 6
# Degree of the functions that stand for Hertz's solution
_HIGH = 3


class Case:
    """Two blocks, one above the other, the upper one the slave."""

    def __init__(
        self, cell: str, n: int, length: float, method: str, *, degree: int = 1, tied: bool = False
    ):
        """Mesh the blocks.

        Args:
            n: Number of cells along a unit of length of the slave, a multiple of 3.
        """
        gdim = dimension(mesh.CellType[cell])
        size = (length, *(1.0,) * (gdim - 1))
        fine, coarse = ([round(count * side) for side in size] for count in (n, round(COARSER * n)))
        data = meshes.blocks(mesh.CellType[cell], fine, coarse, size_upper=size, size_lower=size)
        self.domain, self.tags = data.mesh, data.facet_tags
        self.cells = {body: data.cell_tags.find(body) for body in (Tag.UPPER, Tag.LOWER)}
        self.u = displacement(self.domain, degree)
        self._method, self._tied = method, tied
        self._measure = ufl.Measure(
            "dx",
            self.domain,
            subdomain_data=data.cell_tags,
            metadata={"quadrature_degree": _DEGREE},
        )

    def integral(self, density: Callable[[Tag], Any]) -> ufl.Form:
        """Integrate a density that differs between the bodies."""
        return sum(density(body) * self._measure(int(body)) for body in self.cells)

    def internal(self, u: Mapping[Tag, Any]) -> ufl.Form:
        """Residual of the stress of a displacement in each body."""
        v = ufl.TestFunction(self.u.function_space)
        return self.integral(lambda body: ufl.inner(exact.stress(u[body], body), ufl.grad(v)))

    def solve(self, F: ufl.Form, bc: fem.DirichletBC, offset: Any = 0.0) -> None:
        """Solve the problem of a residual without contact."""
        self.contact = pair_of(
            self.tags, sliding="small", method=self._method, tied=self._tied, offset=offset
        )
        self.problem = make_problem(F, self.u, [self.contact], [bc])
        self.problem.solve()

    def errors(
        self, u: Mapping[Tag, Any], pressure: Callable[[Array], Array], density: Any
    ) -> dict[str, float]:
        """Relative errors: displacement in H1 and L2, pressure in L2.

        The pressure is the raw and the recovered one at nodes, weighted by area, and the recovered
        one integrated as a function.

        Args:
            pressure: Exact pressure at points of the interface, shape (n, 3).
        """

        def norm(of: Callable[[Any], Any], w: Mapping[Tag, Any]) -> float:
            square = self.integral(lambda body: ufl.inner(of(w[body]), of(w[body])))
            return float(np.sqrt(fem.assemble_scalar(fem.form(square))))

        off = {body: self.u - u[body] for body in self.cells}
        contact, x = self.contact, self.u.function_space.tabulate_dof_coordinates()
        w, p = contact.area, pressure(x[contact.slave_nodes])
        best = contact.pressure.x.array[contact.slave_nodes]
        raw = contact.multiplier.reshape(len(w), -1)[:, -1]
        face = ufl.Measure(
            "ds",
            self.domain,
            subdomain_data=self.tags,
            metadata={"quadrature_degree": 2 * _DEGREE},
        )(int(Tag.UPPER_CONTACT))

        def size(of: Any) -> float:
            return float(np.sqrt(fem.assemble_scalar(fem.form(of**2 * face))))

        return {
            "H1": norm(ufl.grad, off) / norm(ufl.grad, u),
            "L2": norm(lambda f: f, off) / norm(lambda f: f, u),
            "raw": float(np.sqrt(w @ (raw - p) ** 2 / (w @ p**2))),
            "best": float(np.sqrt(w @ (best - p) ** 2 / (w @ p**2))),
            "field": size(contact.pressure - density) / size(density),
        }


def smooth(
    cell: str, n: int, method: str, *, degree: int = 1, tied: bool = False
) -> dict[str, Any]:
    """Solve with a smooth exact solution; all nodes are in contact, the sides carry tractions.

    Args:
        n: Number of cells along a unit of length of the slave.
    """
    case = Case(cell, n, 1.0, method, degree=degree, tied=tied)
    V = case.u.function_space
    x = ufl.SpatialCoordinate(case.domain)
    u = {body: exact.smooth(x, body, slips=not tied) for body in case.cells}
    values = fem.Function(V)
    for body, cells in case.cells.items():
        values.interpolate(fem.Expression(u[body], V.element.interpolation_points), cells)
    # Loads and tractions of the sides, by Green: work of the exact stress less that of the pressure
    ds = ufl.Measure("ds", case.domain, subdomain_data=case.tags)
    degree = {"quadrature_degree": _DEGREE}
    v = ufl.TestFunction(V)[len(x) - 1]
    p = exact.smooth_pressure(x)
    faces = (ds(int(face), metadata=degree) for face in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT))
    pushed = sum(sign * p * v * face for sign, face in zip((1, -1), faces, strict=True))
    zero = {body: case.u - u[body] for body in case.cells}
    case.solve(
        case.internal(zero) + pushed, prescribe(values, case.tags, Tag.UPPER_TOP, Tag.LOWER_BOTTOM)
    )
    found = case.errors(u, lambda points: exact.smooth_pressure(points.T[: len(x)], np.cos), p)
    return {"h": 1 / n, "dofs": len(case.u.x.array), **found}


def hertz(
    cell: str, n: int, method: str, *, degree: int = 1, middle: float = exact.MIDDLE
) -> dict[str, Any]:
    """Solve Hertz's line contact of half-planes cut to blocks, with their exact displacements.

    Args:
        n: Number of cells along a unit of length of the slave.
    """
    case = Case(cell, n, exact.LENGTH, method, degree=degree)
    V = case.u.function_space
    high = fem.Function(fem.functionspace(case.domain, ("Lagrange", _HIGH, (2,))))
    values = fem.Function(V)
    for body, cells in case.cells.items():
        for function in (high, values):
            function.interpolate(lambda x, body=body: exact.hertz(x, body, middle), cells)
    offset = fem.Function(fem.functionspace(case.domain, ("Lagrange", degree)))
    offset.interpolate(lambda x: -exact.hertz_gap(x[0], middle))
    sides = (Tag.UPPER_X0, Tag.UPPER_X1, Tag.LOWER_X0, Tag.LOWER_X1)
    bc = prescribe(values, case.tags, Tag.UPPER_TOP, Tag.LOWER_BOTTOM, *sides)
    case.solve(case.internal(dict.fromkeys(case.cells, case.u)), bc, offset)
    u = dict.fromkeys(case.cells, high)
    place = fem.Constant(case.domain, middle)
    ratio = (ufl.SpatialCoordinate(case.domain)[0] - place) / exact.HALF_WIDTH
    p = exact.PEAK * ufl.sqrt(ufl.max_value(1 - ratio**2, 0))
    found = case.errors(u, lambda points: exact.hertz_pressure(points[:, 0], middle), p)
    return {"h": 1 / n, "dofs": len(case.u.x.array), **found}
