# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two concentric rings for a press fit, on structured quadrilaterals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_numbers
from meshes.tags import Tag

# In the order of the edges: inner arc, y = 0, outer arc, x = 0.
_UPPER_FACES = (Tag.UPPER_TOP, Tag.UPPER_Y0, Tag.UPPER_CONTACT, Tag.UPPER_X0)
_LOWER_FACES = (Tag.LOWER_CONTACT, Tag.LOWER_Y0, Tag.LOWER_BOTTOM, Tag.LOWER_X0)


def _add_ring(
    gmsh: ModuleType, inner: float, outer: float, n: int, tag: Tag, faces: Sequence[Tag]
) -> None:
    """Draw and tag a quarter of a ring, with n cells along its arcs and square ones at half way."""
    n_radial = max(1, round(n * (outer - inner) / (math.pi / 4 * (inner + outer))))
    geo = gmsh.model.geo
    centre, a, b, c, d = (
        geo.addPoint(x, y, 0) for x, y in ((0, 0), (inner, 0), (outer, 0), (0, outer), (0, inner))
    )
    edges = [
        geo.addCircleArc(d, centre, a),
        geo.addLine(a, b),
        geo.addCircleArc(b, centre, c),
        geo.addLine(c, d),
    ]
    ring = geo.addPlaneSurface([geo.addCurveLoop(edges)])
    # Set in the kernel: in the model, the next body's synchronisation would reset it.
    for edge, cells in zip(edges, (n, n_radial, n, n_radial), strict=True):
        geo.mesh.setTransfiniteCurve(edge, cells + 1)
    geo.mesh.setTransfiniteSurface(ring)
    geo.mesh.setRecombine(2, ring)
    geo.synchronize()
    gmsh.model.addPhysicalGroup(2, [ring], int(tag), name=tag.name.lower())
    for edge, face in zip(edges, faces, strict=True):
        gmsh.model.addPhysicalGroup(1, [edge], int(face), name=face.name.lower())


def rings(
    n: int,
    n_master: int | None = None,
    *,
    radii: Sequence[float] = (1.0, 1.5, 2.0),
    order: int = 1,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a quarter of two concentric rings, the one inside the other (collective).

    The upper body (slave) is the inner ring between the first two radii, the lower body (master)
    the outer ring between the last two, both in x, y >= 0 about the origin; they touch all along
    the middle radius and share no node. Structured grids of bilinear quadrilaterals that do not
    match, with cells that are about square. x = 0 and y = 0 are planes of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the middle radius), ``UPPER_TOP`` (the bore, the
    first radius), ``UPPER_X0``, ``UPPER_Y0``, ``LOWER_CONTACT`` (the middle radius),
    ``LOWER_BOTTOM`` (the rim, the last radius), ``LOWER_X0`` and ``LOWER_Y0``.

    Args:
        n: Number of cells of the inner ring along the quarter of a circle.
        n_master: The same for the outer ring; half as many again as n if None.
        radii: Radii of the bore, of the contact and of the rim, a length, shape (3,).
        order: Order of the cells; of order 2 they are curved.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a number of cells is below one, or the radii are not three positive
            numbers that increase.
    """
    check_divisions(n=n)
    n_lower = max(n + 1, 3 * n // 2) if n_master is None else n_master
    check_divisions(n_master=n_lower)
    check_numbers("radii", radii)
    if not (len(radii) == 3 and np.all(np.isfinite(radii)) and np.all(np.diff([0, *radii]) > 0)):
        raise ValueError(f"radii is {radii}; give 3 positive numbers, each above the one before.")

    def recipe(gmsh: ModuleType) -> None:
        _add_ring(gmsh, radii[0], radii[1], n, Tag.UPPER, _UPPER_FACES)
        _add_ring(gmsh, radii[1], radii[2], n_lower, Tag.LOWER, _LOWER_FACES)
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(order)

    return build_mesh("rings", 2, recipe, comm)
