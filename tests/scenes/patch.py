# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A patch test on a master that is wider than its slave: the rest of its face is loaded, too."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

import basix
import contactx as cx
import ufl
from dolfinx import fem

from meshes import Tag
from patch_scene import Patch

Array = npt.NDArray[np.float64]
# Inverse maps of quadrilaterals are no polynomials
_POINTS, _WEIGHTS = basix.make_quadrature(basix.CellType.triangle, 20)


class WidePatch(Patch):
    """The lower block, the master, is wider, and carries the same pressure beside the upper one.

    The load's nodal forces are those of the whole face less those of what is covered, clipped
    facet by facet; the meshes need not know each other's lines.
    """

    def load(self) -> ufl.Form:
        """Residual of the pressure on the sides and on the rest of the lower block's face."""
        V = self.u.function_space
        ds = ufl.Measure("ds", domain=V.mesh, subdomain_data=self.tags)(int(Tag.LOWER_CONTACT))
        test = ufl.TestFunction(V)
        # The field along the face whose consistent nodal forces are the wanted ones
        mass = fem.assemble_matrix(fem.form(ufl.inner(ufl.TrialFunction(V), test) * ds)).to_dense()
        normal, forces = self.shape.frame[:, -1], np.zeros((len(mass) // self.shape.dim, 1))
        face = cx.Surface(self.tags, Tag.LOWER_CONTACT).facet_nodes(V)
        x = V.tabulate_dof_coordinates()[:, : self.shape.dim] @ self.shape.frame[:, :-1]
        low, high = self.shape.shift, self.shape.shift + 1.0
        for _, nodes in face.groups():
            for facet in nodes:
                forces[facet, 0] += _integrals(x[facet], -np.inf, np.inf)
                forces[facet, 0] -= _integrals(x[facet], low, high)
        rest = fem.Function(V)
        on_face = mass.diagonal() > 0
        wanted = (self.pressure * forces * normal).ravel()
        rest.x.array[on_face] = np.linalg.solve(mass[np.ix_(on_face, on_face)], wanted[on_face])
        return super().load() + ufl.inner(rest, test) * ds


def _integrals(corners: Array, low: float, high: float) -> Array:
    """Integrals of a facet's shape functions over its part in a square or an interval.

    Args:
        corners: Corners of the facet in its plane, as dolfinx orders them, shape (k, dim - 1).
    """
    if len(corners) == 2:
        a, b = corners.ravel()
        ends = np.clip([a, b], low, high)
        right = (ends.mean() - a) / (b - a)
        return np.array([1 - right, right]) * abs(ends[1] - ends[0])
    polygon = corners[[0, 1, 2] if len(corners) == 3 else [0, 1, 3, 2]]
    for axis in (0, 1):
        polygon = _clipped(polygon, polygon[:, axis] - low)
        polygon = _clipped(polygon, high - polygon[:, axis])
    result = np.zeros(len(corners))
    for b, c in pairwise(polygon[1:]):
        sides = np.array([b, c]) - polygon[0]
        values = _shape_functions(polygon[0] + _POINTS @ sides, corners)
        result += abs(np.linalg.det(sides)) * _WEIGHTS @ values
    return result


def _clipped(polygon: Array, inside: Array) -> Array:
    """Part of a convex polygon where a linear function, given at its corners, is not negative."""
    result = []
    for i, corner in enumerate(polygon):
        if inside[i] >= 0:
            result.append(corner)
        after = (i + 1) % len(polygon)
        if min(inside[i], inside[after]) < 0 < max(inside[i], inside[after]):
            share = inside[i] / (inside[i] - inside[after])
            result.append(corner + share * (polygon[after] - corner))
    return np.array(result).reshape(-1, 2)


def _shape_functions(points: Array, corners: Array) -> Array:
    """Shape functions of a triangle or quadrilateral at points of its plane, shape (m, k)."""
    a, b, c = corners[:3]
    twist = corners[3] - b - c + a if len(corners) == 4 else np.zeros(2)
    xi = np.zeros_like(points)
    # Newton's method, exact after one step where there is no twist
    for _ in range(12):
        s, t = xi.T[:, :, None]
        off = a + s * (b - a) + t * (c - a) + s * t * twist - points
        J = np.stack([b - a + t * twist, c - a + s * twist], axis=2)
        xi -= np.linalg.solve(J, off[..., None])[..., 0]
    s, t = xi.T
    if len(corners) == 3:
        return np.stack([1 - s - t, s, t], axis=1)
    return np.stack([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t], axis=1)
