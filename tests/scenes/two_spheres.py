# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two half spheres of one radius, one a hundred times stiffer, pressed together by a force.

Both diameters are 12.2474, so that 1/R = 2/6.1237. With E of 1e8 and 1e6, nu = 0.29 and
F = 117808.787 Hertz's formulas give the contact radius 0.63018 and the peak pressure 1.41642e5.

The soft sphere is strained by 14 %. Hertz's theory is linear: it tells neither current from
reference area nor where a node is from where it was. What is measured on the soft sphere, or in
small sliding, agrees with it. In finite sliding with the stiff sphere as the slave area and radius
are current ones: by an axisymmetric model the radius is 2.4 % below Hertz's and the
peak pressure 5 % above.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from dolfinx.io.gmsh import MeshData

import meshes
import reference
from meshes import Tag
from scenes.materials import of_bodies
from scenes.problems import make_problem, pair_of
from story import displacement, elasticity, fix

Array = npt.NDArray[np.float64]
RADIUS = 12.2474 / 2
STIFF, SOFT, NU = 1e8, 1e6, 0.29
FORCE = 117808.787
HERTZ = reference.HertzSphere(
    force=FORCE,
    radius=RADIUS / 2,
    modulus=reference.contact_modulus(STIFF, NU, SOFT, NU),
)
ZONE = 1.3 * HERTZ.contact_radius
# Relative error of the force at which the secants end, and how many there are at most
TOLERANCE = 1e-4
MOST_TRIES = 8


def mesh(h: float, slave: str) -> MeshData:
    """Mesh the spheres, the upper one for the slave.

    The soft body has the finer cells: a multiplier on cells finer than those that yield to it
    is not determined well.

    Args:
        h: Cell size of the soft sphere in the contact; those of the stiff one are 1.5 times larger.
    """
    sizes = (h, 1.5 * h) if slave == "soft" else (1.5 * h, h)
    return meshes.half_spheres(RADIUS, *sizes, zone=ZONE)


class TwoSpheres:
    """The spheres, with the upper one as the slave; its flat face moves down."""

    def __init__(self, data: MeshData, *, slave: str, sliding: str, method: str):
        tags, u = data.facet_tags, displacement(data.mesh)
        E = of_bodies(data, *((SOFT, STIFF) if slave == "soft" else (STIFF, SOFT)))
        self._top = fix(u, tags, 2, 0.0, Tag.UPPER_TOP)
        bcs = [
            fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
            fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
            fix(u, tags, 2, 0.0, Tag.LOWER_BOTTOM),
            self._top,
        ]
        self.contact = pair_of(tags, sliding=sliding, method=method, search_distance=RADIUS / 10)
        self.problem = make_problem(elasticity(u, E, NU), u, [self.contact], bcs)
        self.iterations: list[int] = []

    @property
    def force(self) -> float:
        """Force of the whole spheres."""
        return 4 * float(self.contact.force[2])

    def press(self) -> None:
        """Find the displacement that gives the force, from Hertz's approach on by secants."""
        down, before = HERTZ.approach, (0.0, 0.0)
        for _ in range(MOST_TRIES):
            self._top.g.value[...] = -down
            self.problem.solve()
            self.iterations.append(self.problem.report.iterations)
            if abs(self.force / FORCE - 1) <= TOLERANCE:
                return
            # Hertz's approach is the power 2/3 of the force
            now = (down, self.force ** (2 / 3))
            slope = (now[0] - before[0]) / (now[1] - before[1])
            down, before = down + slope * (FORCE ** (2 / 3) - now[1]), now
        raise RuntimeError(f"no displacement in {MOST_TRIES} tries gives the force {FORCE}")

    def errors(self, pressure: Array) -> tuple[float, float]:
        """Relative errors of contact radius and peak pressure.

        Hertz's mean distance from the axis, weighted by the pressure, is 3 pi/16 of the radius. As
        in his theory it is that of the undeformed bodies.
        """
        x = self.problem.u.function_space.tabulate_dof_coordinates()[self.contact.slave_nodes]
        forces = self.contact.area * pressure
        radius = 16 / (3 * np.pi) * (forces @ np.hypot(x[:, 0], x[:, 1])) / forces.sum()
        return (
            float(radius / HERTZ.contact_radius - 1),
            float(pressure.max() / HERTZ.peak_pressure - 1),
        )
