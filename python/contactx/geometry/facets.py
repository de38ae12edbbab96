# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Shape of the facets of a surface."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.errors import point_text
from contactx.parallel import reduce
from contactx.parallel.halo import Halo, first_node
from contactx.parallel.slaves import SlaveNodes
from contactx.surface import FacetList, Surface

_SMALL = 1e-10
# What is left of the normals of facets that cancel
_FOLDED = 1e-6
# Neighbours of each corner along the local axes of a quadrilateral: its Jacobian there
_AXES = np.array([[[0, 1], [0, 2]], [[0, 1], [1, 3]], [[2, 3], [0, 2]], [[2, 3], [1, 3]]])


def corner_normals(x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Normals t_1 x t_2 of facets, not of unit length, at the corners where they differ.

    Args:
        x: Coordinates of the facets' nodes, shape (num_facets, num_nodes, gdim).

    Returns:
        Normals, shape (num_facets, c, gdim), with c = 4 for quadrilaterals and 1 otherwise.
    """
    if x.shape[1] == 2:
        t = x[:, 1] - x[:, 0]
        return np.stack([t[:, 1], -t[:, 0]], axis=1)[:, None]
    axes = _AXES if x.shape[1] == 4 else _AXES[:1]
    t = x[:, axes[:, :, 1]] - x[:, axes[:, :, 0]]
    normals: npt.NDArray[np.float64] = np.cross(t[:, :, 0], t[:, :, 1])
    return normals


def check_folds(surface: Surface, slaves: SlaveNodes, halo: Halo) -> None:
    """Check that a slave surface is not folded onto itself, so that its nodes have a normal.

    Args:
        surface: Slave surface.
        slaves: Its nodes.
        halo: Nodes on this rank.

    Raises:
        ValueError: If the normals of the facets at a node of any rank cancel, on all ranks.
    """
    comm, x = halo.comm, halo.x
    sums, sizes = np.zeros_like(x), np.zeros(len(x))
    for _, nodes in slaves.facets.groups():
        normals = corner_normals(x[nodes]).mean(axis=1)
        for corner in nodes.T:
            np.add.at(sums, corner, normals)
            np.add.at(sizes, corner, np.linalg.norm(normals, axis=1))
    owned = slaves.owned
    bad = owned[np.linalg.norm(sums[owned], axis=1) <= _FOLDED * sizes[owned]]
    count = reduce.total(comm, len(bad))
    if count > 0:
        size = float(reduce.extent(comm, x[owned]).max())
        number, at = first_node(halo, bad, x)
        raise ValueError(
            f"the slave surface {surface} is folded at {count} nodes, where the normals of its "
            f"facets cancel, first at {point_text(at, size)}, node {number} of the mesh as it was "
            "made: take the facets of one side out of the surface"
        )


def check_facets(surface: Surface, role: str, facets: FacetList, halo: Halo) -> None:
    """Check that the facets have an area and are not turned inside out at a corner.

    Args:
        surface: Surface.
        role: "slave" or "master".
        facets: Its facets on this rank.
        halo: Nodes on this rank.

    Raises:
        ValueError: If a facet of any rank is degenerate, on all ranks.
    """
    comm, x = halo.comm, halo.x
    length = float(np.linalg.norm(reduce.extent(comm, x[facets.nodes])))
    smallest = _SMALL * length
    bad = []
    for _, nodes in facets.groups():
        corners = x[nodes]
        size = np.linalg.norm(np.ptp(corners, axis=1), axis=1)
        normals = corner_normals(corners)
        mean = normals.mean(axis=1)
        # Compared with size^(gdim - 1), what the normal of a well-shaped facet has
        wanted = _SMALL * size ** (x.shape[1] - 1) * np.linalg.norm(mean, axis=1)
        turned = (np.einsum("fci,fi->fc", normals, mean) <= wanted[:, None]).any(axis=1)
        bad.extend(nodes[turned | (size <= smallest)])
    count = reduce.total(comm, len(bad))
    if count > 0:
        ordered = [nodes[np.argsort(halo.original[nodes])] for nodes in bad]
        names = [halo.original[nodes].tolist() for nodes in ordered]
        middles = [x[nodes].mean(axis=0) for nodes in ordered]
        named, at = reduce.first(comm, names, list(zip(names, middles, strict=True)))
        raise ValueError(
            f"{count} facets of the {role} surface {surface} are degenerate: they have no area, or "
            "are folded so that their Jacobian changes sign. The first is at "
            f"{point_text(at, length)} and has the nodes {', '.join(map(str, named))} of the mesh "
            "as it was made: repair the mesh there"
        )
