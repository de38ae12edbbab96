# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes of one surface that pass through another one in a step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.parallel import reduce
from contactx.parallel.halo import Halo
from contactx.surface import FacetList

type Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Passages:
    """Nodes that pass through a surface, on all ranks.

    Attributes:
        count: Their number.
        node: Number, in the mesh as it was made, of the first of them; -1 for none.
        position: Where it is at the end, shape (gdim,); None for none.
    """

    count: int
    node: int
    position: Array | None


NONE = Passages(0, -1, None)


def passages(
    halo: Halo,
    own: FacetList,
    facets: FacetList,
    x0: Array,
    x1: Array,
    candidates: npt.NDArray[np.integer],
    tolerance: Array,
) -> Passages:
    """Find the nodes that pass through a surface; all ranks must take part.

    Nothing is looked at where there is no candidate on any rank, and only boxes where candidates
    and facets do not come near each other.

    Args:
        halo: Nodes of this rank.
        own: Facets of the candidates' surface that this rank has.
        facets: Facets of the other surface that this rank has.
        x0: Positions of all nodes at the step's start, shape (num_nodes, gdim).
        x1: Positions at its end, shape (num_nodes, gdim).
        candidates: Nodes that this rank owns, shape (n,).
        tolerance: Depth that each may be behind the surface and still be on it, larger than zero,
            shape (n,).
    """
    comm = halo.comm
    if not reduce.anywhere(comm, len(candidates) > 0):
        return NONE
    near = _near(halo, facets, x0, x1, candidates, tolerance)
    if not reduce.anywhere(comm, near.any()):
        return NONE
    candidates, tolerance = candidates[near], tolerance[near]
    normals0, normals1 = _normals(halo, own, x0, x1)
    table = np.concatenate(
        [x0[candidates], x1[candidates], normals0[candidates], normals1[candidates]], axis=1
    )
    # In the order of their numbers, which is the same on any number of ranks
    original = reduce.gathered(comm, halo.original[candidates])
    order = np.argsort(original)
    original = original[order]
    tolerance = reduce.gathered(comm, tolerance)[order]
    table = reduce.gathered(comm, table)[order]
    start, end, normal0, normal1 = (np.ascontiguousarray(t) for t in np.split(table, 4, axis=1))
    moved = facets.offsets, facets.nodes, x0, x1, halo.gdim
    moments = reduce.total(comm, core.moments(*moved, start[0], end[0]))
    frame = moments, start[0], end[0]
    here = _here(halo, facets, original)
    crossings = core.crossings(*moved, *frame, start, end, normal0, normal1, tolerance, here)
    passed = np.flatnonzero(core.passed(_joined(halo, crossings), tolerance) >= 0)
    if len(passed) == 0:
        return NONE
    first = int(passed[0])
    return Passages(len(passed), int(original[first]), end[first])


def _near(
    halo: Halo,
    facets: FacetList,
    x0: Array,
    x1: Array,
    candidates: npt.NDArray[np.integer],
    tolerance: Array,
) -> npt.NDArray[np.bool_]:
    """Which candidates come into the box that all facets sweep, shape (n,)."""
    ends = np.concatenate([x0[facets.nodes], x1[facets.nodes]])
    corners = [ends.min(axis=0, initial=np.inf), -ends.max(axis=0, initial=-np.inf)]
    least, most = np.split(reduce.least(halo.comm, np.concatenate(corners)), 2)
    low = np.minimum(x0[candidates], x1[candidates]) - tolerance[:, None]
    high = np.maximum(x0[candidates], x1[candidates]) + tolerance[:, None]
    near: npt.NDArray[np.bool_] = ((low <= -most) & (high >= least)).all(axis=1)
    return near


def _normals(halo: Halo, own: FacetList, x0: Array, x1: Array) -> tuple[Array, Array]:
    """Unit normals at the owned nodes at the start and at the end, each (num_owned, gdim).

    Facets around them that other ranks have count, too.
    """
    g, normals = halo.gdim, []
    for x in (x0, x1):
        vectors = core.nodal_area_vectors(own.offsets, own.nodes, x, g)
        areas = core.nodal_areas(own.offsets, own.nodes, x, g)
        sums = halo.scatter_reverse(np.column_stack([vectors, areas]))
        vectors, areas = np.ascontiguousarray(sums[:, :g]), np.ascontiguousarray(sums[:, g])
        normals.append(core.unit_normals(vectors, areas, g))
    return normals[0], normals[1]


def _here(halo: Halo, facets: FacetList, original: npt.NDArray[np.int64]) -> npt.NDArray[np.int32]:
    """Nodes of the facets by the numbers in the mesh as it was made, -1 for others, shape (n,)."""
    nodes = np.unique(facets.nodes)
    result = np.full(len(original), -1, dtype=np.int32)
    _, there, which = np.intersect1d(original, halo.original[nodes], return_indices=True)
    result[there] = nodes[which]
    return result


def _joined(halo: Halo, crossings: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Crossings that all ranks found."""
    if halo.comm.size == 1:
        return crossings
    # As bytes, because NumPy gives records that it joins another layout
    data = b"".join(halo.comm.allgather(crossings.tobytes()))
    return np.frombuffer(data, dtype=crossings.dtype)
