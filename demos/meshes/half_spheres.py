# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A quarter of two half spheres that touch, on tetrahedra."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive, check_zone
from meshes.entities import CURVED, tag_body
from meshes.sizes import grade_from_origin
from meshes.tags import LOWER_QUARTER, UPPER_QUARTER, Tag

_UPPER_FACES = {CURVED: Tag.UPPER_CONTACT, **UPPER_QUARTER}
_LOWER_FACES = {CURVED: Tag.LOWER_CONTACT, **LOWER_QUARTER}
# Largest cell, in radii
_COARSEST = 0.2


def _add_octant(gmsh: ModuleType, height: float) -> int:
    """Draw the octant x, y >= 0 of a ball between its centre at a height and the origin."""
    occ, radius = gmsh.model.occ, abs(height)
    ball = occ.addSphere(0, 0, height, radius)
    box = occ.addBox(0, 0, min(height, 0), radius, radius, radius)
    ((_, octant),), _ = occ.intersect([(3, ball)], [(3, box)])
    occ.synchronize()
    return int(octant)


def half_spheres(
    radius: float,
    h: float,
    h_master: float | None = None,
    *,
    zone: float,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a quarter of two half balls of one radius that touch in the origin (collective).

    The upper body (slave) is the octant x, y >= 0, z <= R of the ball about (0, 0, R), the lower
    body (master) the octant x, y >= 0, z >= -R of the ball about (0, 0, -R); they share no node,
    but both have one in the origin. Linear tetrahedra, growing by a quarter of the distance beyond
    the contact zone up to a fifth of the radius. x = 0 and y = 0 are planes of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the sphere), ``UPPER_TOP`` (z = R), ``UPPER_X0``,
    ``UPPER_Y0``, ``LOWER_CONTACT`` (the sphere), ``LOWER_BOTTOM`` (z = -R), ``LOWER_X0`` and
    ``LOWER_Y0``.

    Args:
        radius: Radius R, a length.
        h: Cell size of the upper body in the contact zone, a length.
        h_master: Cell size of the lower body in the contact zone, a length; 1.5 h if None, so that
            the meshes do not match.
        zone: Radius of the contact zone about the origin, a length; 1.3 times the radius of the
            contact is enough.
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
        upper, lower = _add_octant(gmsh, radius), _add_octant(gmsh, -radius)
        tag_body(gmsh, 3, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 3, lower, Tag.LOWER, _LOWER_FACES)
        grade_from_origin(gmsh, {upper: h, lower: h_lower}, zone, dim=3)
        gmsh.model.mesh.generate(3)

    options = {"Mesh.Algorithm3D": 10, "Mesh.MeshSizeMax": _COARSEST * radius}
    return build_mesh("half_spheres", 3, recipe, comm, options)
