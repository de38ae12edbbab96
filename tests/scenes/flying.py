# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A block that flies and hits another one, or a rigid obstacle."""

from __future__ import annotations

from typing import Any

import numpy as np
from moving import SaintVenant

import contactx as cx
from contactx.obstacles import Obstacle
from dolfinx import mesh

import meshes
import story
from meshes import Tag
from scenes.blocks import dimension

# They meet within a time step: rounding must not tell in which
GAP, SPEED = 0.0135, 1.0


class Flying:
    """A block that comes down on a wider one, which flies, too, or on an obstacle.

    Attributes:
        contact: Its lower face on what is below it.
    """

    def __init__(
        self,
        cell_type: mesh.CellType,
        *,
        n: int = 3,
        obstacle: Obstacle | None = None,
        friction: Any = 0.0,
        tied: bool = False,
        method: str | None = None,
        degree: int = 1,
        dt: float = 0.01,
        young: float = 100.0,
        held: bool = False,
        aside: float = 0.3,
        **options: Any,
    ):
        """Set the problem up.

        Args:
            obstacle: What the block comes down on; another block if None.
        """
        gdim = dimension(cell_type)
        data = meshes.blocks(
            cell_type,
            (n,) * gdim,
            (2,) * gdim,
            size_lower=(1.5,) * (gdim - 1) + (1.0,),
            shift=(0.23,) * (gdim - 1),
            gap=0.0 if tied else GAP,
        )
        domain, tags = (
            (data.mesh, data.facet_tags) if obstacle is None else meshes.single(data, Tag.UPPER)
        )
        u = story.displacement(domain, degree)
        master = obstacle or cx.Surface(tags, Tag.LOWER_CONTACT)
        how = {} if method is None else {"method": method}
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT), master, friction=friction, tied=tied, **how
        )
        material = SaintVenant(u, young, 0.3)
        bcs = [story.fix(u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(gdim)] if held else []
        self.dynamics = cx.ContactDynamics(
            material.forces,
            u,
            density=1.0,
            contacts=[self.contact],
            petsc_options_prefix="flying_",
            strain_energy=material.energy,
            bcs=bcs,
            **options,
        )
        down = np.zeros(gdim)
        down[-1], down[0] = -SPEED, aside
        self.dynamics.velocity.interpolate(
            lambda x: np.where(x[gdim - 1] > GAP / 2 - tied, down[:, None], 0 * x[:gdim])
        )
        self.dynamics.dt = dt

    @property
    def energy(self) -> float:
        """Kinetic and strain energy now."""
        return self.dynamics.kinetic_energy() + (self.dynamics.strain_energy() or 0.0)
