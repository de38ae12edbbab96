# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A bolt through a sleeve in a tapped block, on curved tetrahedra."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import pairwise
from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive


class BoltTag(IntEnum):
    """Tags of the bodies (cells) and of their faces (facets)."""

    BLOCK = 1
    SLEEVE = 2
    BOLT = 3
    SHANK = 4

    BLOCK_BOTTOM = 11
    BLOCK_TOP = 12
    BLOCK_THREAD = 13
    SLEEVE_BOTTOM = 21
    SLEEVE_TOP = 22
    SLEEVE_BAND = 23
    BOLT_SEAT = 31
    BOLT_THREAD = 32
    SYMMETRY = 41


@dataclass(frozen=True)
class BoltMeasures:
    """Lengths of a bolted joint about the third axis, whose faces are at z = 0.

    Attributes:
        shank: Radius of the shank and of the thread.
        hole: Radius of the hole in the sleeve.
        outer: Radius of sleeve, block and head.
        grip: Height of the sleeve.
        engaged: Length of the thread, which begins at z = 0.
        head: Height of the head.
        base: Height of the block.
        band: Lowest and highest z of the band around the sleeve that loads act on.
    """

    shank: float = 0.5
    hole: float = 0.55
    outer: float = 1.0
    grip: float = 2.0
    engaged: float = 0.8
    head: float = 0.6
    base: float = 1.2
    band: tuple[float, float] = (1.5, 1.9)


def bolt(
    h: float, measures: BoltMeasures | None = None, comm: MPI.Comm = MPI.COMM_WORLD
) -> MeshData:
    """Mesh half of a bolted joint, y >= 0, with tetrahedra of order 2 (collective).

    A block is below z = 0, a sleeve between it and the head of the bolt, whose thread is in the
    block. The three share no node. ``BoltTag`` has the names of the bodies, the bolt's in two
    parts: ``SHANK`` inside the sleeve and ``BOLT`` the rest; and of the faces.

    Args:
        h: Cell size, a length.
        measures: Lengths; the defaults if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``BoltTag`` of its bodies in ``cell_tags`` and of faces in
        ``facet_tags``.

    Raises:
        ValueError: If the cell size is not positive.
    """
    check_positive(h=h)
    m = BoltMeasures() if measures is None else measures

    def recipe(gmsh: ModuleType) -> None:
        ring = (m.hole, m.outer)
        low, high = m.band
        block = [
            *_tubes(gmsh, m.shank, m.outer, (-m.engaged, 0)),
            *_tubes(gmsh, 0, m.outer, (-m.base, -m.engaged)),
        ]
        # Nothing is below the thread
        block = _joined(gmsh, block)
        sleeve = _joined(gmsh, _tubes(gmsh, *ring, (0, low, high, m.grip)))
        pin = _tubes(gmsh, 0, m.shank, (-m.engaged, 0, m.grip))
        head = _tubes(gmsh, 0, m.outer, (m.grip, m.grip + m.head))
        screw = _joined(gmsh, [*pin, *head])
        gmsh.model.occ.synchronize()
        shank = [v for v in screw if _is(gmsh, 3, v, (0, m.grip))]
        for tag, volumes in (
            (BoltTag.BLOCK, block),
            (BoltTag.SLEEVE, sleeve),
            (BoltTag.BOLT, [v for v in screw if v not in shank]),
            (BoltTag.SHANK, shank),
        ):
            gmsh.model.addPhysicalGroup(3, volumes, int(tag), name=tag.name.lower())
        for tag, volumes, place in (
            (BoltTag.BLOCK_BOTTOM, block, (-m.base, -m.base)),
            (BoltTag.BLOCK_TOP, block, (0, 0)),
            (BoltTag.BLOCK_THREAD, block, (-m.engaged, 0, m.shank)),
            (BoltTag.SLEEVE_BOTTOM, sleeve, (0, 0)),
            (BoltTag.SLEEVE_TOP, sleeve, (m.grip, m.grip)),
            (BoltTag.SLEEVE_BAND, sleeve, (low, high, m.outer)),
            (BoltTag.BOLT_SEAT, screw, (m.grip, m.grip)),
            (BoltTag.BOLT_THREAD, screw, (-m.engaged, 0, m.shank)),
        ):
            faces = [f for f in _faces(gmsh, volumes) if _is(gmsh, 2, f, place)]
            gmsh.model.addPhysicalGroup(2, faces, int(tag), name=tag.name.lower())
        cut = [f for f in _faces(gmsh, [*block, *sleeve, *screw]) if _is_cut(gmsh, f)]
        gmsh.model.addPhysicalGroup(2, cut, int(BoltTag.SYMMETRY), name="symmetry")
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)

    options = {"Mesh.MeshSizeMax": h, "Mesh.MeshSizeMin": h / 2, "Mesh.Algorithm3D": 10}
    return build_mesh("bolt", 3, recipe, comm, options)


def _tubes(gmsh: ModuleType, inner: float, outer: float, z: Sequence[float]) -> list[int]:
    """Draw halves of tubes on top of each other, whole inside for a radius of 0."""
    occ, found = gmsh.model.occ, []
    for low, high in pairwise(z):
        tube = occ.addCylinder(0, 0, low, 0, 0, high - low, outer, angle=math.pi)
        if inner > 0:
            hole = occ.addCylinder(0, 0, low, 0, 0, high - low, inner, angle=math.pi)
            ((_, tube),), _ = occ.cut([(3, tube)], [(3, hole)])
        found.append(tube)
    return found


def _joined(gmsh: ModuleType, volumes: Sequence[int]) -> list[int]:
    """Volumes that have the faces between them in common."""
    parts, _ = gmsh.model.occ.fragment([(3, volumes[0])], [(3, v) for v in volumes[1:]])
    return [v for _, v in parts]


def _faces(gmsh: ModuleType, volumes: Sequence[int]) -> list[int]:
    """Outer faces of some volumes together."""
    return [abs(f) for _, f in gmsh.model.getBoundary([(3, v) for v in volumes], combined=True)]


def _is(gmsh: ModuleType, dim: int, entity: int, place: Sequence[float]) -> bool:
    """Whether an entity reaches from a z to another one and, if it is given, to a radius."""
    box = np.array(gmsh.model.getBoundingBox(dim, entity)).reshape(2, 3)
    if dim == 2 and _is_cut(gmsh, entity):
        return False
    found = [box[0, 2], box[1, 2], box[1, 0]][: len(place)]
    return bool(np.allclose(found, place, atol=1e-5))


def _is_cut(gmsh: ModuleType, face: int) -> bool:
    """Whether a face is in the plane of symmetry."""
    box = gmsh.model.getBoundingBox(2, face)
    return bool(box[4] - box[1] < 1e-5)
