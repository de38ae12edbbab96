# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two half cylinders that touch, in plane strain, on triangles."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive, check_zone
from meshes.entities import CURVED, tag_body
from meshes.sizes import grade_from_origin
from meshes.tags import Tag

_UPPER_FACES = {CURVED: Tag.UPPER_CONTACT, "y1": Tag.UPPER_TOP}
_LOWER_FACES = {CURVED: Tag.LOWER_CONTACT, "y0": Tag.LOWER_BOTTOM}
# Largest cell, in radii
_COARSEST = 0.1


def _add_half_disc(gmsh: ModuleType, height: float) -> int:
    """Draw the half disc between a flat face at a height and the origin."""
    geo, radius = gmsh.model.geo, abs(height)
    corners = ((0, 0), (radius, height), (-radius, height), (0, height))
    origin, right, left, centre = (geo.addPoint(*xy, 0) for xy in corners)
    # An arc of gmsh has to be shorter than half a circle
    curves = [
        geo.addCircleArc(left, centre, origin),
        geo.addCircleArc(origin, centre, right),
        geo.addLine(right, left),
    ]
    disc = geo.addPlaneSurface([geo.addCurveLoop(curves)])
    geo.synchronize()
    return int(disc)


def half_cylinders(
    radius: float,
    h: float,
    h_master: float | None = None,
    *,
    zone: float,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh two half discs of one radius whose arcs touch in the origin (collective).

    The upper body (slave) is the half y <= R of the disc about (0, R), the lower body (master) the
    half y >= -R of the disc about (0, -R); they share no node, but both have one in the origin.
    Linear triangles, growing by a quarter of the distance beyond the contact zone up to a tenth of
    the radius. Nothing is a plane of symmetry, so that the bodies may be pushed sideways.

    The faces that are tagged: ``UPPER_CONTACT`` (the whole arc), ``UPPER_TOP`` (y = R),
    ``LOWER_CONTACT`` (the whole arc) and ``LOWER_BOTTOM`` (y = -R).

    Args:
        radius: Radius R, a length.
        h: Cell size of the upper body in the contact zone, a length.
        h_master: Cell size of the lower body in the contact zone, a length; 1.5 h if None, so that
            the meshes do not match.
        zone: Radius of the contact zone about the origin, a length; 1.5 times the half-width of
            the contact is enough.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a length is not positive, or the zone reaches beyond the radius.
    """
    check_positive(h=h)
    h_lower = 1.5 * h if h_master is None else h_master
    check_positive(radius=radius, h_master=h_lower, zone=zone)
    check_zone(zone, radius)

    def recipe(gmsh: ModuleType) -> None:
        upper, lower = _add_half_disc(gmsh, radius), _add_half_disc(gmsh, -radius)
        tag_body(gmsh, 2, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 2, lower, Tag.LOWER, _LOWER_FACES)
        grade_from_origin(gmsh, {upper: h, lower: h_lower}, zone)
        gmsh.model.mesh.generate(2)

    options = {"Mesh.MeshSizeMax": _COARSEST * radius}
    return build_mesh("half_cylinders", 2, recipe, comm, options)
