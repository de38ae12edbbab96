# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The face of a rockfill dam as a contact problem: bodies, supports, loads, contacts, stages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from hexahedra import elasticity, isotropic, strain

import contactx as cx
import ufl
from dolfinx import fem, la, mesh

from duncan_chang import DuncanChang, Rockfill
from meshes import DamFace, block_tag, dam_face
from slab_scene import CONCRETE, CUSHION, NU, Array
from story import METHODS, displacement

NU_ROCKFILL = 0.3
# Weight for each unit of volume, MN/m^3
WATER, WEIGHT = 9.81e-3, 24.5e-3
# Slabs are held by friction alone
FACTOR = 0.05
Nodes = npt.NDArray[np.int32]


@dataclass(frozen=True)
class DamSetting:
    """What a run of the dam takes. Lengths are in metres, stresses in MPa.

    Attributes:
        model: Measures and cells.
        rockfill: Young's modulus of the rockfill, with that of the cushion zone by itself, or the
            parameters of the E-B model of both.
        joint_friction: Coulomb's coefficient between slabs.
        cushion_friction: Coulomb's coefficient between slabs and cushion.
        clearance: Opening of the joints as they are built.
        level: Height of the full reservoir above the river bed, part of the dam's height.
        creep: Strain of the rockfill at the ends of the dam that creep adds after impounding.
        options: PETSc options.
    """

    model: DamFace = field(default_factory=DamFace)
    rockfill: float | DuncanChang = 80.0
    joint_friction: float = 0.75
    cushion_friction: float = 0.7
    clearance: float = 0.0
    level: float = 0.97
    creep: float = 5e-4
    options: tuple[tuple[str, Any], ...] = ()


