# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes of several load steps."""

from __future__ import annotations

from typing import Any

import numpy as np
from plastic import Plastic

import contactx as cx
import ufl
from contactx.state import save_state
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import Blocks
from story import displacement, fix


class Sheared:
    """A neo-Hookean block on a rigid plane; its top moves down and far sideways.

    In one step its cells turn inside out, in a few it goes through; deeper than its height it does
    not.

    Attributes:
        calls: All t for which the loads were set.
        normal: Normal of the plane.
        history: What a material might remember.
    """

    def __init__(self, *, far: float = 3.0, deep: float = 0.5, **options: Any):
        data = meshes.blocks(CellType.triangle, (3, 3), (1, 1))
        mesh, tags = meshes.single(data, Tag.UPPER)
        self.u = u = displacement(mesh)
        F = ufl.Identity(2) + ufl.grad(u)
        J = ufl.det(F)
        energy = (0.5 * (ufl.tr(F.T * F) - 2 - 2 * ufl.ln(J)) + 0.75 * ufl.ln(J) ** 2) * ufl.dx
        self.far, self.deep = far, deep
        self.bcs = [
            fix(u, tags, 0, 0.0, Tag.UPPER_CONTACT),
            *(fix(u, tags, i, 0.0, Tag.UPPER_TOP) for i in range(2)),
        ]
        self.normal = fem.Constant(mesh, np.array([0.0, 1.0]))
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT), cx.Plane((0.0, 0.0), self.normal)
        )
        self.problem = cx.ContactProblem(
            ufl.derivative(energy, u),
            u,
            contacts=[self.contact],
            bcs=self.bcs,
            petsc_options_prefix="sheared_",
            petsc_options=options,
        )
        self.history = fem.Function(fem.functionspace(mesh, ("DG", 0)))
        self.calls: list[float] = []

    def update(self, t: float) -> None:
        self.calls.append(t)
        self.bcs[1].g.value[...] = self.far * t
        self.bcs[2].g.value[...] = -self.deep * t

    def state(self) -> list[bytes]:
        """Bits of what a failed step must leave alone."""
        interface, fields = self.contact.interface, self.contact.fields
        arrays = [self.u.x.array, self.history.x.array, *save_state(interface).values()]
        arrays += [
            interface.nodes.immobile,
            fields.force,
            fields.traction.x.array,
            fields.gap.x.array,
        ]
        return [array.tobytes() for array in arrays]

    def steps(self, steps: Any, **options: Any) -> cx.LoadSteps:
        options = {"history": [self.history], "progress": False, **options}
        return cx.LoadSteps(self.problem, steps, options.pop("update", self.update), **options)


class SlidingBlocks:
    """The two blocks, the upper one pressed and pushed over the edges of the lower one's facets."""

    def __init__(self, cell_type: CellType, **options: Any):
        scene = Blocks(cell_type, n_upper=3, n_lower=4)
        self.u = scene.u
        upper, lower = (cx.Surface(scene.tags, t) for t in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT))
        self.contact = cx.Contact(upper, lower, **options)
        self.problem = scene.problem(self.contact)
        self.history: list[fem.Function] = []
        self._down, self._side = scene.bcs[-1], scene.bcs[-2]

    def update(self, t: float) -> None:
        self._down.g.value[...] = -0.1 * t
        self._side.g.value[...] = 0.4 * t

    def commit(self) -> None:
        """There is no history."""


class LooseBlock:
    """The upper block lies on the lower one, which alone holds it, and is pressed by a load."""

    def __init__(self) -> None:
        scene = Blocks(CellType.quadrilateral, n_upper=3, n_lower=4)
        self.u, mesh = scene.u, scene.u.function_space.mesh
        v = ufl.TestFunction(self.u.function_space)
        self._load = fem.Constant(mesh, 0.0)
        ds = ufl.Measure("ds", mesh, subdomain_data=scene.tags)
        scene.F += self._load * v[1] * ds(Tag.UPPER_TOP)
        scene.bcs = scene.bcs[:2]
        self.contact = scene.contact("small")
        self.problem = scene.problem(self.contact)
        self.history: list[fem.Function] = []

    def update(self, t: float) -> None:
        self._load.value = 0.05 + 0.1 * t

    def commit(self) -> None:
        """There is no history."""


class DentedBlock:
    """A plastic block under a rigid ball that moves down, and up again, and sideways."""

    def __init__(self, aside: float = 0.1, **options: Any):
        self._aside = aside
        data = meshes.blocks(CellType.tetrahedron, (1, 1, 1), (4, 4, 4))
        mesh, tags = meshes.single(data, Tag.LOWER)
        self.u = displacement(mesh)
        self.material = Plastic(self.u)
        self.history = [self.material.plastic, self.material.equivalent]
        self._centre = fem.Constant(mesh, np.array([0.5, 0.5, 1.0]))
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.LOWER_CONTACT), cx.Sphere(self._centre, 1.0), **options
        )
        self.problem = cx.ContactProblem(
            self.material.F,
            self.u,
            contacts=[self.contact],
            bcs=[fix(self.u, tags, i, 0.0, Tag.LOWER_BOTTOM) for i in range(3)],
            petsc_options_prefix="dented_",
            petsc_options={"snes_linesearch_type": "bt"},
        )

    def update(self, t: float) -> None:
        self._centre.value[0] = 0.5 + self._aside * t
        self._centre.value[2] = 1 - 0.1 * min(t, 1.55 - t)

    def commit(self) -> None:
        """Take over the plastic strains."""
        self.material.commit()
