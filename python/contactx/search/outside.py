# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Points that face a surface from behind all of its body.

Behind a thin body that is tagged all around there is a facet that a point faces, from inside of the
body: as if the point had come through all of it.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.geometry.facets import facet_middles
from contactx.parallel import reduce
from contactx.parallel.halo import Halo
from contactx.search.onlooker import Onlooker
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]

# Cosine of the angle between the mean normal of a surface and any other one from which on it goes
# around a body
_AROUND = 0.5

# Depth below a facet, by its size, up to which a point counts as on it: pairs may stay with a facet
# beyond its edges, and a point may stand for all of a facet
_ON_IT = 0.2


class Outside:
    """Tells points that penetrate a body from those outside, where its surface goes around it.

    Attributes:
        is_around: Whether it does; else no point is outside.
        onlooker: Looks at the surface.
    """

    def __init__(self, halo: Halo, own: FacetList):
        """Find out whether the surface goes around its body; all ranks must take part.

        Args:
            halo: Nodes of this rank.
            own: Facets of the surface that this rank has.
        """
        self._halo = halo
        self.onlooker = Onlooker(halo, own)
        _, normals = facet_middles(own, halo.x)
        mean = reduce.total(halo.comm, normals.sum(axis=0))
        length = float(np.linalg.norm(mean))
        cosines = normals @ mean / length if length > 0 else np.zeros(0)
        least = reduce.least(halo.comm, cosines.min(initial=1.0))
        self.is_around = bool(length == 0 or least < _AROUND)

    def find(
        self, x: Array, points: Array, depth: Array, size: Array, *, within_depth: bool = False
    ) -> npt.NDArray[np.bool_]:
        """Find which points are outside; all ranks must take part.

        Args:
            x: Positions of all nodes, shape (num_nodes, gdim).
            points: Points, shape (n, gdim).
            depth: Depth of each below the facet that it faces, negative where it is in front of
                that, shape (n,).
            size: Size of that facet, shape (n,).
            within_depth: Whether only facets nearer than that count: a point that stands for all of
                a facet may be beside the body while the facet is not.

        Returns:
            Which ones, shape (n,).
        """
        result = np.zeros(len(points), dtype=bool)
        which = np.flatnonzero(depth > _ON_IT * size)
        if not self.is_around or not reduce.anywhere(self._halo.comm, len(which) > 0):
            return result
        at = points[which]
        nothing = np.zeros((self.onlooker.num_facets, 0))
        # Of any normal: what is in front of the nearest facet is outside
        seen = self.onlooker.look(x, at, np.zeros_like(at), np.inf, nothing)
        result[which] = (seen.gap > 0) & ~(within_depth & (seen.distance >= depth[which]))
        return result
