# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a body lies wholly inside another one or an obstacle, where nothing can push it out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.bodies import Bodies
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
    """Check that the surfaces share no facets and neither body lies wholly inside the other.

    Bodies may overlap in part, by however much. Crack faces share the nodes of their tip: those
    have no gap, ever, as long as they are on the edge of both surfaces and each facet has another
    node that the other surface has not.

    Args:
        slave: Slave surface.
        master: Master surface.
        slave_facets: Its facets on this rank.
        master_facets: The master's facets on this rank.
        bodies: Bodies of the mesh.

    Raises:
        ValueError: If they do, or one does, on all ranks.
    """
    comm, shared = bodies.halo.comm, shared_nodes(slave_facets, master_facets, bodies.halo)
    bad = False
    for facets in (slave_facets, master_facets):
        bad |= bool((shared[: bodies.halo.num_owned] & ~_edge_nodes(facets, bodies.halo)).any())
        bad |= any(shared[nodes].all(axis=1).any() for _, nodes in facets.groups())
    if reduce.anywhere(comm, bad):
        count = reduce.total(comm, np.count_nonzero(shared[: bodies.halo.num_owned]))
        raise ValueError(
            f"slave and master overlap: {slave} and {master} share {count} nodes. Give each body "
            "its own nodes and each surface its own facets: in gmsh do not fragment the bodies. "
            "Faces of a crack may share the nodes of its tip, at the edge of both, and no others"
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


def shared_nodes(slave: FacetList, master: FacetList, halo: Halo) -> npt.NDArray[np.bool_]:
    """Which nodes both surfaces have; their facets there may be on different ranks.

    All ranks must take part.

    Args:
        slave: Slave facets on this rank.
        master: Master facets on this rank.
        halo: Nodes of this rank.

    Returns:
        Which nodes, shape (num_nodes,).
    """
    has = np.zeros((halo.num_nodes, 2))
    has[slave.nodes, 0] = has[master.nodes, 1] = 1
    both = (halo.scatter_reverse(has) > 0).all(axis=1)
    shared: npt.NDArray[np.bool_] = halo.scatter_forward(both.astype(np.int8)) > 0
    return shared


def _edge_nodes(facets: FacetList, halo: Halo) -> npt.NDArray[np.bool_]:
    """Which owned nodes are at the edge of a surface, shape (num_owned,); all must take part.

    Around a node within the surface each facet begins where another one ends, so that any numbers
    of the neighbours at which they do cancel.
    """
    number = halo.original * 2654435761 % 2**31
    turns = np.zeros(halo.num_nodes)
    for _, nodes in facets.groups():
        if nodes.shape[1] == 2:
            # NumPy 2.5 reads beyond values that are fewer than the places
            np.add.at(turns, nodes, np.broadcast_to([1.0, -1.0], nodes.shape))
            continue
        ring = nodes if nodes.shape[1] == 3 else nodes[:, [0, 1, 3, 2]]
        after, before = (number[np.roll(ring, way, axis=1)] for way in (-1, 1))
        np.add.at(turns, ring, (after - before).astype(np.float64))
    edge: npt.NDArray[np.bool_] = halo.scatter_reverse(turns) != 0
    return edge


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
