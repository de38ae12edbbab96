# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cell sizes of bodies that touch in the origin."""

from __future__ import annotations

from collections.abc import Mapping
from types import ModuleType


def grade_from_origin(
    gmsh: ModuleType, sizes: Mapping[int, float], zone: float, dim: int = 2
) -> None:
    """Give each body its own size near the origin, growing by a quarter of the distance beyond.

    Args:
        gmsh: The gmsh module with its current, synchronised model.
        sizes: Cell size in the zone by the gmsh tag of the body, a length.
        zone: Radius of the zone about the origin, a length.
        dim: Dimension of the bodies.
    """
    bodies = "SurfacesList" if dim == 2 else "VolumesList"
    field = gmsh.model.mesh.field
    fields = []
    for body, size in sizes.items():
        graded = field.add("MathEval")
        field.setString(graded, "F", f"{size} + 0.25*Max(Sqrt(x*x+y*y+z*z) - {zone}, 0)")
        # The bodies touch in the origin; each field may speak only for its own.
        fields.append(field.add("Restrict"))
        field.setNumber(fields[-1], "InField", graded)
        field.setNumbers(fields[-1], bodies, [body])
    smallest = field.add("Min")
    field.setNumbers(smallest, "FieldsList", fields)
    field.setAsBackgroundMesh(smallest)
