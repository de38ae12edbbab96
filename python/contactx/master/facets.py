# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Surface of a deformable body as a master."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.forms import Pairs
from contactx.master.master import Master
from contactx.surface import FacetList

_SAVED = ("facet", "feature", "xi", "cone", "normal")


class FacetMaster(Master):
    """Pairs with the facets of a deformable body."""

    def __init__(
        self,
        slave: FacetList,
        master: FacetList,
        x: npt.NDArray[np.float64],
        search_distance: float | None,
    ):
        """Create the pairs, none yet.

        Args:
            slave: Slave facets.
            master: Master facets.
            x: Reference positions.
            search_distance: Largest distance of a pair; chosen if None.
        """
        self._facets = master
        self.reach = search_distance or _default_reach(x, slave, master)
        self._pairing = core.Pairing(
            slave.offsets, slave.nodes, master.offsets, master.nodes, x.shape[1]
        )
        self._slaves = self._pairing.slaves
        self._facet = self._pairing.facet
        self._feature = self._pairing.feature

    def search(self, x: npt.NDArray[np.float64], closed: npt.NDArray[np.int8]) -> tuple[int, bool]:
        """See ``Master``."""
        changed = self._pairing.update(x, self.reach, closed)
        facet, feature = self._pairing.facet, self._pairing.feature
        same = np.array_equal(facet, self._facet) and np.array_equal(feature, self._feature)
        self._facet, self._feature = facet, feature
        return changed, not same

    @property
    def paired(self) -> npt.NDArray[np.bool_]:
        """See ``Master``."""
        paired: npt.NDArray[np.bool_] = self._facet >= 0
        return paired

    def pairs(self) -> list[Pairs]:
        """See ``Master``; grouped by the number of nodes of the facets."""
        found = self._pairing
        data = np.column_stack([found.feature, found.xi, found.cone, found.normal])
        sizes = np.diff(self._facets.offsets)[self._facet]
        groups = []
        for size in np.unique(sizes[self.paired]):
            slaves = np.flatnonzero(self.paired & (sizes == size)).astype(np.int32)
            first = self._facets.offsets[self._facet[slaves]]
            facets = self._facets.nodes[first[:, None] + np.arange(size)]
            nodes = np.column_stack([self._slaves[slaves], facets])
            groups.append(Pairs(slaves, nodes, data[slaves]))
        return groups

    def refresh(self, x: npt.NDArray[np.float64], held: bool) -> list[Pairs] | None:
        """See ``Master``; the kernels project by themselves."""
        return None

    def compliance(self, nodal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Master``; the mean of the facet's nodes."""
        result = np.full(len(self._slaves), np.median(nodal[self._facets.nodes]))
        for pairs in self.pairs():
            result[pairs.slaves] = nodal[pairs.nodes[:, 1:]].mean(axis=1)
        return result

    def mobility(self, free: npt.NDArray[np.bool_]) -> npt.NDArray[np.float64]:
        """See ``Master``."""
        result = np.ones(len(self._slaves))
        if free[self._slaves].all() and free[self._facets.nodes].all():
            return result
        at = core.pair_layout
        for pairs in self.pairs():
            xi = np.ascontiguousarray(pairs.data[:, at["xi"] : at["xi"] + 2])
            N = core.shape_functions(pairs.nodes.shape[1] - 1, xi)
            weight = np.column_stack([np.ones(len(N)), N])
            normal = pairs.data[:, at["normal"] : at["normal"] + free.shape[1]]
            terms = weight[:, :, None] * normal[:, None, :] * free[pairs.nodes]
            result[pairs.slaves] = np.sqrt((terms**2).sum(axis=(1, 2)))
        return result

    def identity(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``."""
        return {"nodes": self._facets.nodes, "offsets": self._facets.offsets}

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """See ``Master``; flips are forgotten, as at the start of every step."""
        return {name: getattr(self._pairing, name) for name in _SAVED}

    def load(self, saved: Mapping[str, npt.NDArray[Any]]) -> None:
        """See ``Master``."""
        self._pairing.restore(**{name: saved[name] for name in _SAVED})
        self._facet = self._pairing.facet
        self._feature = self._pairing.feature

    def distance(self, x: npt.NDArray[np.float64]) -> float:
        """See ``Master``."""
        return self._pairing.distance(x)

    @property
    def frozen(self) -> npt.NDArray[np.int32]:
        """See ``Master``."""
        return self._pairing.frozen()

    def forget_flips(self) -> None:
        """See ``Master``."""
        self._pairing.begin_step()

    def deepest_frozen(self, x: npt.NDArray[np.float64]) -> float:
        """See ``Master``: what a search without memory finds for them."""
        if len(self.frozen) == 0:
            return 0.0
        gaps = self._pairing.natural_gaps(x, self.reach, self.frozen)
        deepest = float(np.nanmin(gaps, initial=0.0))
        # Less is rounding
        return deepest if deepest < -1e-10 * self.reach else 0.0


def _default_reach(x: npt.NDArray[np.float64], slave: FacetList, master: FacetList) -> float:
    """Diameter of the larger surface: twice the largest distance of its nodes from their mean.

    A body that has moved into another within one iteration must still be found.
    """
    radii = []
    for facets in (slave, master):
        nodes = x[np.unique(facets.nodes)]
        radii.append(np.linalg.norm(nodes - nodes.mean(axis=0), axis=1).max())
    return 2 * float(max(radii))