class Dam:
    """Slabs, each a body of its own, on a dam of rockfill in a valley.

    Attributes:
        setting: Setting.
        x: Reference positions of the nodes along the dam, up the slope and off the face, m.
        u: Displacement, m.
        weight: Part of the slabs' weight that acts; a constant.
        level: Height of the water above the river bed, m; a constant.
        creep: Part of the creep strain; a constant.
        cushion: Contact of rockfill and slabs.
        joints: Contacts of neighbouring slabs, along x.
        increments: Stress of the rockfill where it follows the E-B model; else None.
        problem: The problem.
    """

    def __init__(self, setting: DamSetting):
        """Set the problem up (collective).

        Args:
            setting: Setting.
        """
        self.setting = setting
        self.model = setting.model
        data = dam_face(setting.model)
        self.mesh = data.mesh
        self.tags = data.facet_tags
        self.bodies = data.cell_tags
        self.u = displacement(self.mesh)
        self.x = self.u.function_space.tabulate_dof_coordinates()
        self.weight, self.creep = (fem.Constant(self.mesh, 0.0) for _ in range(2))
        self.level = fem.Constant(self.mesh, 0.0)
        self.young, self.nu = self._moduli()
        self.increments: Rockfill | None = None
        loads = self._loads()
        self._load_form = fem.form(loads)
        F = self._bodies() + loads
        self.cushion, self.joints = self._contacts()
        self.problem = cx.ContactProblem(
            F,
            self.u,
            contacts=[self.cushion, *self.joints],
            bcs=self._supports(),
            petsc_options_prefix="dam_face_",
            petsc_options=dict(setting.options),
        )

    def _moduli(self) -> tuple[fem.Function, fem.Function]:
        """Young's modulus, MPa, and Poisson's ratio of all cells."""
        Q = fem.functionspace(self.mesh, ("DG", 0))
        young, nu = fem.Function(Q), fem.Function(Q)
        self.is_rockfill = fem.Function(Q)
        young.x.array[:], nu.x.array[:] = CONCRETE, NU
        rockfill = self.bodies.find(block_tag(0))
        middles = mesh.compute_midpoints(self.mesh, 3, rockfill)
        self.is_rockfill.x.array[rockfill] = 1
        is_cushion = self.model.depth(middles) < self.model.cushion
        if not isinstance(self.setting.rockfill, DuncanChang):
            young.x.array[rockfill] = np.where(is_cushion, CUSHION, self.setting.rockfill)
            nu.x.array[rockfill] = NU_ROCKFILL
        return young, nu

    def _bodies(self) -> ufl.Form:
        """Residual of the slabs and of the rockfill."""
        if not isinstance(self.setting.rockfill, DuncanChang):
            v = ufl.TestFunction(self.u.function_space)
            crept = self.creep * isotropic(self._creep_strain(), self.young, self.nu)
            creep = self.is_rockfill * ufl.inner(crept, strain(v)) * ufl.dx
            return elasticity(self.u, self.young, self.nu) - creep
        cells = self.mesh.topology.index_map(3)
        every = np.arange(cells.size_local + cells.num_ghosts, dtype=np.int32)
        depth = self.model.overburden(mesh.compute_midpoints(self.mesh, 3, every))
        self.increments = Rockfill(
            self.setting.rockfill,
            self.u,
            self.is_rockfill,
            self.setting.rockfill.unit_weight * depth,
            self.model.up,
            self.young,
            self.nu,
            self.creep,
            self._creep_strain(),
        )
        slabs = elasticity(self.u, (1 - self.is_rockfill) * self.young, self.nu)
        return slabs + self.increments.residual()

    def _loads(self) -> ufl.Form:
        """Residual of the slabs' weight and of the water on their tops."""
        v = ufl.TestFunction(self.u.function_space)
        up = ufl.as_vector(tuple(float(a) for a in self.model.up))
        tops = tuple(block_tag(i, "top") for i in self.slabs)
        ds = ufl.Measure("ds", domain=self.mesh, subdomain_data=self.tags)
        form = self.weight * WEIGHT * (1 - self.is_rockfill) * ufl.dot(up, v) * ufl.dx
        # The pressure has a kink at the water's level
        on_tops = ds(tops, metadata={"quadrature_degree": 4})
        return form + self.pressure() * ufl.dot(ufl.FacetNormal(self.mesh), v) * on_tops

    def loads_on_nodes(self) -> Array:
        """Forces of weight and water on the nodes of this rank, MN, shape (num_owned, 3).

        All ranks must take part.
        """
        b = fem.assemble_vector(self._load_form)
        b.scatter_reverse(la.InsertMode.add)
        n = self.u.function_space.dofmap.index_map.size_local
        return np.asarray(-b.array[: 3 * n].reshape(-1, 3))

    def water_at(self, elevation: float) -> float:
        """Pressure of the water at a height above the river bed, MPa."""
        return WATER * max(float(self.level.value) - elevation, 0.0)

    def pressure(self) -> Any:
        """Pressure of the water by the reference place, MPa, in UFL."""
        up = ufl.as_vector(tuple(float(a) for a in self.model.up))
        depth = self.level - ufl.dot(up, ufl.SpatialCoordinate(self.mesh))
        return WATER * ufl.max_value(depth, 0.0)

    def _creep_strain(self) -> Any:
        """Strain of the rockfill along the dam that moves it to the middle, in UFL.

        The displacement by itself is proportional to xi^3 - xi, xi being -1 and 1 at the ends.
        """
        xi = 2 * ufl.SpatialCoordinate(self.mesh)[0] / self.model.length
        along = ufl.as_vector((1.0, 0.0, 0.0))
        return self.setting.creep / 2 * (3 * xi**2 - 1) * ufl.outer(along, along)

    def _supports(self) -> list[fem.DirichletBC]:
        """Rock holds the rockfill, the plinth the slabs' lower ends along the slope."""
        V = self.u.function_space
        rock = np.concatenate([self.tags.find(block_tag(0, side)) for side in ("y0", "x0", "x1")])
        plinth = np.concatenate([self.tags.find(block_tag(i, "y0")) for i in self.slabs])
        fixed = fem.locate_dofs_topological(V, 2, rock)
        held = fem.locate_dofs_topological(V.sub(1), 2, plinth)
        return [
            fem.dirichletbc(np.zeros(3), fixed, V),
            fem.dirichletbc(np.float64(0.0), held, V.sub(1)),
        ]

    def _contacts(self) -> tuple[cx.Contact, list[cx.Contact]]:
        """Contact of rockfill and slabs, and of neighbouring slabs."""
        s, tags = self.setting, self.tags
        cushion = cx.Contact(
            slave=cx.Surface(tags, block_tag(0, "top")),
            master=cx.Surface(tags, *(block_tag(i, "bottom") for i in self.slabs)),
            friction=s.cushion_friction,
            sliding="small",
            tangential_factor=FACTOR,
            method=METHODS[1],
        )
        joints = [
            cx.Contact(
                slave=cx.Surface(tags, block_tag(i, "x1")),
                master=cx.Surface(tags, block_tag(i + 1, "x0")),
                friction=s.joint_friction,
                sliding="small",
                offset=-s.clearance,
                tangential_factor=FACTOR,
            )
            for i in list(self.slabs)[:-1]
        ]
        return cushion, joints

    @property
    def slabs(self) -> range:
        """Numbers of the slabs."""
        return range(1, 1 + self.model.slabs)

    def nodes_of(self, body: int) -> Nodes:
        """Nodes of a body: 0 is the rockfill, 1, 2, ... are the slabs."""
        cells = self.bodies.find(block_tag(body))
        return np.unique(self.u.function_space.dofmap.list[cells])

    def nodes_on(self, body: int, side: str) -> Nodes:
        """Nodes of a body's face."""
        return cx.Surface(self.tags, block_tag(body, side)).nodes(self.u.function_space)

    def update(self, t: float, stages: int) -> None:
        """Set the loads of a stage: weight at 1, then the water, then creep.

        The slabs are cast one after the other, so that their weight does not press them together:
        joints act from the first water on.

        Args:
            t: Number of the stage, which may be broken.
            stages: Number of stages of the water.
        """
        for joint in self.joints:
            joint.active = t > 1
        self.weight.value = min(t, 1.0)
        self.level.value = self.setting.level * self.model.height * np.clip((t - 1) / stages, 0, 1)
        self.creep.value = max(t - 1 - stages, 0.0)


def run(
    dam: Dam,
    stages: int,
    *,
    creep: bool = True,
    each: Callable[[Dam, cx.Step], object] = lambda dam, step: None,
    progress: bool = True,
    checkpoint: str | Path | None = None,
    restart: str | Path | None = None,
) -> None:
    """Load a dam by weight, water and creep (collective).

    Args:
        dam: The dam.
        stages: Stages of the water.
        creep: Whether creep follows.
        each: Called after each stage.
        progress: Whether to show a progress bar and the table of stages.
        checkpoint: File to write after each stage.
        restart: File to go on from.
    """
    count = 1 + stages + creep
    steps = cx.LoadSteps(
        dam.problem,
        count,
        t_end=float(count),
        update=lambda t: dam.update(t, stages),
        history=dam.increments.history if dam.increments else (),
        progress=progress,
        checkpoint=checkpoint,
        restart=restart,
    )
    for step in steps:
        if dam.increments:
            dam.increments.commit()
        each(dam, step)
