# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacle as a master."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import Master, RowKind, Weights, touching
from contactx.obstacles import Geometry, Obstacle
from contactx.obstacles.obstacle import Placement
from contactx.parallel.slaves import SlaveNodes

_AT = core.rigid_layout
_SLIP = core.rigid_slip_layout

# What is saved of pairs, and of slip
_PAIRS = ("paired", "data", "at")
_SLIPS = ("slip_data", "start", "x0", "gap0")
_PLACED = ("point", "direction", "parameters")


class ObstacleMaster(Master):
    """Pairs with a rigid obstacle: slave nodes alone."""

    is_rigid = True
    saved_rows: Mapping[str, RowKind] = {
        **dict.fromkeys((*_PAIRS, *_SLIPS), "slave"),
        **dict.fromkeys(_PLACED, "global"),
    }

    def __init__(
        self,
        slave: SlaveNodes,
        obstacle: Obstacle,
        x: npt.NDArray[np.float64],
        search_distance: float | None,
        *,
        measures_slip: bool,
    ):
        """Create the pairs, none yet.

        Args:
            slave: Slave nodes.
            obstacle: The obstacle.
            x: Reference positions.
            search_distance: Largest distance of a pair; unlimited if None.
            measures_slip: Whether slip is measured.
        """
        self._measures_slip = measures_slip
        self._slave, slaves = slave, slave.owned
        self._slaves = slaves
        self._obstacle = obstacle
        self.reach = np.inf if search_distance is None else search_distance
        self._paired = np.zeros(len(slaves), dtype=bool)
        self._data = np.zeros((len(slaves), _AT["size"]))
        self._slip_data = np.zeros((len(slaves), _SLIP["size"]))
        self._at = x[slaves]
        self.accept(x)
        self.begin_step()

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``; there are no facets to change between."""
        self._at = x[self._slaves]
        geometry = self._obstacle.evaluate(self._at)
        self._data = _kernel_data(geometry)
        self._update_slip(self._at, self._data)
        # The far side of an obstacle, too, has a closest point for a node
        self._paired = self._slave.facing(x, geometry.normal)
        self._paired &= np.abs(geometry.gap) <= self.reach
        return 0

    @property
    def obstacle(self) -> Obstacle:
        """The obstacle."""
        return self._obstacle

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        return self._paired

    def pairs(self) -> list[Pairs]:
        """See ``Master``."""
        return self._group(self._data)

    def update(
        self, x: npt.NDArray[np.float64], frozen_kinematics: bool, offset: npt.NDArray[np.float64]
    ) -> list[Pairs] | None:
        """See ``Master``; frozen, gap and slip are linear in the displacement since the search."""
        now = x[self._slaves]
        if not frozen_kinematics:
            data = _kernel_data(self._obstacle.evaluate(now))
        else:
            data = self._data.copy()
            gdim = now.shape[1]
            gradient = _columns(data, "gradient", gdim)
            data[:, _AT["gap"]] += np.einsum("ij,ij->i", gradient, now - self._at)
            _columns(data, "curvature", gdim * gdim)[:] = 0
        self._update_slip(now, data)
        return self._group(data)

    def _update_slip(self, x: npt.NDArray[np.float64], data: npt.NDArray[np.float64]) -> None:
        """Compute slip and its derivative with the normals of the kernels' data."""
        if not self._measures_slip:
            return
        n, gdim = x.shape
        normal = _columns(data, "normal", gdim)
        turn = _columns(data, "curvature", gdim * gdim).reshape(n, gdim, gdim)
        across = np.eye(gdim) - normal[:, :, None] * normal[:, None, :]
        way = x - self._carried()
        height = np.einsum("ij,ij->i", normal, way)
        derivative = across - height[:, None, None] * turn
        derivative -= normal[:, :, None] * np.einsum("ij,ijk->ik", way, turn)[:, None, :]
        self._set_slip(np.einsum("ijk,ik->ij", across, way), derivative)

    def _set_slip(self, slip: npt.NDArray[np.float64], derivative: npt.NDArray[np.float64]) -> None:
        n, gdim = slip.shape
        self._slip_data = np.zeros((n, _SLIP["size"]))
        self._slip_data[:, _SLIP["slip"] : _SLIP["slip"] + gdim] = slip
        first = _SLIP["derivative"]
        self._slip_data[:, first : first + gdim * gdim] = derivative.reshape(n, gdim * gdim)

    def _carried(self) -> npt.NDArray[np.float64]:
        """Where the obstacle has carried the points that slip is measured from."""
        return self._placed.carry(self._start, self._obstacle.placement(self._start.shape[1]))

    def accept(self, x: npt.NDArray[np.float64]) -> None:
        """See ``Master``."""
        if not self._measures_slip:
            return
        self._x0 = x[self._slaves]
        self._placed = self._obstacle.placement(x.shape[1])
        self._gap0 = self._obstacle.evaluate(self._x0).gap
        self._parameters = self._obstacle.parameters()

    def moves_untold(self, tolerance: float) -> bool:
        """Whether the obstacle has moved since the step's start and nothing tells how.

        Then slip cannot be measured on this rank.

        Args:
            tolerance: Gap that counts as none.
        """
        if not self._measures_slip or self._obstacle.tells_movement:
            return False
        gap = self._obstacle.evaluate(self._x0).gap
        now = self._obstacle.parameters()
        moved = bool((np.abs(gap - self._gap0) > tolerance).any())
        return moved or (len(now) == len(self._parameters) and (now != self._parameters).any())

    def begin_step(self) -> None:
        """See ``Master``."""
        if self._measures_slip:
            self._start = self._x0

    def turn(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64] | None:
        """See ``Master``; all of it turns as one."""
        turn = self._placed.turn(self._obstacle.placement(x.shape[1]))
        return np.tile(turn, (len(self._slaves), 1, 1))

    def touch(
        self,
        which: npt.NDArray[np.bool_],
        x: npt.NDArray[np.float64],
        offset: npt.NDArray[np.float64],
    ) -> None:
        """See ``Master``; the way is seen from the obstacle as it was at the step's start."""
        now = x[self._slaves]
        gap = self._obstacle.evaluate(now).gap
        part = touching(self._gap0 - offset, gap - offset)[:, None]
        seen = self._obstacle.placement(now.shape[1]).carry(now, self._placed)
        start = self._x0 + part * (seen - self._x0)
        self._start = np.where(which[:, None], start, self._start)

    def _group(self, data: npt.NDArray[np.float64]) -> list[Pairs]:
        slaves = np.flatnonzero(self._paired).astype(np.int32)
        if len(slaves) == 0:
            return []
        slip = self._slip_data[slaves] if self._measures_slip else None
        return [Pairs(slaves[:, None], self._slaves[slaves][:, None], data[slaves], slip)]

    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Master``; none."""
        return np.zeros(len(self._slaves))

    def mobility(
        self, free: npt.NDArray[np.bool_]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """See ``Master``."""
        normal = _columns(self._data, "normal", free.shape[1])
        moves = free[self._slaves].astype(np.float64)
        return np.linalg.norm(normal * moves, axis=1), moves

    def weights(self) -> Weights:
        """See ``Master``; the obstacle does not move."""
        which = np.flatnonzero(self.paired)
        return Weights(which, self._slaves[which], np.ones(len(which)))

    def inside(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Gap of the slave nodes at positions of all nodes, shape (n,)."""
        return self._obstacle.evaluate(x[self._slaves]).gap

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; obstacles have no pairs that might not fit."""
        return {}

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        saved = {name: getattr(self, f"_{name}") for name in self._saved}
        if self._measures_slip:
            saved["point"] = self._placed.point
            if self._placed.direction is not None:
                saved["direction"] = self._placed.direction
            if len(self._parameters) > 0:
                saved["parameters"] = self._parameters
        return saved

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        for name in self._saved:
            setattr(self, f"_{name}", saved[name])
        if self._measures_slip:
            self._placed = Placement(saved["point"], saved.get("direction"))
            self._parameters = saved.get("parameters", np.zeros(0))

    @property
    def _saved(self) -> tuple[str, ...]:
        return _PAIRS + _SLIPS if self._measures_slip else _PAIRS

    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """See ``Master``."""
        gaps = self._obstacle.evaluate(x[self._slaves]).gap
        return float(np.abs(gaps).min(initial=np.inf))


def _kernel_data(geometry: Geometry) -> npt.NDArray[np.float64]:
    """Gap, gradient, normal and curvature of each node, as the kernels read them."""
    n, gdim = geometry.normal.shape
    data = np.zeros((n, _AT["size"]))
    data[:, _AT["gap"]] = geometry.gap
    _columns(data, "gradient", gdim)[:] = geometry.gradient
    _columns(data, "normal", gdim)[:] = geometry.normal
    _columns(data, "curvature", gdim * gdim)[:] = geometry.curvature.reshape(n, gdim * gdim)
    return data


def _columns(data: npt.NDArray[np.float64], name: str, width: int) -> npt.NDArray[np.float64]:
    """View of one of the kernels' values."""
    return data[:, _AT[name] : _AT[name] + width]
