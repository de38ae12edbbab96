# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A whole ring that rolls, on structured quadrilaterals."""

from __future__ import annotations

import math
from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_positive
from meshes.tags import Tag


def hoop(
    n: int,
    n_radial: int = 2,
    *,
    radius: float = 1.0,
    thickness: float = 0.1,
    height: float = 0.0,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a ring whose lowest node is on the second axis (collective).

    Its centre is on the second axis, too, at the outer radius above the height. The whole is the
    upper body; its outer face is tagged ``UPPER_CONTACT``, its inner one ``UPPER_TOP``.

    Args:
        n: Number of cells of a quarter of the ring.
        n_radial: Number of cells across the ring.
        radius: Outer radius, a length.
        thickness: Outer radius less inner radius.
        height: Height of the lowest node.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of the body in ``cell_tags`` and of its faces in ``facet_tags``.

    Raises:
        ValueError: If a number of cells is below one, a length is not positive, or the thickness
            is not below the radius.
    """
    check_divisions(n=n, n_radial=n_radial)
    check_positive(radius=radius, thickness=thickness)
    if thickness >= radius:
        raise ValueError(f"thickness is {thickness}; give less than the radius, {radius}.")

    def recipe(gmsh: ModuleType) -> None:
        geo, centre = gmsh.model.geo, (0.0, height + radius, 0.0)
        middle = geo.addPoint(*centre)
        radii = (radius - thickness, radius)
        points = [
            [
                geo.addPoint(centre[0] + r * math.cos(phi), centre[1] + r * math.sin(phi), 0)
                for phi in (-math.pi / 2, 0, math.pi / 2, math.pi)
            ]
            for r in radii
        ]
        arcs = [
            [geo.addCircleArc(ring[i], middle, ring[(i + 1) % 4]) for i in range(4)]
            for ring in points
        ]
        spokes = [geo.addLine(points[0][i], points[1][i]) for i in range(4)]
        quarters = []
        for i in range(4):
            edges = [spokes[i], arcs[1][i], -spokes[(i + 1) % 4], -arcs[0][i]]
            quarters.append(geo.addPlaneSurface([geo.addCurveLoop(edges)]))
        for line in spokes:
            geo.mesh.setTransfiniteCurve(line, n_radial + 1)
        for arc in (*arcs[0], *arcs[1]):
            geo.mesh.setTransfiniteCurve(arc, n + 1)
        for quarter in quarters:
            geo.mesh.setTransfiniteSurface(quarter)
            geo.mesh.setRecombine(2, quarter)
        geo.synchronize()
        for dim, entities, tag in (
            (2, quarters, Tag.UPPER),
            (1, arcs[1], Tag.UPPER_CONTACT),
            (1, arcs[0], Tag.UPPER_TOP),
        ):
            gmsh.model.addPhysicalGroup(dim, entities, int(tag), name=tag.name.lower())
        gmsh.model.mesh.generate(2)

    return build_mesh("hoop", 2, recipe, comm)
