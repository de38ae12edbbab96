# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets of a master surface that other ranks have."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel.halo import Halo
from contactx.search.reach import Reach
from contactx.search.records import FacetRecords, around_facets, around_nodes
from contactx.search.surface import Array, Found, Index, MasterSurface, _numbered
from contactx.surface import FacetList

# Difference of distances that only rounding makes, as in the search itself
_EQUAL = 1e-12
# So that rounding hides no facet that is as near as another one
_WIDER = 1 + 1e-9


class DistributedSurface(MasterSurface):
    """Facets of a master surface of which each rank has a part.

    A rank asks others by points, and by slave facets, and gets the facets that matter to them. It
    keeps those until the step's end. Boxes of the ranks' facets say which to ask.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Take this rank's facets and those around them."""
        self._halo = halo
        records = FacetRecords.of(own, halo)
        around = around_facets(halo, records, around_nodes(halo, records))
        around.add_to(halo, for_good=True)
        self._records, self._key = around, around.key
        self.own = around.select(_among(around, records)).here(halo)
        self.around = around.here(halo)
        self._finder = core.Finder(self.around.offsets, self.around.nodes, halo.gdim)
        self._known = FacetRecords.none()
        self.facets = self._known.here(halo)

    def find(self, x: Array, points: Array, normals: Array, reach: float) -> Found:
        """See ``MasterSurface``."""
        best = _Best(len(points), reach)
        every = np.arange(len(points))
        best.take(every, self._answer(x, points, normals, best.bound))
        others = Reach(self._halo, self.own, x)
        ranks, distance = others.from_points(points, normals, best.bound * _WIDER)
        distance[:, ranks == self._halo.comm.rank] = np.inf
        # First the nearest rank, then all that may still have something nearer
        nearest = np.zeros(distance.shape, dtype=bool)
        if len(ranks) > 0:
            nearest[every, distance.argmin(axis=1)] = True
        nearest &= np.isfinite(distance)
        self._ask(x, points, normals, ranks, nearest, best)
        left = distance <= best.bound[:, None] * _WIDER
        left &= np.isfinite(distance) & ~nearest
        self._ask(x, points, normals, ranks, left, best)
        return self._take(best)

    def _ask(
        self,
        x: Array,
        points: Array,
        normals: Array,
        ranks: npt.NDArray[np.int64],
        wanted: npt.NDArray[np.bool_],
        best: _Best,
    ) -> None:
        """Ask ranks for points, shape (num_points, num_ranks) of ``wanted``."""
        exchange = self._halo.exchange
        which = {
            int(ranks[k]): np.flatnonzero(wanted[:, k]) for k in np.flatnonzero(wanted.any(axis=0))
        }
        questions = exchange({r: (points[w], normals[w], best.bound[w]) for r, w in which.items()})
        answers = exchange({r: self._answer(x, *q) for r, q in questions.items()})
        for rank, answer in answers.items():
            best.take(which[rank], answer)

    def _answer(self, x: Array, points: Array, normals: Array, bound: Array) -> dict[str, Any]:
        """What this rank's facets, and those around them, are to points."""
        found = self._finder.find(x, points, normals, bound * _WIDER)
        hit = np.flatnonzero(found["nearest"] >= 0)
        answer = {name: values[hit] for name, values in found.items()}
        selected = answer.pop("facet")
        answer["hit"] = hit
        answer["key"] = self._key[answer.pop("nearest")]
        answer["has"] = selected >= 0
        facets = self._records.select(selected)
        return answer | vars(facets)

    def _take(self, best: _Best) -> Found:
        facet = np.full(len(best.bound), -1, dtype=np.int32)
        has = np.flatnonzero(best.values["has"])
        records = FacetRecords(*(best.values[n][has] for n in ("numbers", "owners", "original")))
        facet[has] = self._learn(records)
        names = ("feature", "gap", "xi", "normal")
        return Found(best.distance, facet, **{name: best.values[name] for name in names})

    def _learn(self, records: FacetRecords) -> Index:
        """Numbers of facets among those that pairs are with; new ones are appended."""
        new = FacetRecords.joined([FacetRecords.none(), records])
        new = new.select(~_among(new, self._known))
        if self._halo.comm.allreduce(len(new)) > 0:
            new.add_to(self._halo)
            parts = [np.concatenate([vars(r)[n] for r in (self._known, new)]) for n in vars(new)]
            self._known = FacetRecords(*parts)
            self.facets = self._known.here(self._halo)
        return _numbered(records.key, self._known.key)

    def pair(
        self,
        pairing: core.Pairing,
        slave: FacetList,
        x: Array,
        reach: float,
        closed: npt.NDArray[np.int8],
    ) -> int:
        """See ``MasterSurface``."""
        left = pairing.seek(x, reach)
        if self._halo.comm.allreduce(len(left)) == 0:
            return 0
        nodes, version = pairing.slaves[left], self._halo.version
        normals = core.nodal_normals(slave.offsets, slave.nodes, x, x.shape[1])
        found = self.find(x, x[nodes], normals.reshape(-1, x.shape[1])[nodes], reach)
        pairing.set_master(self.facets.offsets, self.facets.nodes)
        x = self._halo.updated(x, version)
        values = found.facet, found.feature, found.xi, found.normal
        return pairing.settle(left, *values, x, reach, closed)

    def look(self, x: Array, slave: FacetList, reach: float, margin: float) -> None:
        """See ``MasterSurface``."""
        exchange, gdim = self._halo.exchange, self._halo.gdim
        sizes = np.diff(slave.offsets)
        near = Reach(self._halo, self.own, x).from_facets(x, slave, reach, margin)
        questions = {}
        for rank in np.flatnonzero(near.any(axis=0)).tolist():
            which = near[:, rank]
            questions[rank] = sizes[which], x[slave.nodes[np.repeat(which, sizes)]]
        answers = []
        records = FacetRecords.of(self.own, self._halo)
        for rank, (theirs, corners) in exchange(questions).items():
            offsets = np.concatenate([[0], np.cumsum(theirs)]).astype(np.int32)
            nodes = len(x) + np.arange(len(corners), dtype=np.int32)
            search = core.FacetSearch(offsets, nodes, self.own.offsets, self.own.nodes, gdim)
            found = search.find(np.concatenate([x, corners]), reach, margin, True)
            answers.append((rank, records.select(np.unique(found.master))))
        got = exchange(dict(answers))
        self._learn(FacetRecords.joined([FacetRecords.none(), *got.values()]))

    def keep(self, used: Index) -> Index:
        """See ``MasterSurface``."""
        kept, place = np.unique(used[used >= 0], return_inverse=True)
        self._known = self._known.select(kept)
        self._known.add_to(self._halo)
        self.facets = self._known.here(self._halo)
        new = np.full(len(used), -1, dtype=np.int32)
        new[used >= 0] = place
        return new

    def named(self, names: npt.NDArray[np.int64]) -> Index:
        """See ``MasterSurface``; what is not known here is asked for on all ranks."""
        comm = self._halo.comm
        keys = np.unique(_key(names[(names >= 0).any(axis=1)]), axis=0)
        missing = keys[~_rows_among(keys, self._known.key)]
        wanted = comm.allgather(missing)
        records = FacetRecords.of(self.own, self._halo)
        theirs = {
            rank: records.select(_rows_among(records.key, keys))
            for rank, keys in enumerate(wanted)
            if len(keys) > 0
        }
        got = self._halo.exchange(theirs)
        every = FacetRecords.joined([FacetRecords.none(), *got.values()])
        lost = comm.allreduce(len(missing) - len(every))
        if lost > 0:
            raise ValueError("a pair with a facet that does not exist")
        self._learn(every)
        which = np.full(len(names), -1, dtype=np.int32)
        some = (names >= 0).any(axis=1)
        which[some] = _numbered(_key(names[some]), self._known.key)
        return which


