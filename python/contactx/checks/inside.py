# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Whether a body lies wholly inside another one or an obstacle, where nothing can push it out."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.bodies.bodies import Bodies
from contactx.checks.hull import in_hulls
from contactx.obstacles import Obstacle
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
        slave_facets: Its facets.
        master_facets: The master's facets.
        bodies: Bodies of the mesh.

    Raises:
        ValueError: If they do, or one does.
    """
    shared = np.intersect1d(slave_facets.nodes, master_facets.nodes)
    if len(shared) > 0:
        raise ValueError(
            f"slave and master overlap: {slave} and {master} share {len(shared)} nodes. "
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
        room = _SMALL * (above - below).max(axis=1, keepdims=True)
        nested = (low[:, None] >= below - room) & (high[:, None] <= above + room)
        for i, o in np.argwhere(nested.all(axis=2)):
            if inner[i] != outer[o] and _lies_inside(bodies, inner[i], outer[o]):
                raise ValueError(
                    f"the body of the {names[0]} lies wholly inside the body of the {names[1]}: "
                    f"all its {len(bodies.nodes(inner[i]))} nodes are in cells of the other. Move "
                    "the bodies apart; they may overlap in part"
                )


def _lies_inside(bodies: Bodies, inner: int, outer: int) -> bool:
    """Whether all nodes and midpoints of cells of one body are in cells of another.

    The midpoints tell a body that is inside from one that fills a hole of the other exactly.
    """
    x, dofs, domain = bodies.x, bodies.V.dofmap.list, bodies.V.mesh
    points = np.concatenate([x[dofs[bodies.cells(inner)]].mean(axis=1), x[bodies.nodes(inner)]])
    padding = _SMALL * float(np.ptp(x[bodies.nodes(outer)], axis=0).max())
    tree = geometry.bb_tree(
        domain, domain.topology.dim, padding=padding, entities=bodies.cells(outer)
    )
    # A few at a time, from everywhere: bodies that are not inside show it soon
    looks = -(-len(points) // _PER_LOOK)
    for look in range(looks):
        part = points[look::looks]
        padded = np.zeros((len(part), 3))
        padded[:, : part.shape[1]] = part
        near = geometry.compute_collisions_points(tree, padded)
        which = np.repeat(np.arange(len(part)), np.diff(near.offsets))
        hits = in_hulls(part[which], x[dofs[near.array]], _SMALL)
        if len(np.unique(which[hits])) < len(part):
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
        nodes: Its nodes, shape (n,).
        gap: Their gaps, shape (n,).
        obstacle: The obstacle.
        bodies: Bodies of the mesh.

    Raises:
        ValueError: If one does.
    """
    for body in bodies.carrying(nodes):
        x = bodies.x[bodies.nodes(body)]
        if gap[bodies.of_node[nodes] == body].max() > _SMALL * np.ptp(x, axis=0).max():
            continue
        level = obstacle.level(x)
        # A body that touches the surface from within has nodes at zero
        if np.all(level <= _SMALL * np.abs(level).max()):
            raise ValueError(
                f"the body of the slave surface {slave} lies wholly inside the rigid obstacle: "
                f"all its {len(x)} nodes are inside the {type(obstacle).__name__}. "
                f"{obstacle.usual_mistake}, or the body is in the wrong place"
            )
