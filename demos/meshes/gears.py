# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Sectors of two involute gears that mesh."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from types import ModuleType

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_positive
from meshes.outline import POINT_SIZES, group
from meshes.tags import Tag

Points = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Gear:
    """A spur gear with involute teeth of module 1, whole depth 2.25.

    Attributes:
        teeth: Number of teeth.
        angle: Pressure angle, radians.
        thinner: What a tooth lacks at the pitch circle for backlash, a length.
        relief: What each flank of a tooth lacks at its tip, so that it does not enter with its
            edge, a length.
        relieved: Depth of that below the tip, a length.
    """

    teeth: int
    angle: float = math.radians(20)
    thinner: float = 0.03
    relief: float = 0.04
    relieved: float = 0.3

    @property
    def pitch(self) -> float:
        """Radius of the pitch circle."""
        return self.teeth / 2

    @property
    def base(self) -> float:
        """Radius of the base circle."""
        return self.pitch * math.cos(self.angle)

    @property
    def tip(self) -> float:
        """Radius of the tips."""
        return self.pitch + 1

    @property
    def root(self) -> float:
        """Radius between the teeth."""
        return self.pitch - 1.25

    @property
    def hub(self) -> float:
        """Radius of the hub."""
        return self.pitch - 3.5

    def half_angle(self, radius: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Half of the angle that a tooth takes up at radii, shape (n,)."""

        def involute(r: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
            a = np.arccos(np.minimum(self.base / r, 1))
            return np.asarray(np.tan(a) - a)

        at_pitch = (math.pi / 2 - self.thinner) / (2 * self.pitch)
        own = math.tan(self.angle) - self.angle
        near_tip = np.maximum(radius / self.tip - 1 + self.relieved / self.tip, 0)
        relief = self.relief / self.tip * (near_tip * self.tip / self.relieved) ** 2
        return np.asarray(at_pitch + own - involute(radius) - relief)

    def tooth(self, h: float, phi: float) -> Points:
        """Outline of a tooth, clockwise: from its root over the tip to its root, shape (n, 2).

        Args:
            h: Distance of points, about.
            phi: Angle of the tooth's middle, radians.
        """
        radii = np.linspace(self.root, self.tip, max(4, round(2.3 / h)) + 1)
        half = self.half_angle(radii)
        top = max(1, round(2 * half[-1] * self.tip / h))
        across = np.linspace(half[-1], -half[-1], top + 1)[1:-1]
        angles = phi + np.concatenate([half, across, -half[::-1]])
        r = np.concatenate([radii, np.full(len(across), self.tip), radii[::-1]])
        return np.stack([r * np.cos(angles), r * np.sin(angles)], axis=1)


def contact_ratio(first: Gear, second: Gear) -> float:
    """Mean number of pairs of teeth in contact of rigid gears."""
    path = sum(math.sqrt(g.tip**2 - g.base**2) for g in (first, second))
    path -= (first.pitch + second.pitch) * math.sin(first.angle)
    return path / (math.pi * math.cos(first.angle))


def gears(
    h: float,
    first: Gear,
    second: Gear,
    *,
    turn: float = 0.0,
    numbers: tuple[int, int] = (5, 4),
    comm: MPI.Comm = MPI.COMM_WORLD,
) -> MeshData:
    """Mesh sectors of two gears with triangles (collective).

    The upper body (slave) is the first gear about the origin, the lower one (master) the second
    gear about x = the sum of the pitch radii on the x-axis. The first gear's teeth touch those of
    the second counterclockwise. The faces that are tagged: ``UPPER_CONTACT`` and ``LOWER_CONTACT``
    (teeth and roots), ``UPPER_TOP`` and ``LOWER_BOTTOM`` (the hubs).

    Args:
        h: Cell size of the flanks, in modules.
        first: The first gear.
        second: The second gear.
        turn: Angle that the first gear is turned by from where a tooth is on the x-axis, radians.
        numbers: Numbers of teeth that are meshed.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, with the ``Tag`` of its bodies in ``cell_tags`` and of faces in ``facet_tags``.

    Raises:
        ValueError: If h is not positive or a number of teeth below one.
    """
    check_positive(h=h)
    check_divisions(first=numbers[0], second=numbers[1])
    # The second gear is turned back until the teeth touch
    back = (first.thinner + second.thinner) / 2 / second.pitch
    turn_second = math.pi - turn * first.teeth / second.teeth + back

    def recipe(gmsh: ModuleType) -> None:
        _add_sector(
            gmsh, h, first, turn, numbers[0], 0.0,
            (Tag.UPPER, Tag.UPPER_CONTACT, Tag.UPPER_TOP),
        )  # fmt: skip
        _add_sector(
            gmsh, h, second, turn_second, numbers[1], first.pitch + second.pitch,
            (Tag.LOWER, Tag.LOWER_CONTACT, Tag.LOWER_BOTTOM),
        )  # fmt: skip
        gmsh.model.mesh.generate(2)

    return build_mesh("gears", 2, recipe, comm, POINT_SIZES)


def _add_sector(
    gmsh: ModuleType,
    h: float,
    gear: Gear,
    turn: float,
    number: int,
    centre: float,
    tags: tuple[Tag, Tag, Tag],
) -> None:
    """Draw and tag a sector of a gear whose middle is at an angle."""
    pitch = 2 * math.pi / gear.teeth
    phis = turn + pitch * (np.arange(number)[::-1] - (number - 1) / 2)
    teeth = np.concatenate([gear.tooth(h, phi) for phi in phis])
    coarse = (gear.root - gear.hub) / 2.5
    geo = gmsh.model.geo
    chain = [geo.addPoint(centre + x, y, 0, 1.5 * h) for x, y in teeth]
    first, last = phis[0] + 0.5 * pitch, phis[-1] - 0.5 * pitch

    def point(r: float, phi: float, size: float) -> int:
        return int(geo.addPoint(centre + r * math.cos(phi), r * math.sin(phi), 0, size))

    begin, end = point(gear.root, first, 3 * h), point(gear.root, last, 3 * h)
    hub = [point(gear.hub, phi, coarse) for phi in np.linspace(last, first, 2 * number + 1)]
    outer = [begin, *chain, end]
    teeth_lines = [geo.addLine(a, b) for a, b in pairwise(outer)]
    hub_lines = [geo.addLine(a, b) for a, b in pairwise(hub)]
    sides = [geo.addLine(end, hub[0]), geo.addLine(hub[-1], begin)]
    loop = geo.addCurveLoop([*teeth_lines, sides[0], *hub_lines, sides[1]])
    surface = int(geo.addPlaneSurface([loop]))
    geo.synchronize()
    group(gmsh, surface, tags[0], {tags[1]: teeth_lines, tags[2]: hub_lines})
