# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Half a drum with a belt around it, on structured, curved quadrilaterals."""

from __future__ import annotations

import math
from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_positive
from meshes.outline import group
from meshes.tags import Tag


def belt(
    n: int,
    n_drum: int | None = None,
    *,
    radius: float = 1.0,
    thickness: float = 0.02,
    bore: float = 0.7,
    overhang: float = 0.2,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a belt over the upper half of a drum with cells of order 2 (collective).

    The upper body (slave) is the belt, half a ring about the origin in y >= 0; the lower one
    (master) the drum, a ring that reaches further than the belt by an angle on both sides. The
    faces that are tagged: ``UPPER_CONTACT`` (inside of the belt), ``UPPER_X0`` and ``UPPER_X1``
    (its ends at x < 0 and x > 0), ``LOWER_CONTACT`` and ``LOWER_BOTTOM`` (the drum's bore).

    Args:
        n: Number of cells along the belt.
        n_drum: The same along the drum; nine tenths of n if None.
        radius: Radius of the drum, a length.
        thickness: Of the belt, a length.
        bore: Radius of the drum's bore, a length.
        overhang: Angle by which the drum reaches further, radians.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a number of cells is below one or a length not positive.
    """
    n_drum = max(1, round(0.9 * n)) if n_drum is None else n_drum
    check_divisions(n=n, n_drum=n_drum)
    check_positive(radius=radius, thickness=thickness, bore=bore)

    def recipe(gmsh: ModuleType) -> None:
        inner, first, outer, last, belt_body = _ring(gmsh, radius, radius + thickness, 0, n, 1)
        group(
            gmsh,
            belt_body,
            Tag.UPPER,
            {Tag.UPPER_CONTACT: inner, Tag.UPPER_X1: first, Tag.UPPER_X0: last},
        )
        inner, _, outer, _, drum = _ring(gmsh, bore, radius, overhang, n_drum, 5)
        group(gmsh, drum, Tag.LOWER, {Tag.LOWER_CONTACT: outer, Tag.LOWER_BOTTOM: inner})
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)

    return build_mesh("belt", 2, recipe, comm)


def _ring(
    gmsh: ModuleType, low: float, high: float, overhang: float, n: int, across: int
) -> tuple[list[int], list[int], list[int], list[int], int]:
    """Draw half a ring: its inner arcs, first end, outer arcs, last end and surface."""
    geo = gmsh.model.geo
    centre = geo.addPoint(0, 0, 0)
    begin, end = -overhang, math.pi + overhang
    corners = [
        geo.addPoint(r * math.cos(phi), r * math.sin(phi), 0)
        for phi in (begin, math.pi / 2, end)
        for r in (low, high)
    ]
    inner = [
        geo.addCircleArc(corners[4], centre, corners[2]),
        geo.addCircleArc(corners[2], centre, corners[0]),
    ]
    first = geo.addLine(corners[0], corners[1])
    outer = [
        geo.addCircleArc(corners[1], centre, corners[3]),
        geo.addCircleArc(corners[3], centre, corners[5]),
    ]
    last = geo.addLine(corners[5], corners[4])
    surface = geo.addPlaneSurface([geo.addCurveLoop([*inner, first, *outer, last])])
    for arc in (*inner, *outer):
        geo.mesh.setTransfiniteCurve(arc, max(1, n // 2) + 1)
    for line in (first, last):
        geo.mesh.setTransfiniteCurve(line, across + 1)
    geo.mesh.setTransfiniteSurface(
        surface, cornerTags=[corners[4], corners[0], corners[1], corners[5]]
    )
    geo.mesh.setRecombine(2, surface)
    geo.synchronize()
    return inner, [first], outer, [last], int(surface)