class _Best:
    """The best answers so far, a row a point."""

    def __init__(self, n: int, reach: float):
        self.bound = np.full(n, reach)
        self.distance = np.full(n, np.inf)
        integers = {"numbers": 4, "owners": 4, "original": 4, "key": 3}
        self.values: dict[str, npt.NDArray[Any]] = {
            "has": np.zeros(n, dtype=bool),
            "feature": np.zeros(n, dtype=np.int32),
            "gap": np.zeros(n),
            "xi": np.zeros((n, 2)),
            "normal": np.zeros((n, 3)),
            **{name: np.zeros((n, width), dtype=np.int64) for name, width in integers.items()},
        }

    def take(self, which: npt.NDArray[np.integer], answer: dict[str, Any]) -> None:
        """Take what is nearer, and of facets as near the first one."""
        at = which[answer["hit"]]
        distance, before = answer["distance"], self.distance[at]
        tie = _EQUAL * (distance + answer["size"])
        better = distance < before - tie
        same = np.flatnonzero(~better & (distance <= before + tie))
        for k in same.tolist():
            better[k] = tuple(answer["key"][k]) < tuple(self.values["key"][at[k]])
        at = at[better]
        self.distance[at] = distance[better]
        self.bound[at] = np.minimum(self.bound[at], distance[better])
        for name, values in self.values.items():
            values[at] = answer[name][better]


def _key(names: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Keys of facets by the original numbers of their nodes, -1 for no node, shape (m, 3)."""
    padded = np.where(names < 0, np.iinfo(np.int64).max, names)
    return np.sort(padded, axis=1)[:, :3]


def _among(some: FacetRecords, others: FacetRecords) -> npt.NDArray[np.bool_]:
    """Which facets are among others."""
    return _rows_among(some.key, others.key)


def _rows_among(
    some: npt.NDArray[np.int64], others: npt.NDArray[np.int64]
) -> npt.NDArray[np.bool_]:
    """Which rows are among others; those of each are all different."""
    both = np.concatenate([others, some])
    _, place, count = np.unique(both, axis=0, return_inverse=True, return_counts=True)
    among: npt.NDArray[np.bool_] = count[place.ravel()[len(others) :]] > 1
    return among


def master_surface(halo: Halo, own: FacetList) -> MasterSurface:
    """Facets of a master surface on one rank or several.

    Args:
        halo: Nodes of this rank.
        own: Facets of the surface that this rank has.
    """
    return (MasterSurface if halo.comm.size == 1 else DistributedSurface)(halo, own)
