# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Hertz problem of a cylinder on a block in plane strain, on triangles."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive
from meshes.entities import CURVED, tag_body
from meshes.sizes import grade_from_origin
from meshes.tags import Tag

_UPPER_FACES = {CURVED: Tag.UPPER_CONTACT, "y1": Tag.UPPER_TOP, "x0": Tag.UPPER_X0}
_LOWER_FACES = {"y1": Tag.LOWER_CONTACT, "y0": Tag.LOWER_BOTTOM, "x0": Tag.LOWER_X0}
_OPTIONS = {"Mesh.MeshSizeMax": 0.2}


def _add_quarter_disc(gmsh: ModuleType) -> int:
    """Draw the quarter disc between its lowest point, its centre and its rightmost point."""
    geo = gmsh.model.geo
    bottom, right, centre = (geo.addPoint(*xy, 0) for xy in ((0, 0), (1, 1), (0, 1)))
    arc = geo.addCircleArc(bottom, centre, right)
    lines = [geo.addLine(right, centre), geo.addLine(centre, bottom)]
    disc = geo.addPlaneSurface([geo.addCurveLoop([arc, *lines])])
    geo.synchronize()
    return int(disc)


def _add_rectangle(gmsh: ModuleType) -> int:
    """Draw the block [0, 1] x [-1, 0]."""
    geo = gmsh.model.geo
    points = [geo.addPoint(*xy, 0) for xy in ((0, 0), (0, -1), (1, -1), (1, 0))]
    lines = [geo.addLine(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)]
    block = geo.addPlaneSurface([geo.addCurveLoop(lines)])
    geo.synchronize()
    return int(block)


def hertz_cylinder(
    h: float,
    h_master: float | None = None,
    zone: float = 0.2,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a quarter disc that touches a block, the half x >= 0 of the model (collective).

    The upper body (slave) is the quarter x >= 0, y <= 1 of the disc of radius 1 about (0, 1), the
    lower body (master) the block [0, 1] x [-1, 0]; they touch in the origin and share no node.
    Linear triangles, growing by a quarter of the distance beyond the contact zone. x = 0 is the
    plane of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the arc), ``UPPER_TOP`` (y = 1), ``UPPER_X0``,
    ``LOWER_CONTACT`` (y = 0), ``LOWER_BOTTOM`` (y = -1) and ``LOWER_X0``.

    Args:
        h: Cell size of the upper body in the contact zone, in radii.
        h_master: Cell size of the lower body in the contact zone, in radii; h/2 if None.
        zone: Radius of the contact zone about the origin, in radii.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a size is not positive.
    """
    check_positive(h=h)
    h_lower = h / 2 if h_master is None else h_master
    check_positive(h_master=h_lower, zone=zone)

    def recipe(gmsh: ModuleType) -> None:
        upper, lower = _add_quarter_disc(gmsh), _add_rectangle(gmsh)
        tag_body(gmsh, 2, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 2, lower, Tag.LOWER, _LOWER_FACES)
        grade_from_origin(gmsh, {upper: h, lower: h_lower}, zone)
        gmsh.model.mesh.generate(2)

    return build_mesh("hertz_cylinder", 2, recipe, comm, _OPTIONS)
