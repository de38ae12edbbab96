# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surface of a deformable body as a master of slave facets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import Master, Weights, touching
from contactx.master.reach import default_reach
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]
type Index = npt.NDArray[np.int32]

# How far beyond a slave facet's edges pairs are found in advance, as a part of its size
_MARGIN = 0.1
# Part of a slave node's area that must be covered for it to be paired, and to stay so
_ENTER = 0.06
_LEAVE = 0.04


@dataclass(frozen=True)
class Mortar:
    """Pairs of facets with their integrals.

    Attributes:
        slave: Slave facet of each pair, shape (num_pairs,).
        master: Its master facet, shape (num_pairs,).
        weight: Integrals of the dual functions with the master's shape functions, shape
            (num_pairs, 4, 4).
        gap: Integrals with the gap along the slave facet's normal, shape (num_pairs, 4).
    """

    slave: Index
    master: Index
    weight: Array
    gap: Array

    def scaled(self, factor: Array) -> Mortar:
        """With rows multiplied by factors, shape (num_pairs, 4)."""
        return Mortar(self.slave, self.master, self.weight * factor[:, :, None], self.gap * factor)

    def joined(self, other: Mortar) -> Mortar:
        """With the pairs of another one that have any weight."""
        both = [(self, _used(self)), (other, _used(other))]
        return Mortar(
            *(
                np.concatenate([getattr(part, name)[used] for part, used in both])
                for name in ("slave", "master", "weight", "gap")
            )
        )


