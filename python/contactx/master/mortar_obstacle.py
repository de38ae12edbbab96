# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacle as a master of slave facets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

import basix
from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import RowKind
from contactx.master.obstacle import ObstacleMaster
from contactx.obstacles import Obstacle
from contactx.parallel.halo import Halo
from contactx.parallel.slaves import SlaveNodes

type Array = npt.NDArray[np.float64]

# Exact for the product of two shape functions and a gap of constant curvature
_DEGREE = 4
_CELLS = {
    2: basix.CellType.interval,
    3: basix.CellType.triangle,
    4: basix.CellType.quadrilateral,
}


@dataclass(frozen=True)
class _Facets:
    """Slave facets of one kind.

    Attributes:
        nodes: Their nodes, shape (m, k).
        numbers: Their slave nodes by their place among all around, shape (m, k).
        N: Shape functions at the points of the rule, shape (q, k).
        weight: Weights of the dual functions at the points, by reference area, shape (m, k, q).
        corners: Places of its corners in the list of all slave facets, shape (m, k).
    """

    nodes: npt.NDArray[np.int32]
    numbers: npt.NDArray[np.int32]
    N: Array
    weight: Array
    corners: npt.NDArray[np.int64]

    @staticmethod
    def of(
        nodes: npt.NDArray[np.int32],
        numbers: npt.NDArray[np.int32],
        corners: npt.NDArray[np.int64],
        x: Array,
    ) -> _Facets:
        """Prepare the rule and the dual functions.

        Args:
            nodes: Nodes of the facets, shape (m, k).
            numbers: The same by their places among all slave nodes around, shape (m, k).
            corners: Places of their corners in the list of all slave facets, shape (m, k).
            x: Reference positions.
        """
        cell = _CELLS[nodes.shape[1]]
        rule: Any = basix.make_quadrature(cell, _DEGREE)
        points, weights = rule
        values: Any = basix.create_element(basix.ElementFamily.P, cell, 1).tabulate(1, points)
        table: Array = values[..., 0]
        N = table[0]
        tangents = [slope @ x[nodes] for slope in table[1:]]
        if len(tangents) > 1:
            tangents = [np.cross(tangents[0], tangents[1])]
        area: Array = np.linalg.norm(tangents[0], axis=2) * weights
        mass = N.T @ (area[:, :, None] * N)
        dual = (area @ N)[:, :, None] * np.linalg.inv(mass)
        weight = (dual @ N.T) * area[:, None, :]
        return _Facets(nodes, numbers, N, weight, corners)

    def points(self, x: Array) -> Array:
        """Points of the rule, shape (m * q, gdim)."""
        points: Array = self.N @ x[self.nodes]
        return points.reshape(-1, x.shape[1])


