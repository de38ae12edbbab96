# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A cantilever hook with a round nose in front of a catch."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import ModuleType

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_positive
from meshes.outline import POINT_SIZES, Outline
from meshes.tags import Tag


@dataclass(frozen=True)
class SnapHook:
    """Measures of a hook and its catch, in the plane.

    The beam's axis is y = 0, from its root at x = 0 along x. The nose hangs below it at
    x = ``length`` and ends in half a circle. The catch is a trapezoid whose top is higher by
    ``overlap`` than the lowest point of the nose.

    Attributes:
        length: From the root to the middle of the nose.
        thickness: Of the beam.
        nose: Radius of the nose; it is twice as wide.
        depth: From the axis to the centre of the nose's circle.
        overlap: Height of the catch's top above the lowest point of the nose.
        angles: Angles of the ramps on the way in and on the way out, radians.
        top: Length of the flat top between its corners, before they are rounded.
        rounding: Radius of the corners of the top.
        clearance: From the nose to the catch along x, about, at the start.
        below: Height of the catch below the lowest point of the nose.
    """

    length: float = 12.0
    thickness: float = 1.0
    nose: float = 0.5
    depth: float = 1.2
    overlap: float = 0.7
    angles: tuple[float, float] = (math.radians(30), math.radians(45))
    top: float = 1.0
    rounding: float = 0.6
    clearance: float = 0.1
    below: float = 0.6

    @property
    def ground(self) -> float:
        """Height of the catch's bottom."""
        return -self.depth - self.nose - self.below

    @property
    def crest(self) -> float:
        """Height of the catch's top."""
        return -self.depth - self.nose + self.overlap

    @property
    def foot(self) -> float:
        """Position along x of the foot of the ramp on the way in, at the catch's bottom."""
        ahead = self.nose * math.tan((math.pi / 2 - self.angles[0]) / 2)
        reach = self.below / math.tan(self.angles[0])
        return self.length + ahead + self.clearance - reach

    @property
    def corners(self) -> tuple[float, float]:
        """Positions along x of the corners of the catch's top."""
        first = self.foot + (self.crest - self.ground) / math.tan(self.angles[0])
        return first, first + self.top

    @property
    def end(self) -> float:
        """Position along x of the foot of the ramp on the way out."""
        return self.corners[1] + (self.crest - self.ground) / math.tan(self.angles[1])


def snap_hook(
    h: float, measures: SnapHook | None = None, *, comm: MPI.Comm = MPI.COMM_WORLD
) -> MeshData:
    """Mesh a hook and a catch with triangles (collective).

    The upper body (slave) is the hook, the lower one (master) the catch. The faces that are tagged:
    ``UPPER_CONTACT`` (the nose), ``UPPER_X0`` (the root), ``LOWER_CONTACT`` (ramps and top) and
    ``LOWER_BOTTOM``.

    Args:
        h: Cell size of the nose and of the catch's round corners, a length.
        measures: Of hook and catch; those of ``SnapHook()`` if None.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If h is not positive.
    """
    check_positive(h=h)
    m = SnapHook() if measures is None else measures

    def recipe(gmsh: ModuleType) -> None:
        t, r = m.thickness / 2, m.nose
        left, right, low = m.length - r, m.length + r, -m.depth - r
        beam = m.thickness / 3
        Outline(
            [(0, -t), (left, -t), (left, low), (right, low), (right, t), (0, t)],
            [0, 0, r, r, 0, 0],
            [None, Tag.UPPER_CONTACT, Tag.UPPER_CONTACT, Tag.UPPER_CONTACT, None, Tag.UPPER_X0],
            [beam, beam, h, h, beam, beam],
        ).add(gmsh, Tag.UPPER)
        a, b = m.corners
        Outline(
            [(m.foot, m.ground), (m.end, m.ground), (b, m.crest), (a, m.crest)],
            [0, 0, m.rounding, m.rounding],
            [Tag.LOWER_BOTTOM, Tag.LOWER_CONTACT, Tag.LOWER_CONTACT, Tag.LOWER_CONTACT],
            [0.3, 0.3, h, h],
        ).add(gmsh, Tag.LOWER)
        gmsh.model.mesh.generate(2)

    return build_mesh("snap_hook", 2, recipe, comm, POINT_SIZES)


def nose_path(
    measures: SnapHook, x: npt.NDArray[np.float64]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Path of the centre of the nose over a rigid catch.

    The catch, rounded, grown by the nose's radius is a trapezoid grown by the sum of both radii.

    Args:
        measures: Of hook and catch.
        x: Positions of the centre along x, shape (n,).

    Returns:
        Height of the centre above where it is without a catch, at least 0, and the slope of the
        path's height over x, each of shape (n,).
    """
    m = measures
    radius = m.rounding + m.nose
    a, b = m.corners
    # The rounded corners' centres
    left = a + m.rounding * math.tan(m.angles[0] / 2)
    right = b - m.rounding * math.tan(m.angles[1] / 2)
    level = m.crest - m.rounding
    begin, end = left - radius * math.sin(m.angles[0]), right + radius * math.sin(m.angles[1])
    up, down = math.tan(m.angles[0]), -math.tan(m.angles[1])
    height = np.full(len(x), level + radius)
    slope = np.zeros(len(x))
    for centre, inside in ((left, (x >= begin) & (x < left)), (right, (x > right) & (x <= end))):
        way = x[inside] - centre
        height[inside] = level + np.sqrt(radius**2 - way**2)
        slope[inside] = -way / np.sqrt(radius**2 - way**2)
    for place, tangent, inside in ((begin, up, x < begin), (end, down, x > end)):
        top = level + math.sqrt(radius**2 - (radius * math.sin(math.atan(tangent))) ** 2)
        height[inside] = top + tangent * (x[inside] - place)
        slope[inside] = tangent
    lift = height + m.depth
    return np.maximum(lift, 0.0), np.where(lift > 0, slope, 0.0)