class MortarMaster(Master):
    """Pairs of slave facets with the facets of a deformable body, with dual multipliers.

    A slave node's constraint gathers from all pairs of its facets. A node of which little is in
    front of the master is not paired.

    Attributes:
        facets: The master's facets.
    """

    def __init__(
        self,
        slave: FacetList,
        master: FacetList,
        x: Array,
        search_distance: float | None,
        *,
        sliding: str,
        measures_slip: bool,
    ):
        """Create the pairs, none yet.

        Args:
            slave: Slave facets.
            master: Master facets.
            x: Reference positions.
            search_distance: Largest distance of a pair; chosen if None.
            sliding: "finite" or "small".
            measures_slip: Whether slip is measured.
        """
        self.facets = master
        self._reference = self._x0 = self._at = x
        self._gdim = x.shape[1]
        self._small = sliding == "small"
        self._measures_slip = measures_slip
        self.reach = search_distance or default_reach(x, slave, master)
        lists = (slave.offsets, slave.nodes, master.offsets, master.nodes)
        self._search = core.FacetSearch(*lists, self._gdim)
        self._pairing = core.Pairing(*lists, self._gdim)
        self._slaves = self._pairing.slaves
        self._sizes = np.diff(slave.offsets), np.diff(master.offsets)
        self._nodes = _padded(slave), _padded(master)
        self._numbers = np.searchsorted(self._slaves, self._nodes[0]).astype(np.int32)
        n = len(self._slaves)
        area = core.nodal_areas(slave.offsets, slave.nodes, x, self._gdim)
        self._whole: Array = area[self._slaves]
        self._area = np.zeros(n)
        self._paired = np.zeros(n, dtype=bool)
        self._origin = np.zeros((n, self._gdim))
        self._found: Any = None

    def search(self, x: Array, closed: npt.NDArray[np.int8]) -> tuple[int, bool]:
        """See ``Master``; as integrals change continuously no node changes its facet."""
        new = False
        margin = 0.0 if self._small else _MARGIN
        if self._found is None or not self._found.contains(self._search.find(x, self.reach, 0.0)):
            self._found = self._search.find(x, self.reach, margin)
            new = True
        self._integrate(x)
        return 0, new

    def _integrate(self, x: Array) -> None:
        found = self._search.integrals(self._found, x, self._reference)
        if self._small:
            normal = self._between(found, x)
            found = self._search.integrals(self._found, x, self._reference, normal)
        self._at = x
        self._dual, self._normal = found["dual"], found["normal"]
        self._mortar = Mortar(self._found.slave, self._found.master, found["weight"], found["gap"])
        self._area = np.bincount(self._numbers.ravel(), found["area"].ravel(), len(self._slaves))
        least = np.where(self._paired, _LEAVE, _ENTER)
        self._paired = self._area > least * self._whole

    def _between(self, found: Mapping[str, Array], x: Array) -> Array:
        """Normals midway between those of each slave facet and its master, shape (num_facets, 3).

        Small sliding keeps the normals of the reference, and two surfaces that are pressed
        together meet midway.
        """
        corners = x[self._nodes[1][self._found.master]]
        size = self._sizes[1][self._found.master]
        if self._gdim == 2:
            along = corners[:, 1] - corners[:, 0]
            normal = np.stack([along[:, 1], -along[:, 0], np.zeros(len(along))], axis=1)
        else:
            normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            quads = size == 4
            normal[quads] = np.cross(
                (corners[:, 3] - corners[:, 0])[quads], (corners[:, 2] - corners[:, 1])[quads]
            )
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        share = found["weight"].sum(axis=(1, 2))
        mean = found["normal"].copy()
        sums = np.zeros_like(mean)
        np.add.at(sums, self._found.slave, share[:, None] * normal)
        length = np.linalg.norm(sums, axis=1, keepdims=True)
        mean += np.divide(sums, length, out=np.zeros_like(sums), where=length > 0)
        length = np.linalg.norm(mean, axis=1, keepdims=True)
        return np.divide(mean, length, out=mean, where=length > 0)

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        return self._paired

    def area(self, whole: Array) -> Array:
        """See ``Master``; what is in front of the master."""
        return np.where(self._paired, self._area, whole)

    def pairs(self) -> list[Pairs]:
        """See ``Master``; by the kinds of both facets, those that measure slip last."""
        groups = list(self._groups(self._mortar, is_movement=False))
        if self._measures_slip:
            groups += self._groups(self._movement_pairs(), is_movement=True)
        return groups

    def _movement_pairs(self) -> Mortar:
        if self._small:
            mortar = self._mortar
            return Mortar(mortar.slave, mortar.master, mortar.weight, 0 * mortar.gap)
        return self._start.scaled(self._area[self._numbers[self._start.slave]])

    def _groups(self, mortar: Mortar, *, is_movement: bool) -> list[Pairs]:
        kind = 5 * self._sizes[0][mortar.slave] + self._sizes[1][mortar.master]
        groups = []
        for one in np.unique(kind):
            some = np.flatnonzero(kind == one)
            n, m = divmod(int(one), 5)
            e, f = mortar.slave[some], mortar.master[some]
            parts = [
                mortar.weight[some, :n, :m],
                self._dual[e, :n, :n],
                mortar.gap[some, :n],
                self._normal[e],
            ]
            data = np.concatenate([part.reshape(len(some), -1) for part in parts], axis=1)
            nodes = np.concatenate([self._nodes[0][e, :n], self._nodes[1][f, :m]], axis=1)
            groups.append(Pairs(self._numbers[e, :n], nodes, data, is_movement=is_movement))
        return groups

    @property
    def origin(self) -> Array:
        """See ``Master``; where slip is measured from in small sliding."""
        return self._origin

    def refresh(self, x: Array, held: bool, offset: Array) -> list[Pairs] | None:
        """See ``Master``."""
        if held or self._small or np.array_equal(x, self._at):
            return None
        self._integrate(x)
        return self.pairs()

    def normals(self) -> Array:
        """See ``Master``; means over the slave nodes' facets."""
        normals = np.zeros((len(self._slaves), 3))
        weight = self._mortar.weight.sum(axis=2)
        share = weight[:, :, None] * self._normal[self._mortar.slave, None, :]
        numbers = self._numbers[self._mortar.slave].ravel()
        for k in range(self._gdim):
            normals[:, k] = np.bincount(numbers, share[:, :, k].ravel(), len(normals))
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        use = self._paired[:, None] & (length > 0)
        return np.divide(normals, length, out=np.zeros_like(normals), where=use)

    def weights(self) -> Weights:
        """See ``Master``."""
        mortar = self._mortar
        inverse = np.divide(1, self._area, out=np.zeros_like(self._area), where=self._paired)
        numbers = self._numbers[mortar.slave]
        values = mortar.weight * inverse[numbers][:, :, None]
        rows = np.broadcast_to(numbers[:, :, None], values.shape)
        nodes = np.broadcast_to(self._nodes[1][mortar.master][:, None, :], values.shape)
        used = values != 0
        own = np.flatnonzero(self._paired)
        return Weights(
            np.concatenate([own, rows[used]]),
            np.concatenate([self._slaves[own], nodes[used]]),
            np.concatenate([np.ones(len(own)), -values[used]]),
        )

    def _distances(self, x: Array) -> Array:
        """Mean of x_slave - x_master before each slave node, shape (n, gdim)."""
        weights = self.weights()
        distances = np.zeros((len(self._slaves), self._gdim))
        np.add.at(distances, weights.slaves, weights.values[:, None] * x[weights.nodes])
        return distances

    def accept(self, x: Array) -> None:
        """See ``Master``."""
        self._x0 = x

    def begin_step(self) -> None:
        """See ``Master``."""
        if self._measures_slip and self._found is not None:
            self._begin_slip()

    def _begin_slip(self) -> None:
        if self._small:
            self._origin = self._distances(self._x0)
            return
        if not np.array_equal(self._x0, self._at):
            self.search(self._x0, np.zeros(0, dtype=np.int8))
        self._start = self._normalised()
        self._gap0 = self._gaps(self._start)

    def _normalised(self) -> Mortar:
        inverse = np.divide(1, self._area, out=np.zeros_like(self._area), where=self._paired)
        return self._mortar.scaled(inverse[self._numbers[self._mortar.slave]])

    def _gaps(self, mortar: Mortar) -> Array:
        """Sums of the pairs' gaps, shape (n,)."""
        numbers = self._numbers[mortar.slave]
        return np.bincount(numbers.ravel(), mortar.gap.ravel(), len(self._slaves))

    def touch(self, which: npt.NDArray[np.bool_], x: Array, offset: Array) -> None:
        """See ``Master``; the weights on the way are those of its ends, in proportion."""
        if self._small:
            before, after = self._origin, self._distances(x)
            normal = self.normals()[:, : self._gdim]
            gaps = [np.einsum("ij,ij->i", normal, d) - offset for d in (before, after)]
            part = touching(*gaps)[:, None]
            self._origin = np.where(which[:, None], before + part * (after - before), before)
            return
        now = self._normalised()
        part = touching(self._gap0 - offset, self._gaps(now) - offset)
        start = self._start
        known = np.zeros(len(self._slaves), dtype=bool)
        known[self._numbers[start.slave][start.weight.any(axis=2)]] = True
        part = np.where(which, np.where(known, part, 1.0), 0.0)
        self._start = start.scaled((1 - part)[self._numbers[start.slave]]).joined(
            now.scaled(part[self._numbers[now.slave]])
        )

    def turn(self, x: Array) -> Array | None:
        """See ``Master``; the frame of one of the slave node's facets, with an edge of it."""
        if np.array_equal(x, self._x0):
            return None
        old, new = self._frames(self._x0), self._frames(x)
        turn: Array = new @ old.transpose(0, 2, 1)
        return turn

    def _frames(self, x: Array) -> Array:
        facet = np.zeros(len(self._slaves), dtype=np.int64)
        facet[self._numbers] = np.arange(len(self._numbers))[:, None]
        corners = x[self._nodes[0][facet]]
        along = corners[:, 1] - corners[:, 0]
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        if self._gdim == 2:
            normal = np.column_stack([along[:, 1], -along[:, 0]])
            return np.stack([normal, along], axis=2)
        normal = np.cross(along, corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.stack([normal, along, np.cross(normal, along)], axis=2)

    def compliance(self, nodal: Array) -> Array:
        """See ``Master``; the mean of the nodes in front, by the size of their weights."""
        n = len(self._slaves)
        weights = self.weights()
        of_master = weights.values <= 0
        of_master[: int(self._paired.sum())] = False
        slaves = weights.slaves[of_master]
        size = np.abs(weights.values[of_master])
        total = np.bincount(slaves, size, n)
        mean = np.bincount(slaves, size * nodal[weights.nodes[of_master]], n)
        result = np.full(n, np.median(nodal[self.facets.nodes]))
        return np.divide(mean, total, out=result, where=total > 0)

    def mobility(self, free: npt.NDArray[np.bool_]) -> tuple[Array, Array]:
        """See ``Master``."""
        n, gdim = len(self._slaves), free.shape[1]
        if free[self._slaves].all() and free[self.facets.nodes].all():
            return np.ones(n), np.ones((n, gdim))
        weights = self.weights()
        # Parts of several facets with the same node add up
        key = weights.slaves * np.int64(len(free)) + weights.nodes
        key, place = np.unique(key, return_inverse=True)
        slaves, nodes = np.divmod(key, len(free))
        moves = np.bincount(place, weights.values)[:, None] * free[nodes]
        squares = np.stack([np.bincount(slaves, m**2, n) for m in moves.T], axis=1)
        squares[~self._paired] = 1
        normal = self.normals()[:, :gdim]
        return np.sqrt((normal**2 * squares).sum(axis=1)), np.sqrt(squares)

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return {"nodes": self.facets.nodes, "offsets": self.facets.offsets}

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; pairs follow from the positions."""
        return {"paired": self._paired, "before": self._x0, "at": self._at}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        self._paired, self._x0 = saved["paired"], saved["before"]
        self.search(saved["at"], np.zeros(0, dtype=np.int8))
        self.begin_step()

    def distance(self, x: Array) -> float:
        """See ``Master``."""
        return self._pairing.distance(x)


def _used(mortar: Mortar) -> npt.NDArray[np.bool_]:
    used: npt.NDArray[np.bool_] = mortar.weight.any(axis=(1, 2))
    return used


def _padded(facets: FacetList) -> Index:
    """Nodes of each facet, shape (num_facets, 4), the last one repeated."""
    size = np.diff(facets.offsets)
    place = np.minimum(np.arange(4), size[:, None] - 1)
    nodes: Index = facets.nodes[facets.offsets[:-1, None] + place]
    return nodes
