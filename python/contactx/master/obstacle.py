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
from contactx.master.master import Master
from contactx.obstacles import Geometry, Obstacle

_AT = core.rigid_layout


class ObstacleMaster(Master):
    """Pairs with a rigid obstacle: slave nodes alone."""

    is_rigid = True

    def __init__(
        self, slaves: npt.NDArray[np.int32], obstacle: Obstacle, search_distance: float | None
    ):
        """Create the pairs, none yet.

        Args:
            slaves: Slave nodes, shape (n,).
            obstacle: The obstacle.
            search_distance: Largest distance of a pair; unlimited if None.
        """
        self._slaves = slaves
        self._obstacle = obstacle
        self.reach = np.inf if search_distance is None else search_distance
        self._paired = np.zeros(len(slaves), dtype=bool)
        self._data = np.zeros((len(slaves), _AT["size"]))
        self._at = np.zeros((len(slaves), 0))

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> tuple[int, bool]:
        """See ``Master``; there are no facets to change between."""
        self._at = x[self._slaves]
        geometry = self._obstacle.evaluate(self._at)
        self._data = _kernel_data(geometry)
        paired = np.abs(geometry.gap) <= self.reach
        changed = not np.array_equal(paired, self._paired)
        self._paired = paired
        return 0, changed

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        return self._paired

    def pairs(self) -> list[Pairs]:
        """See ``Master``."""
        return self._group(self._data)

    def refresh(self, x: npt.NDArray[np.float64], held: bool) -> list[Pairs] | None:
        """See ``Master``; held, the gap is linear in the displacement since the search."""
        now = x[self._slaves]
        if not held:
            return self._group(_kernel_data(self._obstacle.evaluate(now)))
        data = self._data.copy()
        gradient = _columns(data, "gradient", now.shape[1])
        data[:, _AT["gap"]] += np.einsum("ij,ij->i", gradient, now - self._at)
        return self._group(data)

    def _group(self, data: npt.NDArray[np.float64]) -> list[Pairs]:
        slaves = np.flatnonzero(self._paired).astype(np.int32)
        if len(slaves) == 0:
            return []
        return [Pairs(slaves, self._slaves[slaves][:, None], data[slaves])]

    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Master``; none."""
        return np.zeros(len(self._slaves))

    def mobility(self, free: npt.NDArray[np.bool_]) -> npt.NDArray[np.float64]:
        """See ``Master``."""
        normal = _columns(self._data, "normal", free.shape[1])
        norm: npt.NDArray[np.float64] = np.linalg.norm(normal * free[self._slaves], axis=1)
        return norm

    def inside(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Gap of the slave nodes at positions of all nodes, shape (n,)."""
        return self._obstacle.evaluate(x[self._slaves]).gap

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; obstacles have no pairs that might not fit."""
        return {}

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return {"paired": self._paired.copy(), "data": self._data.copy(), "at": self._at.copy()}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        self._paired = saved["paired"].copy()
        self._data = saved["data"].copy()
        self._at = saved["at"].copy()

    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """See ``Master``."""
        return float(np.abs(self._obstacle.evaluate(x[self._slaves]).gap).min())


def _kernel_data(geometry: Geometry) -> npt.NDArray[np.float64]:
    """Gap, gradient, normal and curvature of each node, as the kernels read them."""
    n, gdim = geometry.normal.shape
    data = np.zeros((n, _AT["size"]))
    data[:, _AT["gap"]] = geometry.gap
    _columns(data, "gradient", gdim)[:] = geometry.gradient
    _columns(data, "normal", gdim)[:] = geometry.normal
    _columns(data, "curvature", gdim * gdim)[:] = geometry.curvature.reshape(n, -1)
    return data


def _columns(data: npt.NDArray[np.float64], name: str, width: int) -> npt.NDArray[np.float64]:
    """View of one of the kernels' values."""
    return data[:, _AT[name] : _AT[name] + width]