class MortarObstacle(ObstacleMaster):
    """Pairs of slave facets with a rigid obstacle.

    The gap and the normal at points of each facet are integrated with the dual functions; the force
    of a slave node acts on itself alone, along its mean normal. Slip, and which nodes are in reach,
    are those of the nodes.
    """

    saved_rows: Mapping[str, RowKind] = {**ObstacleMaster.saved_rows, "positions": "node"}

    def __init__(
        self,
        slave: SlaveNodes,
        obstacle: Obstacle,
        halo: Halo,
        search_distance: float | None,
        *,
        measures_slip: bool,
    ):
        """Create the pairs, none yet.

        Args:
            slave: Slave nodes.
            obstacle: The obstacle.
            halo: Nodes of this rank.
            search_distance: Largest distance of a pair; unlimited if None.
            measures_slip: Whether slip is measured.
        """
        self._halo, x = halo, halo.x
        super().__init__(slave, obstacle, x, search_distance, measures_slip=measures_slip)
        offsets, self._kinds = slave.facets.offsets, []
        for which, nodes in slave.facets.groups():
            corners = offsets[which][:, None] + np.arange(nodes.shape[1])
            self._kinds.append(_Facets.of(nodes, slave.corners[corners], corners, x))
        self._faces = np.ones(len(slave.facets.nodes), dtype=bool)
        self._others = np.zeros(len(slave.around) - len(slave.owned), dtype=bool)
        self._values: list[Array] = []
        self._positions = x

    def search(self, x: Array, closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``."""
        found = super().search(x, closed)
        self._values = [self._integrate(facets, x) for facets in self._kinds]
        self._positions = x
        return found

    def take_front(self, faces: npt.NDArray[np.bool_]) -> None:
        """See ``Master``; the others are not integrated."""
        if not np.array_equal(faces, self._faces):
            self._faces = faces
            self._values = [self._integrate(facets, self._positions) for facets in self._kinds]

    def _integrate(self, facets: _Facets, x: Array) -> Array:
        """What the kernels read of facets, shape (m, size)."""
        m, k, q = facets.weight.shape
        dual = facets.weight * self._faces[facets.corners][:, :, None]
        gdim = x.shape[1]
        at = core.rigid_mortar_layout(k, gdim)
        there = self._obstacle.evaluate(facets.points(x))

        def integral(values: Array, *, by_nodes: bool = False) -> Array:
            """Integral with the dual functions, and with the shape functions where asked for."""
            values = values.reshape(m, q, -1)
            weight = dual
            if by_nodes:
                weight = (weight[:, :, None, :] * facets.N.T).reshape(m, k * k, q)
            total: Array = weight @ values
            return total.reshape(m, -1)

        data = np.empty((m, at["size"]))
        parts = {
            "area": dual.sum(axis=2),
            "gap": integral(there.gap),
            "gradient": integral(there.gradient, by_nodes=True),
            "normal": integral(there.normal),
            "curvature": integral(there.curvature, by_nodes=True),
        }
        for name, part in parts.items():
            data[:, at[name] : at[name] + part.shape[1]] = part
        return data

    def pairs(self) -> list[Pairs]:
        """See ``Master``; by the kind of the slave facets."""
        return self._pairs(self._values)

    def _pairs(self, values: list[Array]) -> list[Pairs]:
        groups = []
        paired = np.concatenate([self._paired, self._others])
        for facets, data in zip(self._kinds, values, strict=True):
            near = (paired[facets.numbers] & self._faces[facets.corners]).any(axis=1)
            if near.any():
                groups.append(Pairs(facets.numbers[near], facets.nodes[near], data[near]))
        return groups

    def update(self, x: Array, frozen_kinematics: bool, offset: Array) -> list[Pairs] | None:
        """See ``Master``; frozen, the gap is linear in the displacement since the search."""
        if not frozen_kinematics:
            return self._pairs([self._integrate(facets, x) for facets in self._kinds])
        values = []
        for facets, searched in zip(self._kinds, self._values, strict=True):
            data = searched.copy()
            k, gdim = facets.nodes.shape[1], x.shape[1]
            at = core.rigid_mortar_layout(k, gdim)
            gradient = data[:, at["gradient"] : at["normal"]].reshape(-1, k, k, gdim)
            moved = (x - self._positions)[facets.nodes]
            data[:, at["gap"] : at["gradient"]] += np.einsum("msti,mti->ms", gradient, moved)
            data[:, at["curvature"] :] = 0
            values.append(data)
        return self._pairs(values)

    @property
    def origin(self) -> Array:
        """See ``Master``; where the obstacle has carried the points that slip is measured from."""
        return self._carried() if self._measures_slip else np.zeros(1)

    def normals(self) -> Array:
        """See ``Master``; those at the nodes."""
        gdim = self._at.shape[1]
        at = core.rigid_layout["normal"]
        normals = np.zeros((len(self._slaves), 3))
        normals[self._paired, :gdim] = self._data[self._paired, at : at + gdim]
        return normals

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return super().save() | {"positions": self._positions}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        super().load(saved)
        self._positions = self._halo.scatter_forward(saved["positions"])
        self._values = [self._integrate(facets, self._positions) for facets in self._kinds]

    def halo_changed(self, scatter_forward: Callable[[Array], Array]) -> None:
        """See ``Master``."""
        self._positions = scatter_forward(self._positions)

    def _update_slip(self, x: Array, data: Array) -> None:
        """The kernels measure it by themselves."""
