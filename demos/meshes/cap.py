# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The Hertz problem of a spherical cap on a block, on hexahedra."""

from __future__ import annotations

from types import ModuleType

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from dolfinx.io.gmsh import MeshData

from meshes.bend import Bottom, move_nodes
from meshes.build import build_mesh
from meshes.checks import check_divisions, check_positive
from meshes.entities import add_box, tag_body
from meshes.tags import LOWER_QUARTER, UPPER_QUARTER, Tag

_UPPER_FACES = {"z0": Tag.UPPER_CONTACT, **UPPER_QUARTER}
_LOWER_FACES = {"z1": Tag.LOWER_CONTACT, **LOWER_QUARTER}
_GROWTH = 4.0


def _grade(x: npt.NDArray[np.float64], n: int, length: float) -> npt.NDArray[np.float64]:
    """Move evenly spaced points so that the cell sizes grow geometrically away from zero."""
    if n == 1:
        return x
    total = _GROWTH ** (n / (n - 1))
    return np.asarray(np.sign(x) * length * (total ** (np.abs(x) / length) - 1) / (total - 1))


def hertz_cap(
    n: int,
    n_master: int | None = None,
    length: float = 1.0,
    radius: float | None = None,
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh a quarter block with a spherical bottom that touches a quarter block (collective).

    The upper body (slave) fills [0, L] x [0, L] from the sphere of the given radius about
    (0, 0, radius) up to z = L, the lower body (master) is [0, L] x [0, L] x [-L, 0]; they touch
    in the origin and share no node. Both are structured grids of trilinear hexahedra that
    do not match, graded towards the origin: along an edge the longest cell is four times as
    long as the shortest. x = 0 and y = 0 are planes of symmetry.

    The faces that are tagged: ``UPPER_CONTACT`` (the cap), ``UPPER_TOP`` (z = L), ``UPPER_X0``,
    ``UPPER_Y0``, ``LOWER_CONTACT`` (z = 0), ``LOWER_BOTTOM`` (z = -L), ``LOWER_X0`` and
    ``LOWER_Y0``.

    Args:
        n: Number of cells along each edge of the upper body.
        n_master: The same for the lower body; half as many again as n if None.
        length: Edge length L of the bodies.
        radius: Radius of the cap, in the unit of length; 8 L if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If a number of cells is below one, a length is not positive, or the radius is
            below 2 L, where the cap would rise into the upper half of the body.
    """
    check_divisions(n=n)
    check_positive(length=length)
    n_lower = max(n + 1, 3 * n // 2) if n_master is None else n_master
    cap_radius = 8 * length if radius is None else radius
    check_divisions(n_master=n_lower)
    check_positive(radius=cap_radius)
    if cap_radius < 2 * length:
        raise ValueError(
            f"radius is {cap_radius}; give at least twice the length, {2 * length}, "
            "or the cap distorts the hexahedra."
        )

    def recipe(gmsh: ModuleType) -> None:
        size = (length, length, length)
        upper = add_box(gmsh, (0, 0, 0), size, (n, n, n), recombine=True)
        lower = add_box(gmsh, (0, 0, -length), size, (n_lower, n_lower, n_lower), recombine=True)
        tag_body(gmsh, 3, upper, Tag.UPPER, _UPPER_FACES)
        tag_body(gmsh, 3, lower, Tag.LOWER, _LOWER_FACES)
        gmsh.model.mesh.generate(3)
        bottom = Bottom((0, 0), 0.0, length, cap_radius)
        move_nodes(gmsh, 3, upper, lambda x: bottom.bend(_grade(x, n, length)))
        move_nodes(gmsh, 3, lower, lambda x: _grade(x, n_lower, length))

    return build_mesh("hertz_cap", 3, recipe, comm)
