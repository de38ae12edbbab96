# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The round section of a cord, on curved triangles."""

from __future__ import annotations

import math
from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive
from meshes.outline import group
from meshes.tags import Tag


def cord(h: float, *, radius: float = 0.5, comm: MPI.Comm = MPI.COMM_WORLD) -> MeshData:
    """Mesh a disc about the origin with triangles of order 2 (collective).

    It is the upper body, and all of its boundary is tagged ``UPPER_CONTACT``. There are nodes on
    both axes.

    Args:
        h: Cell size, a length.
        radius: Radius, a length.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of the body in ``cell_tags`` and of its boundary in
        ``facet_tags``.

    Raises:
        ValueError: If a length is not positive.
    """
    check_positive(h=h, radius=radius)

    def recipe(gmsh: ModuleType) -> None:
        geo = gmsh.model.geo
        centre = geo.addPoint(0, 0, 0)
        corners = [
            geo.addPoint(radius * x, radius * y, 0) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))
        ]
        arcs = [geo.addCircleArc(corners[i], centre, corners[(i + 1) % 4]) for i in range(4)]
        disc = geo.addPlaneSurface([geo.addCurveLoop(arcs)])
        for arc in arcs:
            geo.mesh.setTransfiniteCurve(arc, max(2, math.ceil(math.pi / 2 * radius / h)) + 1)
        geo.synchronize()
        group(gmsh, disc, Tag.UPPER, {Tag.UPPER_CONTACT: arcs})
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)

    return build_mesh("cord", 2, recipe, comm, {"Mesh.MeshSizeExtendFromBoundary": 1.0})
