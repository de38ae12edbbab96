# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem: an elastic sphere on an elastic block, in three dimensions."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.io.gmsh import MeshData

import meshes
import reference
from meshes import Tag
from scenes.blocks import NU
from scenes.materials import of_bodies
from scenes.problems import make_problem
from story import displacement, elasticity, fix


class HertzSphere:
    """The common Hertz problem with any displacement and a modulus for each body."""

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
        degree: int = 1,
        **options: Any,
    ):
        tags, u = data.facet_tags, displacement(data.mesh, degree)
        E = of_bodies(data, *_moduli(young))
        self._down = down
        self._top = fix(u, tags, 2, -down, Tag.UPPER_TOP)
        self.bcs = [
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
        self.F = elasticity(u, E, NU)
        self.problem = make_problem(self.F, u, [self.contact], self.bcs, **options)

    def update(self, t: float) -> None:
        """Move the top by a part of the displacement."""
        self._top.g.value[...] = -self._down * t


def hertz_sphere(h: float, sliding: str, **options: Any) -> tuple[cx.ContactProblem, cx.Contact]:
    """``HertzSphere`` on a new mesh."""
    scene = HertzSphere(meshes.hertz_sphere(h), sliding, **options)
    return scene.problem, scene.contact


def hertz_of(contact: cx.Contact, young: dict[Tag, float] | None = None) -> reference.HertzSphere:
    """Closed formula for the computed force of a quarter of the common Hertz problem."""
    upper, lower = _moduli(young)
    return reference.HertzSphere(
        force=4 * float(contact.force[2]),
        radius=1.0,
        modulus=reference.contact_modulus(upper, NU, lower, NU),
    )


def pressure_error(
    problem: cx.ContactProblem,
    contact: cx.Contact,
    young: dict[Tag, float] | None = None,
    pressure: npt.NDArray[np.float64] | None = None,
) -> float:
    """Relative L2 error of a Hertz sphere's nodal pressures, weighted by area.

    Nodes within 1.3 contact radii count; Hertz's pressure is that of the computed force.
    """
    hertz = hertz_of(contact, young)
    p = contact.multiplier if pressure is None else pressure
    x = problem.u.function_space.tabulate_dof_coordinates()[contact.slave_nodes]
    r = np.hypot(x[:, 0], x[:, 1])
    near = r <= 1.3 * hertz.contact_radius
    w, exact = contact.area[near], hertz.pressure(r[near])
    return float(np.sqrt(w @ (p[near] - exact) ** 2 / (w @ exact**2)))


def integrated_error(
    contact: cx.Contact, tags: mesh.MeshTags, young: dict[Tag, float] | None = None
) -> float:
    """Relative L2 error of a Hertz sphere's pressure, integrated over the slave's facets.

    What is within 1.3 contact radii counts; Hertz's pressure is that of the computed force.
    """
    hertz = hertz_of(contact, young)
    domain = contact.pressure.function_space.mesh
    x = ufl.SpatialCoordinate(domain)
    s = (x[0] ** 2 + x[1] ** 2) / hertz.contact_radius**2
    exact = hertz.peak_pressure * ufl.sqrt(ufl.max_value(1 - s, 0.0))
    near = ufl.conditional(s < 1.3**2, 1.0, 0.0)
    ds = ufl.Measure("ds", domain=domain, subdomain_data=tags, metadata={"quadrature_degree": 10})(
        int(Tag.UPPER_CONTACT)
    )
    squares = [
        fem.assemble_scalar(fem.form(near * f**2 * ds)) for f in (contact.pressure - exact, exact)
    ]
    return float(np.sqrt(squares[0] / squares[1]))


def _moduli(young: dict[Tag, float] | None) -> tuple[float, float]:
    """Young's moduli of the upper and of the lower body."""
    given = young or {}
    return given.get(Tag.UPPER, 1.0), given.get(Tag.LOWER, 1.0)
