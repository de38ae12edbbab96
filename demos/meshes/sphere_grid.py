# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Hertz problem of a sphere on a block, on hexahedra."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData

from meshes.bend import Bottom, move_nodes
from meshes.build import build_mesh
from meshes.checks import check_positive
from meshes.entities import tag_body
from meshes.grids import Coordinates, add_grid, graded
from meshes.tags import LOWER_QUARTER, UPPER_QUARTER, Tag

_UPPER_FACES = {"z0": Tag.UPPER_CONTACT, **UPPER_QUARTER}
_LOWER_FACES = {"z1": Tag.LOWER_CONTACT, **LOWER_QUARTER}
# Side of the sphere's part; further out its cells would be flat
_SIDE = 0.6
_ZONE, _RATIO, _LARGEST = 0.2, 1.25, 0.2


def _even_then_graded(length: float, h: float) -> Coordinates:
    """Coordinates of cells that are of one size in the zone and grow beyond."""
    even = np.linspace(0, _ZONE, max(1, round(_ZONE / h)) + 1)
    beyond = graded(length - _ZONE, _RATIO * h, _RATIO, _LARGEST)
    return np.concatenate([even, _ZONE + beyond[1:]])


def hertz_grid(
    h: float, h_master: float | None = None, comm: MPI.Comm = MPI.COMM_WORLD
) -> MeshData:
    """Mesh a quarter of a sphere's lower part that touches a quarter block (collective).

    The problem of `hertz_sphere` on structured grids of trilinear hexahedra that do not match: the
    upper body (slave) fills [0, 0.6] x [0, 0.6] from the sphere of radius 1 about (0, 0, 1) up to
    z = 1, the lower body (master) is the block [0, 1] x [0, 1] x [-1, 0]; they touch in the origin
    and share no node. Along x and y cells are of one size within 0.2 of the origin; beyond, and
    along z everywhere, each is a quarter longer than the one before. x = 0 and y = 0 are planes
    of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the sphere), ``UPPER_TOP`` (z = 1),
    ``UPPER_X0``, ``UPPER_Y0``, ``LOWER_CONTACT`` (z = 0), ``LOWER_BOTTOM`` (z = -1),
    ``LOWER_X0`` and ``LOWER_Y0``.

    Args:
        h: Cell size of the upper body in the contact zone, in radii, at most 0.2.
        h_master: Cell size of the lower body in the contact zone, in radii; 1.5 h if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a size is not positive, or the cells of the upper body are larger than the
            contact zone.
    """
    check_positive(h=h)
    h_lower = 1.5 * h if h_master is None else h_master
    check_positive(h_master=h_lower)
    if h > _ZONE:
        raise ValueError(f"h is {h}; give at most the size of the contact zone, {_ZONE}.")

    def recipe(gmsh: ModuleType) -> None:
        across, up = _even_then_graded(_SIDE, h), graded(1.0, h, _RATIO, _LARGEST)
        upper = add_grid(gmsh, across, across, up)
        across, down = _even_then_graded(1.0, h_lower), graded(1.0, h_lower, _RATIO, _LARGEST)
        lower = add_grid(gmsh, across, across, -down[::-1])
        tag_body(gmsh, 3, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 3, lower, Tag.LOWER, _LOWER_FACES)
        gmsh.model.mesh.generate(3)
        move_nodes(gmsh, 3, upper, Bottom((0, 0), 0.0, 1.0, 1.0).bend)

    return build_mesh("hertz_grid", 3, recipe, comm)
