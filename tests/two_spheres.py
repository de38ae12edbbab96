# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two half spheres of one radius, one a hundred times stiffer, pressed together by a force.

Both diameters are 12.2474, so that 1/R = 2/6.1237. With E of 1e8 and 1e6, nu = 0.29 and
F = 117808.787 Hertz's formulas give the contact radius 0.63018 and the peak pressure 1.41642e5.
"""

from __future__ import annotations

import numpy as np
from story import displacement, elasticity, fix

import contactx as cx
from contactx import meshes, reference
from contactx.meshes import Tag
from dolfinx import fem
from dolfinx.io.gmsh import MeshData

RADIUS = 12.2474 / 2
STIFF, SOFT, NU = 1e8, 1e6, 0.29
FORCE = 117808.787
HERTZ = reference.HertzSphere(
    force=FORCE,
    radius=RADIUS / 2,
    modulus=reference.contact_modulus(STIFF, NU, SOFT, NU),
)
ZONE = 1.3 * HERTZ.contact_radius
# Relative error of the force at which the secants end
TOLERANCE = 1e-4


def mesh(h: float, h_master: float | None = None) -> MeshData:
    """The spheres with cells of a size in the contact."""
    return meshes.half_spheres(RADIUS, h, h_master, zone=ZONE)


class TwoSpheres:
    """The spheres, with the upper one as the slave; its flat face moves down.

    Attributes:
        problem: The problem.
        contact: Its contact.
        iterations: Of each solve.
    """

    def __init__(self, data: MeshData, *, slave: str, sliding: str, method: str):
        """Set the problem up.

        Args:
            data: The mesh.
            slave: "soft" or "stiff".
            sliding: "finite" or "small".
            method: Method of the contact.
        """
        tags, u = data.facet_tags, displacement(data.mesh)
        E = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
        upper, lower = (SOFT, STIFF) if slave == "soft" else (STIFF, SOFT)
        E.x.array[data.cell_tags.find(Tag.UPPER)] = upper
        E.x.array[data.cell_tags.find(Tag.LOWER)] = lower
        self._top = fix(u, tags, 2, 0.0, Tag.UPPER_TOP)
        bcs = [
            fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
            fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
            fix(u, tags, 2, 0.0, Tag.LOWER_BOTTOM),
            self._top,
        ]
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Surface(tags, Tag.LOWER_CONTACT),
            sliding=sliding,
            method=method,
            search_distance=RADIUS / 10,
        )
        self.problem = cx.ContactProblem(
            elasticity(u, E, NU),
            u,
            contacts=[self.contact],
            bcs=bcs,
            petsc_options_prefix="spheres_",
        )
        self.iterations: list[int] = []

    @property
    def force(self) -> float:
        """Force of the whole spheres."""
        return 4 * float(self.contact.force[2])

    def press(self) -> None:
        """Find the displacement that gives the force, from Hertz's approach on by secants."""
        path = [(0.0, 0.0)]
        down = HERTZ.approach
        while abs(path[-1][1] / FORCE - 1) > TOLERANCE:
            self._top.g.value[...] = -down
            self.problem.solve()
            self.iterations.append(self.problem.report.iterations)
            # Hertz's force is the power 3/2 of the approach
            path.append((down, self.force ** (2 / 3)))
            (d_0, f_0), (d_1, f_1) = path[-2:]
            down = d_1 + (FORCE ** (2 / 3) - f_1) * (d_1 - d_0) / (f_1 - f_0)
            path[-1] = (d_1, self.force ** (2 / 3))
            if len(path) > 8:
                raise RuntimeError(f"no displacement gives the force: {path}")
            if abs(self.force / FORCE - 1) <= TOLERANCE:
                return


def errors(contact: cx.Contact, x: np.ndarray, p: np.ndarray) -> dict[str, float]:
    """Relative errors of contact radius and peak pressure.

    Args:
        contact: The contact.
        x: Positions of its slave nodes, shape (n, 3).
        p: Their pressures, shape (n,).
    """
    w, r = contact.area * p, np.hypot(x[:, 0], x[:, 1])
    radius = 16 / (3 * np.pi) * (w @ r) / w.sum()
    return {
        "a_err": float(radius / HERTZ.contact_radius - 1),
        "p0_err": float(p.max() / HERTZ.peak_pressure - 1),
    }
