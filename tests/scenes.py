# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes that several tests use."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
from contactx.obstacles import Obstacle
from dolfinx import fem, mesh
from dolfinx.io.gmsh import MeshData

import meshes
import reference
from meshes import Tag
from story import displacement, elasticity, fix

NU = 0.3


class HertzSphere:
    """The common Hertz problem with any displacement and a modulus for each body.

    Attributes:
        problem: The problem.
        contact: Its contact.
    """

    def __init__(
        self,
        data: MeshData,
        sliding: str,
        *,
        down: float = 0.02,
        young: dict[Tag, float] | None = None,
        friction: Any = 0.0,
        search_distance: float | None = None,
        swapped: bool = False,
        method: str | None = None,
        **options: Any,
    ):
        """Set the problem up.

        Args:
            data: Mesh.
            sliding: "finite" or "small".
            down: Displacement of the top.
            young: Young's modulus of each body; 1 where it is not given.
            friction: Coefficient.
            search_distance: That of the contact.
            swapped: Whether the block is the slave.
            method: That of the contact; the default one if None.
            options: Those of the problem.
        """
        tags, u = data.facet_tags, displacement(data.mesh)
        E = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
        E.x.array[:] = 1
        for body, value in (young or {}).items():
            E.x.array[data.cell_tags.find(body)] = value
        self._down = down
        self._top = fix(u, tags, 2, -down, Tag.UPPER_TOP)
        bcs = [
            fix(u, tags, 0, 0.0, Tag.UPPER_X0, Tag.LOWER_X0),
            fix(u, tags, 1, 0.0, Tag.UPPER_Y0, Tag.LOWER_Y0),
            *(fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)),
            self._top,
        ]
        sides = [cx.Surface(tags, side) for side in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)]
        self.contact = cx.Contact(
            *(sides[::-1] if swapped else sides),
            sliding=sliding,
            friction=friction,
            search_distance=search_distance,
            **({} if method is None else {"method": method}),
        )
        self.problem = cx.ContactProblem(
            elasticity(u, E, NU),
            u,
            contacts=[self.contact],
            bcs=bcs,
            petsc_options_prefix="sphere_",
            **options,
        )

    def update(self, t: float) -> None:
        """Move the top by a part of the displacement."""
        self._top.g.value[...] = -self._down * t


def hertz_sphere(h: float, sliding: str, **options: Any) -> tuple[cx.ContactProblem, cx.Contact]:
    """``HertzSphere`` on a new mesh."""
    scene = HertzSphere(meshes.hertz_sphere(h), sliding, **options)
    return scene.problem, scene.contact


def hertz_of(contact: cx.Contact, young: dict[Tag, float] | None = None) -> reference.HertzSphere:
    """Closed formula for the computed force of a quarter of the common Hertz problem."""
    E = {Tag.UPPER: 1.0, Tag.LOWER: 1.0, **(young or {})}
    return reference.HertzSphere(
        force=4 * float(contact.force[2]),
        radius=1.0,
        modulus=reference.contact_modulus(E[Tag.UPPER], NU, E[Tag.LOWER], NU),
    )


def pressure_error(
    problem: cx.ContactProblem,
    contact: cx.Contact,
    young: dict[Tag, float] | None = None,
    pressure: npt.NDArray[np.float64] | None = None,
) -> float:
    """Relative L2 error of a Hertz sphere's nodal pressures, weighted by area.

    Nodes within 1.3 contact radii count; Hertz's pressure is that of the computed force.

    Args:
        problem: The solved problem.
        contact: Its contact.
        young: Young's modulus of each body; 1 where it is not given.
        pressure: Pressures of the slave nodes, shape (n,); the raw ones if None.
    """
    hertz = hertz_of(contact, young)
    p = contact.multiplier if pressure is None else pressure
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    r = np.hypot(x[:, 0], x[:, 1])
    near = r <= 1.3 * hertz.contact_radius
    w, exact = contact.area[near], hertz.pressure(r[near])
    return float(np.sqrt(w @ (p[near] - exact) ** 2 / (w @ exact**2)))


class Blocks:
    """An upper block pressed on a wider lower one that it does not match.

    Attributes:
        u: Displacement.
        F: Residual.
        bcs: The lower block's bottom is fixed, the upper one's top moves down and not sideways.
        tags: Facet tags.
    """

    def __init__(
        self,
        cell_type: mesh.CellType,
        *,
        down: float = 0.05,
        gap: float = 0.0,
        n_upper: int = 2,
        n_lower: int = 3,
    ):
        plane = cell_type in (mesh.CellType.triangle, mesh.CellType.quadrilateral)
        gdim = 2 if plane else 3
        data = meshes.blocks(
            cell_type,
            (n_upper,) * gdim,
            (n_lower,) * gdim,
            size_lower=(1.5,) * (gdim - 1) + (1.0,),
            shift=(0.23,) * (gdim - 1),
            gap=gap,
        )
        self.tags = data.facet_tags
        self.u = displacement(data.mesh)
        self.F = elasticity(self.u, 1.0, NU)
        self.bcs = [
            *(fix(self.u, self.tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim)),
            *(fix(self.u, self.tags, i, 0.0, Tag.UPPER_TOP) for i in range(gdim - 1)),
            fix(self.u, self.tags, gdim - 1, -down, Tag.UPPER_TOP),
        ]

    def contact(
        self, sliding: str = "finite", *, master: Obstacle | None = None, **options: Any
    ) -> cx.Contact:
        return cx.Contact(
            cx.Surface(self.tags, Tag.UPPER_CONTACT),
            master or cx.Surface(self.tags, Tag.LOWER_CONTACT),
            sliding=sliding,
            **options,
        )

    def problem(self, *contacts: cx.Contact, **options: Any) -> cx.ContactProblem:
        return cx.ContactProblem(
            self.F,
            self.u,
            contacts=contacts,
            bcs=self.bcs,
            petsc_options_prefix="blocks_",
            **options,
        )
