# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a body lies wholly inside another one or an obstacle, where nothing can push it out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.bodies.bodies import Bodies
from contactx.geometry.hull import in_hulls
from contactx.obstacles import Obstacle
from contactx.parallel import reduce
from contactx.parallel.agreement import agreed
from contactx.parallel.halo import Halo
from contactx.surface import FacetList, Surface
from dolfinx import geometry

# Relative to the size of a cell, or of a body
_SMALL = 1e-8
_PER_LOOK = 256


def check_apart(
    slave: Surface,
    master: Surface,
    slave_facets: FacetList,
    master_facets: FacetList,
    bodies: Bodies,
) -> None:
    """Check that the surfaces share no nodes and neither body lies wholly inside the other.

    Bodies may overlap in part, by however much.

    Args:
        slave: Slave surface.
        master: Master surface.
        slave_facets: Its facets on this rank.
        master_facets: The master's facets on this rank.
        bodies: Bodies of the mesh.

    Raises:
        ValueError: If they do, or one does, on all ranks.
    """
    shared = _num_shared(slave_facets, master_facets, bodies.halo)
    if shared > 0:
        raise ValueError(
            f"slave and master overlap: {slave} and {master} share {shared} nodes. "
            "Give each body its own nodes and each surface its own facets"
        )
    ours = bodies.carrying(slave_facets.nodes)
    theirs = bodies.carrying(master_facets.nodes)
    for inner, outer, names in (
        (ours, theirs, (f"slave surface {slave}", f"master surface {master}")),
        (theirs, ours, (f"master surface {master}", f"slave surface {slave}")),
    ):
        low, high = bodies.boxes(inner)
        below, above = bodies.boxes(outer)
        size = (above - below).max(axis=1, keepdims=True)
        room = _SMALL * size
        nested = (low[:, None] >= below - room) & (high[:, None] <= above + room)
        for i, o in np.argwhere(nested.all(axis=2)):
            if inner[i] != outer[o] and _lies_inside(bodies, inner[i], outer[o], size[o, 0]):
                raise ValueError(
                    f"the body of the {names[0]} lies wholly inside the body of the {names[1]}: "
                    f"all its {bodies.count(inner[i])} nodes are in cells of the other. Move "
                    "the bodies apart; they may overlap in part"
                )


def _num_shared(slave: FacetList, master: FacetList, halo: Halo) -> int:
    """Number of nodes that both surfaces have; their facets there may be on different ranks."""
    if halo.comm.size == 1:
        return len(np.intersect1d(slave.nodes, master.nodes))
    has = np.zeros((halo.num_nodes, 2))
    has[slave.nodes, 0] = has[master.nodes, 1] = 1
    return int(
        reduce.total(halo.comm, np.count_nonzero((halo.scatter_reverse(has) > 0).all(axis=1)))
    )


def _lies_inside(bodies: Bodies, inner: int, outer: int, size: float) -> bool:
    """Whether all nodes and midpoints of cells of one body are in cells of another.

    The midpoints tell a body that is inside from one that fills a hole of the other exactly.

    Args:
        bodies: Bodies of the mesh.
        inner: The one.
        outer: The other.
        size: Size of the other.
    """
    comm, x, dofs, domain = bodies.halo.comm, bodies.x, bodies.V.dofmap.list, bodies.V.mesh
    points = np.concatenate([x[dofs[bodies.cells(inner)]].mean(axis=1), x[bodies.nodes(inner)]])
    tree = geometry.bb_tree(
        domain, domain.topology.dim, padding=_SMALL * size, entities=bodies.cells(outer)
    )
    # A few at a time, from everywhere: bodies that are not inside show it soon
    looks = -(-reduce.total(comm, len(points)) // _PER_LOOK)
    for look in range(looks):
        part = reduce.gathered(comm, points[look::looks])
        padded = np.zeros((len(part), 3))
        padded[:, : part.shape[1]] = part
        near = geometry.compute_collisions_points(tree, padded)
        which = np.repeat(np.arange(len(part)), np.diff(near.offsets))
        inside = np.zeros(len(part), dtype=np.int8)
        inside[which[in_hulls(part[which], x[dofs[near.array]], _SMALL)]] = 1
        # A point is in a cell of some rank
        if not reduce.largest(comm, inside).all():
            return False
    return True


def check_outside(
    slave: Surface,
    nodes: npt.NDArray[np.int32],
    gap: npt.NDArray[np.float64],
    obstacle: Obstacle,
    bodies: Bodies,
) -> None:
    """Check that no slave body lies wholly inside a rigid obstacle.

    Args:
        slave: Slave surface.
        nodes: Its nodes on this rank, shape (n,).
        gap: Their gaps, shape (n,).
        obstacle: The obstacle.
        bodies: Bodies of the mesh.

    Raises:
        ValueError: If one does, on all ranks.
    """
    comm = bodies.halo.comm
    names = bodies.carrying(nodes)
    low, high = bodies.boxes(names)
    highest = np.full(len(names), -np.inf)
    np.maximum.at(highest, np.searchsorted(names, bodies.of_node[nodes]), gap)
    highest = reduce.largest(comm, highest)
    for body in names[highest <= _SMALL * (high - low).max(axis=1)]:
        with agreed(comm):
            level = obstacle.level(bodies.x[bodies.nodes(body)])
        size = np.abs(level).max(initial=0.0, where=np.isfinite(level))
        # A body that touches the surface from within has nodes at zero
        within = level <= _SMALL * reduce.largest(comm, float(size))
        if reduce.everywhere(comm, within.all()):
            raise ValueError(
                f"the body of the slave surface {slave} lies wholly inside the rigid obstacle: all "
                f"its {bodies.count(body)} nodes are inside the {type(obstacle).__name__}. "
                f"{obstacle.usual_mistake}, or the body is in the wrong place"
            )
