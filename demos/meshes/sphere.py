# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Hertz problem of a sphere on a block, on tetrahedra."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive
from meshes.entities import CURVED, tag_body
from meshes.tags import LOWER_QUARTER, UPPER_QUARTER, Tag

_UPPER_FACES = {CURVED: Tag.UPPER_CONTACT, **UPPER_QUARTER}
_LOWER_FACES = {"z1": Tag.LOWER_CONTACT, **LOWER_QUARTER}
# Parallel Delaunay (HXT), and no cell larger than a fifth of the radius.
_OPTIONS = {"Mesh.Algorithm3D": 10, "Mesh.MeshSizeMax": 0.2}


def hertz_sphere(h: float, comm: MPI.Comm = MPI.COMM_WORLD, *, order: int = 1) -> MeshData:
    """Mesh a quarter hemisphere that touches a quarter block (collective).

    The upper body is the octant x, y >= 0, z <= 1 of the ball of radius 1 about (0, 0, 1), the
    lower body the block [0, 1] x [0, 1] x [-1, 0]; they touch in the origin and share no node.
    Linear tetrahedra of size h within 0.2 of the origin, growing by a quarter of the distance
    beyond. x = 0 and y = 0 are planes of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the sphere), ``UPPER_TOP`` (z = 1),
    ``UPPER_X0``, ``UPPER_Y0``, ``LOWER_CONTACT`` (z = 0), ``LOWER_BOTTOM`` (z = -1),
    ``LOWER_X0`` and ``LOWER_Y0``.

    Args:
        h: Cell size in the contact zone, in radii; 0.04 is coarse, 0.01 fine.
        comm: Communicator of the mesh; rank 0 makes it.
        order: Order of the cells; of order 2 they are curved.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If h is not positive.
    """
    check_positive(h=h)

    def recipe(gmsh: ModuleType) -> None:
        occ = gmsh.model.occ
        ball = occ.addSphere(0, 0, 1, 1)
        octant = occ.addBox(0, 0, 0, 1, 1, 1)
        ((_, upper),), _ = occ.intersect([(3, ball)], [(3, octant)])
        lower = occ.addBox(0, 0, -1, 1, 1, 1)
        occ.synchronize()
        tag_body(gmsh, 3, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 3, lower, Tag.LOWER, _LOWER_FACES)

        field = gmsh.model.mesh.field
        size = field.add("MathEval")
        field.setString(size, "F", f"{h} + 0.25*Max(Sqrt(x*x+y*y+z*z) - 0.2, 0)")
        field.setAsBackgroundMesh(size)
        gmsh.model.mesh.generate(3)
        if order > 1:
            gmsh.model.mesh.setOrder(order)

    return build_mesh("hertz_sphere", 3, recipe, comm, _OPTIONS)
