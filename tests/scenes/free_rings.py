# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A whole ring, or tube, in another one: nothing but contact holds the inner one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh

from scenes.grids import create, outside
from scenes.problems import make_problem
from story import displacement, elasticity

RADII = (1.0, 1.5, 2.0)
INNER, OUTER, RIM = 1, 2, 3


def _ring(
    inner: float, outer: float, n: int, layers: int, height: int, turned: float = 0.0
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Nodes and cells; layers from the inside out, then around, then up."""
    angle = 2 * np.pi * (np.arange(n) + turned) / n
    radius = np.linspace(inner, outer, layers + 1)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    x = (radius[:, None, None] * circle).reshape(-1, 2)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(layers), np.arange(n), indexing="ij"))
    after = (j + 1) % n
    cells = np.stack([i * n + j, (i + 1) * n + j, i * n + after, (i + 1) * n + after], axis=1)
    if height == 0:
        return x, cells
    floors = np.repeat(np.linspace(0, 0.2 * height, height + 1), len(x))
    above = np.concatenate([cells + k * len(x) for k in range(height)])
    x = np.column_stack([np.tile(x, (height + 1, 1)), floors])
    return x, np.concatenate([above, above + len(circle) * (layers + 1)], axis=1)


class FreeRings:
    """The inner ring in the outer one, which is fixed at its rim or as free as the inner one.

    Attributes:
        contact: The inner ring is the slave, or the master if it is swapped.
    """

    def __init__(
        self,
        n: int,
        n_outer: int,
        *,
        fixed: bool,
        larger: float = 0.0,
        shift: Sequence[float] = (0.0, 0.0),
        turned: float = 0.0,
        height: int = 0,
        layers: int = 3,
        swapped: bool = False,
        material: Callable[[fem.Function, float, float], ufl.Form] = elasticity,
        **options: Any,
    ):
        """Create them.

        Args:
            larger: By how much the inner ring is larger than the hole.
            shift: By how much the inner ring is off the middle.
            turned: By how many of its facets the inner ring is turned.
            height: Number of cells along the axis; no axis if 0.
        """
        gdim = 2 if height == 0 else 3
        a, b, c = RADII
        x, cells = _ring(a, b + larger, n, layers, height, turned)
        x[:, :2] += shift
        y, others = _ring(b, c, n_outer, layers, height)
        domain = create((x, cells), (y, others))
        self.u = displacement(domain)
        F = material(self.u, 1.0, 0.3)
        tags = self._tags(domain, len(x), n, n_outer, layers)
        bcs = []
        if fixed:
            V = self.u.function_space
            dofs = fem.locate_dofs_topological(V, gdim - 1, tags.find(RIM))
            bcs = [fem.dirichletbc(np.zeros(gdim), dofs, V)]
        surfaces = [cx.Surface(tags, tag) for tag in (INNER, OUTER)]
        slave, master = surfaces[::-1] if swapped else surfaces
        self.contact = cx.Contact(slave, master, **options)
        self.problem = make_problem(F, self.u, [self.contact], bcs)

    @staticmethod
    def _tags(domain: mesh.Mesh, first: int, n: int, m: int, layers: int) -> mesh.MeshTags:
        """Tag the faces by the numbers that their nodes were made with."""
        tdim, facets = domain.topology.dim, outside(domain)
        nodes = mesh.entities_to_geometry(domain, tdim - 1, facets)
        number = domain.geometry.input_global_indices[nodes]
        of_inner = number < first
        layer = np.where(of_inner, number // n % (layers + 1), (number - first) // m % (layers + 1))
        values = np.zeros(len(facets), dtype=np.int32)
        values[(of_inner & (layer == layers)).all(axis=1)] = INNER
        values[(~of_inner & (layer == 0)).all(axis=1)] = OUTER
        values[(~of_inner & (layer == layers)).all(axis=1)] = RIM
        order = np.argsort(facets)
        return mesh.meshtags(domain, tdim - 1, facets[order], values[order])

    @property
    def mean_pressure(self) -> float:
        """Of all slave nodes, by their areas."""
        nodes = self.contact.discrete.nodes
        return float(np.average(nodes.pressure, weights=nodes.area))


def pulled(u: fem.Function, young: float, nu: float) -> ufl.Form:
    """Linear elasticity of rings of which the inner one is pulled along x near its inner rim."""
    x = ufl.SpatialCoordinate(u.function_space.mesh)
    pull = ufl.conditional(ufl.lt(x[0] ** 2 + x[1] ** 2, 1.3**2), 1e-3, 0.0)
    return elasticity(u, young, nu) - pull * ufl.TestFunction(u.function_space)[0] * ufl.dx


def lame_pressure(interference: float, fixed: bool = True) -> float:
    """Pressure between the rings, the outer one fixed at its rim or free: Lame's, plane strain."""
    a, b, c = RADII
    nu = 0.3
    inner = b * (1 + nu) * ((1 - 2 * nu) * b**2 + a**2) / (b**2 - a**2)
    outer = (1 + nu) * (1 - 2 * nu) / (1 + (1 - 2 * nu) * (c / b) ** 2) * (c**2 - b**2) / b
    if not fixed:
        outer = b * (1 + nu) * ((1 - 2 * nu) * b**2 + c**2) / (c**2 - b**2)
    return interference / (inner + outer)
