# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surface of a deformable body as a master of slave facets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.geometry.facets import facet_middles
from contactx.master.master import Master, RowKind, Weights
from contactx.master.mobility import constrained_squares
from contactx.master.mortar_pairs import Array, Mortar, Sides, unit
from contactx.master.mortar_slip import MortarSlip
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import anywhere, largest, least
from contactx.parallel.slaves import SlaveNodes
from contactx.search.surface import MasterSurface, outside
from contactx.surface import FacetList

# How far beyond a slave facet's edges pairs are found in advance, as a part of its size
_MARGIN = 0.1
# Part of a slave node's area that must be covered for it to be paired, and to stay so
_ENTER = 0.06
_LEAVE = 0.04


class MortarMaster(Master):
    """Pairs of slave facets with the facets of a deformable body, with dual multipliers.

    A slave node's constraint gathers from all pairs of its facets. A node of which little is in
    front of the master is not paired.

    Facets of which slave nodes belong to other ranks are integrated by all of these.

    Attributes:
        surface: The master's facets.
        outside: Tells what is outside of their body.
    """

    saved_rows: Mapping[str, RowKind] = {"paired": "slave", "before": "node"}

    def __init__(
        self,
        halo: Halo,
        slave: SlaveNodes,
        master: FacetList,
        reach: float,
        *,
        sliding: str,
        measures_slip: bool,
    ):
        """Create the pairs, none yet; all ranks must take part.

        Args:
            halo: Nodes of this rank.
            slave: Slave nodes.
            master: Master facets that this rank has.
            reach: Largest distance of a pair.
            sliding: "finite" or "small".
            measures_slip: Whether slip is measured.
        """
        self._halo = halo
        self._facets = facets = slave.facets
        self.surface = MasterSurface(halo, master)
        self.outside = outside(halo, master)
        self._gdim = halo.gdim
        self._small = sliding == "small"
        self.reach = reach
        self._nodes = np.union1d(facets.nodes, self.surface.own.nodes)
        self._x0 = self._at = x = halo.x
        self._sides = Sides(slave, x)
        self._inradius = least(halo.comm, self._sides.inradius)
        self._meet()
        self._slip = MortarSlip(self._sides, self._gdim, small=self._small)
        self._measures_slip = measures_slip
        area = core.nodal_areas(facets.offsets, facets.nodes, x, self._gdim)
        self._whole: Array = area[self._sides.slaves]
        self._area = np.zeros(len(self._whole))
        self._paired = np.zeros(len(self._whole), dtype=bool)
        self._found: Any = None

    def _meet(self) -> None:
        """Take the master facets that are known now; those before keep their numbers."""
        slave, known = self._facets, self.surface.facets
        lists = (slave.offsets, slave.nodes, known.offsets, known.nodes)
        self._search = core.FacetSearch(*lists, self._gdim)
        self._sides.meet(known)

    def search(self, x: Array, closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``; as integrals change continuously no node changes its facet."""
        self._pair(x)
        return 0

    def _pair(self, x: Array) -> None:
        version = self._halo.version
        if self._found is None or (self._moved(x) and self._lacks(x)):
            x = self._halo.updated(x, version)
            version = self._halo.version
            margin = 0.0 if self._small else _MARGIN
            self._look(x, margin)
            x = self._halo.updated(x, version)
            version = self._halo.version
            self._found = self._without_outside(x, self._search.find(x, self.reach, margin))
            self._searched = x[self._nodes]
        self._integrate(self._halo.updated(x, version))
        enough = np.where(self._paired, _LEAVE, _ENTER)
        self._paired = self._area > enough * self._whole

    def _look(self, x: Array, margin: float) -> None:
        known = self.surface.facets
        self.surface.look(x, self._facets, self.reach, margin)
        if self.surface.facets is not known:
            self._meet()

    def _lacks(self, x: Array) -> bool:
        """Whether any rank finds a pair that it does not have."""
        version = self._halo.version
        self._look(x, 0.0)
        x = self._halo.updated(x, version)
        found = self._without_outside(x, self._search.find(x, self.reach, 0.0))
        return anywhere(self._halo.comm, not self._found.contains(found))

    def _without_outside(self, x: Array, found: core.FacetPairs) -> core.FacetPairs:
        """Pairs but for those with facets behind all of the master's body."""
        if not self.outside.is_around:
            return found
        middles, normals = facet_middles(self._facets, x)
        others, _ = facet_middles(self.surface.facets, x)
        slave = found.slave
        way = middles[slave] - others[found.master]
        depth = np.einsum("ij,ij->i", normals[slave], way)
        lists = (self._facets, self.surface.facets)
        sizes = [core.facet_sizes(f.offsets, f.nodes, x, self._gdim) for f in lists]
        size = np.maximum(sizes[0][slave], sizes[1][found.master])
        outside = self.outside.find(x, middles[slave], depth, size, within_depth=True)
        return found.without(outside.astype(np.int8)) if outside.any() else found

    def _moved(self, x: Array) -> bool:
        """Whether anything has moved so far since the search that pairs may lack."""
        way = largest(self._halo.comm, np.abs(x[self._nodes] - self._searched).max(initial=0.0))
        # Both sides may have moved, and not a number is far
        return not way <= 0.25 * _MARGIN * self._inradius

    def _integrate(self, x: Array) -> None:
        found = self._search.integrals(self._found, x, self._halo.x)
        if self._small:
            pairs = self._found.slave, self._found.master
            normal = self._sides.between(x, *pairs, found["weight"], found["normal"])
            found = self._search.integrals(self._found, x, self._halo.x, normal)
        self._at = x
        self._dual, self._normal = found["dual"], found["normal"]
        self._mortar = Mortar(self._found.slave, self._found.master, found["weight"], found["gap"])
        self._area = self._sides.total(found["area"])

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        return self._paired

    def area(self, whole: Array) -> Array:
        """See ``Master``; what is in front of the master.

        A node that is pushed off within an iteration keeps some until the next search.
        """
        return np.where(self._paired, np.maximum(self._area, 0.1 * _LEAVE * whole), whole)

    def pairs(self) -> list[Pairs]:
        """See ``Master``; by the kinds of both facets, those that measure slip last."""
        groups = self._sides.pairs(self._mortar, self._dual, self._normal)
        if self._measures_slip:
            movement = self._slip.pairs(self._mortar, self.area(self._whole))
            groups += self._sides.pairs(movement, self._dual, self._normal, is_movement=True)
        return groups

    @property
    def origin(self) -> Array:
        """See ``Master``; where slip is measured from in small sliding."""
        return self._slip.origin

    def rebuild(self) -> None:
        """See ``Master``."""
        if self._halo.comm.size == 1 or self._found is None:
            return
        used = np.union1d(self._mortar.master, self._slip.masters)
        numbers = np.zeros(len(self.surface.facets.offsets), dtype=np.int32)
        numbers[used] = self.surface.keep(used)
        self._mortar = replace(self._mortar, master=numbers[self._mortar.master])
        self._slip.rename(numbers)
        self._meet()

    def halo_changed(self, scatter_forward: Callable[[Array], Array]) -> None:
        """See ``Master``."""
        self._x0, self._at = scatter_forward(self._x0), scatter_forward(self._at)

    def update(self, x: Array, frozen_kinematics: bool, offset: Array) -> list[Pairs] | None:
        """See ``Master``."""
        if frozen_kinematics or self._small or np.array_equal(x, self._at):
            return None
        self._integrate(x)
        return self.pairs()

    def normals(self) -> Array:
        """See ``Master``; means over the slave nodes' facets."""
        share = self._mortar.weight.sum(axis=2)
        normal = self._normal[self._mortar.slave]
        sums = [self._sides.total(share * n[:, None], self._mortar.slave) for n in normal.T]
        normals = unit(np.stack(sums, axis=1))
        normals[~self._paired] = 0
        return normals

    def weights(self) -> Weights:
        """See ``Master``."""
        mortar, sides = self._normalised(), self._sides
        values = mortar.weight
        rows = np.broadcast_to(sides.numbers[mortar.slave][:, :, None], values.shape)
        nodes = np.broadcast_to(sides.nodes[1][mortar.master][:, None, :], values.shape)
        # Zero for slave nodes of other ranks, too
        used = values != 0
        own = np.flatnonzero(self._paired)
        return Weights(
            np.concatenate([own, rows[used]]),
            np.concatenate([sides.slaves[own], nodes[used]]),
            np.concatenate([np.ones(len(own)), -values[used]]),
        )

    def _distances(self, x: Array) -> Array:
        """Mean of x_slave - x_master before each slave node, shape (n, gdim)."""
        weights = self.weights()
        distances = np.zeros((len(self._paired), self._gdim))
        np.add.at(distances, weights.slaves, weights.values[:, None] * x[weights.nodes])
        return distances

    def accept(self, x: Array) -> None:
        """See ``Master``."""
        self._x0 = x

    def begin_step(self) -> None:
        """See ``Master``; pairs are then those of the start alone, whatever has been before."""
        if self._found is None:
            return
        if not self._small:
            self._found = None
            self._pair(self._x0)
        if self._measures_slip:
            self._slip.begin_step(self._normalised(), self._distances(self._x0))

    def _normalised(self) -> Mortar:
        """Pairs divided by the slave nodes' areas."""
        inverse = np.where(self._paired, 1 / self.area(self._whole), 0.0)
        return self._mortar.scaled(self._sides.at_corners(inverse, self._mortar.slave))

    def touch(self, which: npt.NDArray[np.bool_], x: Array, offset: Array) -> None:
        """See ``Master``; ``x`` is where the pairs were integrated last."""
        normals = self.normals()[:, : self._gdim]
        self._slip.touch(which, self._normalised(), self._distances(x), normals, offset)

    def turn(self, x: Array) -> Array | None:
        """See ``Master``; the frame of one of the slave node's facets, with an edge of it."""
        if np.array_equal(x, self._x0):
            return None
        turn: Array = self._sides.frames(x) @ self._sides.frames(self._x0).transpose(0, 2, 1)
        return turn

    def compliance(self, nodal: Array) -> Array:
        """See ``Master``; the mean of the nodes in front, by the size of their weights."""
        n = len(self._paired)
        weights = self.weights()
        of_master = weights.values <= 0
        of_master[: int(self._paired.sum())] = False
        slaves = weights.slaves[of_master]
        size = np.abs(weights.values[of_master])
        total = np.bincount(slaves, size, n)
        mean = np.bincount(slaves, size * nodal[weights.nodes[of_master]], n)
        result: Array = np.full(n, self.surface.mean(nodal))
        np.divide(mean, total, out=result, where=total > 0)
        return result

    def mobility(self, free: npt.NDArray[np.bool_]) -> tuple[Array, Array]:
        """See ``Master``; on a plane of symmetry nothing moves across it.

        Only half of what is around its slave nodes is integrated, where the master seems to.
        """
        n, gdim = len(self._paired), free.shape[1]
        own = free[self._sides.slaves]
        if own.all() and free[self.surface.facets.nodes].all():
            return np.ones(n), np.ones((n, gdim))
        squares = constrained_squares(self.weights(), free, self._paired)
        around = np.zeros((len(self._sides.around), gdim), dtype=bool)
        some = free[self._sides.nodes[0]].any(axis=1)
        for corner in self._sides.numbers.T:
            np.logical_or.at(around, corner, some)
        squares[~own & around[:n]] = 0
        normal = self.normals()[:, :gdim]
        return np.sqrt((normal**2 * squares).sum(axis=1)), np.sqrt(squares)

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return self.surface.identity()

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; pairs follow from the positions."""
        return {"paired": self._paired, "before": self._x0}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        self._paired, self._x0 = saved["paired"], self._halo.scatter_forward(saved["before"])
        self.begin_step()

    def distance(self, x: Array) -> float:
        """See ``Master``."""
        return self.surface.distance(x, x[self._sides.slaves])
