# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks, the upper one pressed on the lower one: the scene that most families vary."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes import dimension, transforms
from scenes.materials import neo_hookean, of_bodies
from scenes.supports import DrivenFaces
from story import elasticity
from stress.degree import DEGREE
from stress.scene import Case

# How far a node may lie in the other body where pairs are exact, and where gaps are means
INTO = {"node-to-surface": 0.02, "surface-to-surface": 0.05}


def bulk(u: fem.Function, young: Any, nu: Any, material: str) -> ufl.Form:
    """Residual of a "linear" or a "neo-hooke" material, in plane strain where the mesh is plane."""
    return {"linear": elasticity, "neo-hooke": neo_hookean}[material](u, young, nu)


def _shuffled(data: Any, seed: int) -> SimpleNamespace:
    """The same mesh with other numbers."""
    other = transforms.renumbered(transforms.numbered(data), seed)
    domain, dim = other.domain, other.domain.geometry.dim
    # The blocks lie on both sides of height zero
    height = domain.geometry.x[domain.geometry.dofmaps[0], dim - 1].mean(axis=1)
    bodies = np.where(height > 0, Tag.UPPER, Tag.LOWER).astype(np.int32)
    cells = np.arange(len(height), dtype=np.int32)
    return SimpleNamespace(
        mesh=domain,
        facet_tags=other.tags,
        cell_tags=mesh.meshtags(domain, domain.topology.dim, cells, bodies),
    )


@dataclass
class Blocks:
    """Two blocks; the lower one's bottom is held, the upper one's top is moved.

    Lengths are relative to ``length``. The last axis is the height before the scene is turned.

    Attributes:
        cell: Kind of the cells.
        n_upper: Cells of the upper block, along the surface and in height.
        n_lower: The same for the lower block.
        size_upper: Size of the upper block, along the surface and in height.
        size_lower: The same for the lower block.
        shift: How far the upper block begins behind the lower one.
        gap: Initial gap.
        radius: Radius of the upper block's bottom; flat if None.
        young: Young's moduli of the upper and of the lower block.
        nu: Poisson's ratios.
        friction: Coefficient.
        method: Method of the contact.
        sliding: Its kinematics.
        material: "linear" or "neo-hooke".
        down: How far the top moves down.
        side: How far it moves along the first axis.
        swapped: Whether the lower block is the slave.
        noise: How far inner nodes are moved at random, in cells.
        length: Unit of length.
        modulus: Unit of modulus.
        turn: Seed of a random rotation; not turned if None.
        away: Distance by which the scene is moved, in a random direction.
        shuffle: Seed that numbers nodes and cells anew; as gmsh does if None.
        steps: Load steps.
        options: PETSc's options.
    """

    cell: CellType = CellType.quadrilateral
    n_upper: Sequence[int] = (3, 2)
    n_lower: Sequence[int] = (5, 2)
    size_upper: Sequence[float] = (1.0, 1.0)
    size_lower: Sequence[float] = (1.5, 1.0)
    shift: float = 0.23
    gap: float = 0.0
    radius: float | None = None
    young: Sequence[float] = (1.0, 1.0)
    nu: Sequence[float] = (0.3, 0.3)
    friction: float = 0.0
    method: str = "node-to-surface"
    sliding: str = "finite"
    material: str = "linear"
    down: float = 0.05
    side: float = 0.0
    swapped: bool = False
    noise: float = 0.0
    length: float = 1.0
    modulus: float = 1.0
    turn: int | None = None
    away: float = 0.0
    shuffle: int | None = None
    steps: Any = 1
    options: dict[str, Any] | None = None

    def case(self) -> Case:
        """Make the problem."""
        data = self.data = self._mesh()
        domain, tags = data.mesh, data.facet_tags
        dim = domain.geometry.dim
        rng = np.random.default_rng(self.turn or 0)
        Q = np.eye(dim) if self.turn is None else transforms.rotation(rng, dim)
        direction = rng.standard_normal(dim)
        where = self.away * direction / np.linalg.norm(direction)
        self.x0 = domain.geometry.x[:, :dim].copy()
        domain.geometry.x[:, :dim] = self.length * (self.x0 @ Q.T + where)
        self.Q = Q

        self.u = u = fem.Function(fem.functionspace(domain, ("Lagrange", DEGREE, (dim,))))
        E = of_bodies(data, *(self.modulus * y for y in self.young))
        F = bulk(u, E, of_bodies(data, *self.nu), self.material)
        bottom, top = (DrivenFaces(u, tags, face) for face in (Tag.LOWER_BOTTOM, Tag.UPPER_TOP))
        bcs = [bottom.bc, top.bc]
        motion = np.zeros(dim)
        motion[0], motion[-1] = self.side, -self.down
        motion = self.length * Q @ motion

        def update(t: float) -> None:
            top.move(t * motion)

        sides = [cx.Surface(tags, t) for t in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)]
        self.contact = cx.Contact(
            *(sides[::-1] if self.swapped else sides),
            friction=self.friction,
            method=self.method,
            sliding=self.sliding,
        )
        problem = cx.ContactProblem(
            F,
            u,
            contacts=[self.contact],
            bcs=bcs,
            petsc_options_prefix="stress_",
            petsc_options=self.options,
        )
        return Case(
            problem,
            [self.contact],
            F,
            bcs,
            update,
            size=self.length * min(*self.size_upper, *self.size_lower),
            modulus=self.modulus * min(self.young),
            steps=self.steps,
            into=[INTO[self.method] if self.sliding == "finite" else None],
            swapped=lambda: self.swap().case(),
        )

    def swap(self) -> Blocks:
        """The same with slave and master swapped."""
        other = copy(self)
        other.swapped = not self.swapped
        return other

    def _mesh(self) -> Any:
        dim = dimension(self.cell)

        def spread(pair: Sequence[Any]) -> list[Any]:
            return [pair[0]] * (dim - 1) + [pair[1]]

        data = meshes.blocks(
            self.cell,
            spread(self.n_upper),
            spread(self.n_lower),
            size_upper=spread(self.size_upper),
            size_lower=spread(self.size_lower),
            shift=[self.shift] * (dim - 1),
            gap=self.gap,
            radius=self.radius,
        )
        if self.noise > 0:
            self._shake(data.mesh)
        if self.shuffle is not None:
            return _shuffled(data, self.shuffle)
        return data

    def _shake(self, domain: mesh.Mesh) -> None:
        """Move the nodes that are not on the boundary at random, and those of faces along them."""
        rng = np.random.default_rng(0)
        x, dim = domain.geometry.x, domain.geometry.dim
        cells = np.concatenate(domain.geometry.dofmaps[0])
        width = np.ptp(x[cells.reshape(len(domain.geometry.dofmaps[0]), -1)], axis=1).min(axis=0)
        low_high = []
        for body in (x[:, dim - 1] >= 0, x[:, dim - 1] < 0):
            low_high.append((body, x[body].min(axis=0), x[body].max(axis=0)))
        move = self.noise * width * rng.uniform(-1, 1, x.shape)
        for body, low, high in low_high:
            near = 1e-9 * np.ptp(x)
            on_face = (np.abs(x - low) < near) | (np.abs(x - high) < near)
            x[body] += np.where(on_face, 0.0, move)[body]
