# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surface of a deformable body as a master."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import Array, Master, RowKind, Weights, touching
from contactx.master.mobility import free_squares, pair_weights
from contactx.parallel.halo import Halo
from contactx.parallel.slaves import SlaveNodes
from contactx.search.surface import MasterSurface, outside
from contactx.surface import FacetList

_SAVED = ("feature", "xi", "cone", "normal")
_AT = core.slip_layout


class FacetMaster(Master):
    """Pairs with the facets of a deformable body.

    Attributes:
        surface: The facets.
        outside: Tells what is outside of their body.
    """

    saved_rows: Mapping[str, RowKind] = {
        **dict.fromkeys(("facet_nodes", *_SAVED, "start"), "slave"),
        "before": "node",
        "at": "node",
    }

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
        self._facets = slave.facets
        self.surface = MasterSurface(halo, master)
        self.outside = outside(halo, master)
        x = halo.x
        self._small = sliding == "small"
        self._measures_slip = measures_slip
        # Positions of all nodes at the step's start and the last search, and where each slave
        # node's slip starts, as a place in the configuration of the step's start
        self._x0 = self._at = x
        self._start = np.zeros((0, x.shape[1]))
        self.reach = reach
        known = self.surface.facets
        self._pairing = core.Pairing(
            slave.facets.offsets,
            slave.facets.nodes,
            known.offsets,
            known.nodes,
            halo.gdim,
            halo.num_owned,
        )
        self._slaves = self._pairing.slaves
        self._facet = self._pairing.facet
        self._feature = self._pairing.feature

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> int:
        """See ``Master``."""
        version = self._halo.version
        changed = self.surface.pair(self._pairing, self._facets, x, self.reach, closed)
        self._at = x = self._halo.updated(x, version)
        changed += self._drop_outside(x, closed)
        self._facet, self._feature = self._pairing.facet, self._pairing.feature
        return changed

    def _drop_outside(self, x: Array, closed: npt.NDArray[np.int8]) -> int:
        """Drop pairs with facets behind all of the master's body; returns the changes."""
        if not self.outside.is_around:
            return 0
        pairing, points = self._pairing, x[self._slaves]
        foot, normal = pairing.places(x, pairing.xi)
        depth = np.einsum("ij,ij->i", normal, foot - points)
        facets = self.surface.facets
        # None for what has no facet
        size = np.append(core.facet_sizes(facets.offsets, facets.nodes, x, x.shape[1]), np.inf)
        outside = self.outside.find(x, points, depth, size[pairing.facet])
        which = np.flatnonzero(outside).astype(np.int32)
        n = len(which)
        none = np.full(n, -1, dtype=np.int32), np.zeros(n, dtype=np.int32)
        return pairing.settle(
            which, *none, np.zeros((n, 2)), np.zeros((n, 3)), x, self.reach, closed
        )

    def rebuild(self) -> None:
        """See ``Master``."""
        if self._halo.comm.size > 1:
            self._restore(self.surface.keep(self._facet), self._saved_pairs())

    def _restore(self, facet: npt.NDArray[np.int32], saved: Mapping[str, npt.NDArray[Any]]) -> None:
        known = self.surface.facets
        self._pairing.set_master(known.offsets, known.nodes)
        self._pairing.restore(facet, **{name: saved[name] for name in _SAVED})
        self._facet, self._feature = self._pairing.facet, self._pairing.feature

    def _saved_pairs(self) -> dict[str, npt.NDArray[Any]]:
        return {name: getattr(self._pairing, name) for name in _SAVED}

    def halo_changed(self, scatter_forward: Callable[[Array], Array]) -> None:
        """See ``Master``."""
        self._x0, self._at = scatter_forward(self._x0), scatter_forward(self._at)

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        paired: npt.NDArray[np.bool_] = self._facet >= 0
        return paired

    def normals(self) -> npt.NDArray[np.float64]:
        """See ``Master``."""
        return np.where(self.paired[:, None], self._pairing.normal.reshape(-1, 3), 0.0)

    def pairs(self) -> list[Pairs]:
        """See ``Master``; grouped by the number of nodes of the facets."""
        found = self._pairing
        data = np.column_stack([found.feature, found.xi, found.cone, found.normal])
        slip = self._slip() if self._measures_slip else None
        facets = self.surface.facets
        sizes = self._facet_sizes()
        groups = []
        for size in np.unique(sizes[self.paired]):
            slaves = np.flatnonzero(self.paired & (sizes == size)).astype(np.int32)
            first = facets.offsets[self._facet[slaves]]
            corners = facets.nodes[first[:, None] + np.arange(size)]
            nodes = np.column_stack([self._slaves[slaves], corners])
            groups.append(
                Pairs(slaves[:, None], nodes, data[slaves], None if slip is None else slip[slaves])
            )
        return groups

    def _facet_sizes(self) -> npt.NDArray[np.int32]:
        """Nodes of each slave node's facet, 0 where there is none, shape (n,)."""
        sizes = np.zeros(len(self._facet), dtype=np.int32)
        sizes[self.paired] = np.diff(self.surface.facets.offsets)[self._facet[self.paired]]
        return sizes

    def _slip(self) -> npt.NDArray[np.float64]:
        """What the kernels read of slip, shape (n, 6)."""
        gdim = self._at.shape[1]
        data = np.zeros((len(self._slaves), _AT["size"]))
        origin = data[:, _AT["origin"] : _AT["origin"] + gdim]
        if self._small:
            xi = self._pairing.xi
            origin[:] = self._start - self._pairing.places(self._x0, xi)[0]
        else:
            xi, gap = self._pairing.feet(self._x0, self._start)
            # It has no part across the normal of a flat facet
            gap[(self._feature == 0) & (self._facet_sizes() < 4)] = 0
            data[:, _AT["gap"]] = gap
            origin[:] = gap[:, None] * self._pairing.places(self._at, xi)[1]
        data[:, _AT["xi"] : _AT["xi"] + 2] = xi
        return data

    def accept(self, x: npt.NDArray[np.float64]) -> None:
        """See ``Master``."""
        self._x0 = x

    def begin_step(self) -> None:
        """See ``Master``."""
        self.reset_flips()
        self._start = self._x0[self._slaves]

    def turn(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64] | None:
        """See ``Master``; the frame of the facet, with one of its edges."""
        if np.array_equal(x, self._x0):
            return None
        old, new = self._frames(self._x0), self._frames(x)
        turn: npt.NDArray[np.float64] = new @ old.transpose(0, 2, 1)
        turn[~self.paired] = np.eye(x.shape[1])
        return turn

    def _frames(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Unit normal and directions along each slave node's facet, in columns."""
        xi = self._pairing.xi
        foot, normal = self._pairing.places(x, xi)
        along = self._pairing.places(x, xi + np.array([1.0, 0.0]))[0] - foot
        along -= np.einsum("ij,ij->i", normal, along)[:, None] * normal
        length = np.linalg.norm(along, axis=1, keepdims=True)
        columns = [normal, np.divide(along, length, out=np.zeros_like(along), where=length > 0)]
        if x.shape[1] == 3:
            columns.append(np.cross(columns[0], columns[1]))
        return np.stack(columns, axis=2)

    def touch(
        self,
        which: npt.NDArray[np.bool_],
        x: npt.NDArray[np.float64],
        offset: npt.NDArray[np.float64],
    ) -> None:
        """See ``Master``; seen from the slave node's facet."""
        pairing, points = self._pairing, x[self._slaves]
        if self._small:
            xi = pairing.xi
            foot0, normal = pairing.places(self._x0, xi)
            before = self._start - foot0
            way = points - pairing.places(x, xi)[0] - before
            gap0, gap1 = (np.einsum("ij,ij->i", normal, w) for w in (before, before + way))
            part = touching(gap0 - offset, gap1 - offset)[:, None]
            start = foot0 + before + part * way
        else:
            xi0, gap0 = pairing.feet(self._x0, self._start)
            xi1, gap1 = pairing.feet(x, points)
            part = touching(gap0 - offset, gap1 - offset)[:, None]
            foot, normal = pairing.places(self._x0, xi0 + part * (xi1 - xi0))
            start = foot + (gap0 + part[:, 0] * (gap1 - gap0))[:, None] * normal
        self._start = np.where(which[:, None], start, self._start)

    def update(
        self, x: npt.NDArray[np.float64], frozen_kinematics: bool, offset: npt.NDArray[np.float64]
    ) -> list[Pairs] | None:
        """See ``Master``; the kernels project by themselves."""
        return None

    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Master``; the mean of the facet's nodes, without one that of all."""
        result = np.full(len(self._slaves), self.surface.mean(nodal))
        for pairs in self.pairs():
            result[pairs.slaves[:, 0]] = nodal[pairs.nodes[:, 1:]].mean(axis=1)
        return result

    def mobility(
        self, free: npt.NDArray[np.bool_]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """See ``Master``."""
        gdim = free.shape[1]
        along, each = np.ones(len(self._slaves)), np.ones((len(self._slaves), gdim))
        if free[self._slaves].all() and free[self.surface.facets.nodes].all():
            return along, each
        at = core.pair_layout
        for pairs in self.pairs():
            slaves = pairs.slaves[:, 0]
            squares = free_squares(pairs, pairs.data[:, at["xi"] : at["xi"] + 2], free)
            along[slaves] = np.sqrt((pairs.normal[:, :gdim] ** 2 * squares).sum(axis=1))
            if pairs.slip is not None:
                xi = pairs.slip[:, _AT["xi"] : _AT["xi"] + 2]
                each[slaves] = np.sqrt(free_squares(pairs, xi, free))
        return along, each

    def weights(self) -> Weights:
        """See ``Master``."""
        at = core.pair_layout["xi"]
        parts = [
            (
                np.repeat(pairs.slaves[:, 0], pairs.nodes.shape[1]),
                pairs.nodes.ravel(),
                pair_weights(pairs, pairs.data[:, at : at + 2]).ravel(),
            )
            for pairs in self.pairs()
        ]
        none = np.zeros(0, dtype=np.int32)
        return Weights(*map(np.concatenate, zip((none, none, np.zeros(0)), *parts, strict=True)))

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return self.surface.identity()

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; without flips, which are reset at the start of every step."""
        saved = {"facet_nodes": self.surface.names(self._facet), **self._saved_pairs()}
        if self._measures_slip:
            saved |= {"start": self._start, "before": self._x0, "at": self._at}
        return saved

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        self._restore(self.surface.named(saved["facet_nodes"]), saved)
        if self._measures_slip:
            self._start = saved["start"]
            self._x0, self._at = (
                self._halo.scatter_forward(saved[name]) for name in ("before", "at")
            )

    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """See ``Master``."""
        return self.surface.distance(x, x[self._slaves])

    @property
    def frozen_pairs(self) -> npt.NDArray[np.int32]:
        """See ``Master``."""
        return self._pairing.frozen()

    def reset_flips(self) -> None:
        """See ``Master``."""
        self._pairing.begin_step()

    def deepest_frozen_pair(self, x: npt.NDArray[np.float64]) -> tuple[float, float]:
        """See ``Master``; what a search without memory finds for them."""
        frozen = self._slaves[self.frozen_pairs]
        if self._halo.comm.allreduce(len(frozen)) == 0:
            return 0.0, 0.0
        offsets, nodes = self._facets.offsets, self._facets.nodes
        normals = core.nodal_normals(offsets, nodes, x, x.shape[1]).reshape(x.shape)[frozen]
        found = self.surface.find(x, x[frozen], normals, self.reach)
        # Less is rounding
        deep = (found.facet >= 0) & (found.gap < -1e-10 * self.reach)
        gap, facets, x = found.gap[deep], self.surface.facets, self._halo.positions()
        first, end = (x[facets.nodes[facets.offsets[found.facet[deep] + k] - k]] for k in (0, 1))
        parts = gap / np.linalg.norm(end - first, axis=1)
        return float(gap.min(initial=0.0)), float(parts.min(initial=0.0))
