# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A bushing of rubber that hardly changes its volume, pushed through a sleeve, in mm and N."""

from __future__ import annotations

from typing import Any

from mpi4py import MPI

import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.problems import make_problem

# Of the bushing, whose ends are tapered; moduli of shear and of volume; oversize against the sleeve
BORE, RADIUS, LENGTH = 10.0, 20.0, 20.0
SHEAR, BULK, OVERSIZE = 1.0, 1000.0, 1.0


def make_mesh(n: int) -> mesh.Mesh:
    """Half a section, n cells over the wall, four triangles each."""
    corners = [[BORE, 0], [RADIUS, LENGTH]]
    cells = mesh.CellType.triangle, mesh.DiagonalType.crossed
    domain = mesh.create_rectangle(MPI.COMM_WORLD, corners, [n, 2 * n], cells[0], diagonal=cells[1])
    r, z = domain.geometry.x[:, 0], domain.geometry.x[:, 1]
    ends = np.maximum(4 - z, 0) ** 2 + np.maximum(z - (LENGTH - 4), 0) ** 2
    r -= 0.12 * ends * (r - BORE) / (RADIUS - BORE)
    return domain


class Bushing:
    """Axisymmetric, Taylor and Hood's elements, bonded to a rigid pin that is pushed down.

    Attributes:
        contact: Of the rubber with the sleeve, which begins 2 below it as a rounded funnel.
    """

    def __init__(self, n: int = 6, **options: Any):
        domain = make_mesh(n)
        domain.topology.create_connectivity(1, 2)
        boundary = mesh.exterior_facet_indices(domain.topology)
        on_pin = mesh.locate_entities_boundary(domain, 1, lambda x: np.isclose(x[0], BORE))
        marks = np.where(np.isin(boundary, on_pin), 1, 2).astype(np.int32)
        tags = mesh.meshtags(domain, 1, boundary, marks)
        cell = domain.basix_cell()
        lagrange = [
            basix.ufl.element("Lagrange", cell, 2, shape=(2,)),
            basix.ufl.element("Lagrange", cell, 1),
        ]
        W = fem.functionspace(domain, basix.ufl.mixed_element(lagrange))
        self._w = fem.Function(W)
        u, p = ufl.split(self._w)
        r = ufl.SpatialCoordinate(domain)[0]
        grad = ufl.grad(u)
        F = ufl.as_tensor(
            [[1 + grad[0, 0], grad[0, 1], 0], [grad[1, 0], 1 + grad[1, 1], 0], [0, 0, 1 + u[0] / r]]
        )
        J = ufl.det(F)
        energy = SHEAR / 2 * (J ** (-2 / 3) * ufl.tr(F.T * F) - 3) + p * (J - 1) - p**2 / (2 * BULK)
        self._weight, dx = 2 * np.pi * r, ufl.dx(domain, degree=4)
        self._dx, self._volume = dx, J
        form = ufl.derivative(energy * self._weight * dx, self._w, ufl.TestFunction(W))
        V, _ = W.sub(0).collapse()
        self._pin = fem.Function(V)
        dofs = fem.locate_dofs_topological((W.sub(0), V), 1, tags.find(1))
        bc = fem.dirichletbc(self._pin, dofs, W.sub(0))

        def gap(x: Any) -> Any:
            z = x[1] + 2
            return RADIUS - OVERSIZE + (z + ufl.sqrt(z * z + 1)) / 4 - x[0]

        self.contact = cx.Contact(
            cx.Surface(tags, 2), cx.LevelSet(gap), weight=2 * np.pi * r, **options
        )
        self.problem = make_problem(form, self._w, [self.contact], [bc], displacement=0)

    def push(self, depth: float) -> None:
        """Set how far the pin is down."""
        self._pin.interpolate(lambda x: np.vstack([0 * x[0], 0 * x[0] - depth]))

    def change_of_volume(self) -> float:
        """Of all of the rubber, over its volume; on one rank."""
        now, before = (
            fem.assemble_scalar(fem.form(value * self._weight * self._dx))
            for value in (self._volume, 1)
        )
        return float(now / before - 1)
