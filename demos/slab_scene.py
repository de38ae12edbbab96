# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Face slabs on their cushion as a contact problem: bodies, supports, loads, contacts, results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from hexahedra import NodalStress, elasticity, stress

import contactx as cx
import ufl
from dolfinx import fem

from meshes import FaceSlab, block_tag, face_slab
from story import METHODS, displacement

CONCRETE, CUSHION, NU = 30_000.0, 144.0, 0.2  # MPa
Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Setting:
    """What is the same in both schemes. Lengths are in metres, stresses in MPa.

    Attributes:
        model: Measures and cells.
        joint_friction: Coulomb's coefficient between slabs.
        cushion_friction: Coulomb's coefficient between slabs and cushion.
        sliding: Kinematics of contact.
        method: Method of contact.
        cushion_is_slave: Whether the cushion's nodes are the slaves, not the slabs'.
        support: Exponent and base of the support's softness (1 - |x| / W)^exponent + base, W being
            half the width of the row.
        axes: Which coordinate is along the dam, up the slope, and normal to the face.
        options: PETSc options.
    """

    model: FaceSlab
    joint_friction: float = 0.75
    cushion_friction: float = 0.7
    sliding: str = "small"
    method: str = METHODS[0]
    cushion_is_slave: bool = True
    support: tuple[float, float] = (2.5, 0.055)
    axes: tuple[int, int, int] = (0, 1, 2)
    options: tuple[tuple[str, Any], ...] = ()


class Scene:
    """Slabs on a cushion whose bottom rests on springs, or is fixed along its normal.

    Attributes:
        setting: Setting.
        x: Reference positions of the nodes along dam, slope and normal, m, shape (num_nodes, 3).
        u: Displacement, m.
        pressure: Water pressure on the slabs' tops, MPa; a constant that may change.
        compliance: Settlement of the springs below x = 0 for a pressure of one, m/MPa; a constant.
        push: Displacement of each side of the cushion towards the middle, m.
        cushion_contacts: Contacts of slabs and cushion.
        joints: Contacts of neighbouring slabs, along x.
        problem: The problem.
        sigma: Stress along the dam at the nodes, tension positive, MPa.
    """

    def __init__(self, setting: Setting, springs: bool):
        """Set the problem up.

        Args:
            setting: Setting.
            springs: Whether the cushion's bottom rests on springs.
        """
        self.setting = setting
        self.model = model = setting.model
        data = face_slab(model)
        domain = self.mesh = data.mesh
        self.tags = data.facet_tags
        axes = list(setting.axes)
        straight = domain.geometry.x.copy()
        domain.geometry.x[:, axes] = straight
        self.u = displacement(domain)
        self.x = self.u.function_space.tabulate_dof_coordinates()[:, axes]
        self._bodies = data.cell_tags

        young = fem.Function(fem.functionspace(domain, ("DG", 0)))
        young.x.array[:] = CONCRETE
        young.x.array[data.cell_tags.find(block_tag(0))] = CUSHION
        self.pressure = fem.Constant(domain, 0.0)
        self.compliance = fem.Constant(domain, 1.0)
        F = elasticity(self.u, young, NU) + self._water()
        if springs:
            F += self._springs()
        self.sigma = NodalStress(
            stress(self.u, young, NU)[axes[0], axes[0]], domain, "stress along the dam"
        )
        self.cushion_contacts, self.joints = self._contacts()
        self.problem = cx.ContactProblem(
            F,
            self.u,
            contacts=[*self.cushion_contacts, *self.joints],
            bcs=self._supports(springs),
            petsc_options_prefix="face_slab_",
            petsc_options=dict(setting.options),
        )

    def _water(self) -> ufl.Form:
        """Residual of the pressure normal to the face."""
        v = ufl.TestFunction(self.u.function_space)[self.setting.axes[2]]
        ds = ufl.Measure("ds", domain=self.mesh, subdomain_data=self.tags)
        tops = tuple(block_tag(i, "top") for i in range(1, 1 + self.model.slabs))
        return self.pressure * v * ds(tops)

    def _springs(self) -> ufl.Form:
        """Residual of the elastic support, softest below the middle of the row."""
        normal = self.setting.axes[2]
        v = ufl.TestFunction(self.u.function_space)
        x = ufl.SpatialCoordinate(self.mesh)[self.setting.axes[0]]
        half = self.model.slabs * self.model.width / 2
        exponent, base = self.setting.support
        softness = self.compliance * ((1 - abs(x) / half) ** exponent + base)
        ds = ufl.Measure("ds", domain=self.mesh, subdomain_data=self.tags)
        # The softness is no polynomial
        below = ds(block_tag(0, "bottom"), metadata={"quadrature_degree": 6})
        return self.u[normal] * v[normal] / softness * below

    def _supports(self, springs: bool) -> list[fem.DirichletBC]:
        """Dirichlet conditions: cushion's sides and bottom, lower ends; a slice everywhere."""
        along, up, normal = self.setting.axes
        V = self.u.function_space
        self.push = [fem.Constant(self.mesh, 0.0) for _ in range(2)]
        bcs = [
            fem.dirichletbc(value, self._on(along, block_tag(0, side)), V.sub(along))
            for value, side in zip(self.push, ("x0", "x1"), strict=True)
        ]
        zero = fem.Constant(self.mesh, 0.0)
        sides = ("y0", "y1") if self.model.rows == 1 else ("y0",)
        ends = [block_tag(i, side) for i in range(1 + self.model.slabs) for side in sides]
        bcs.append(fem.dirichletbc(zero, self._on(up, *ends), V.sub(up)))
        if springs:
            bottom = np.isclose(self.x[:, 2], -self.model.cushion_thickness)
            line = np.flatnonzero(bottom & np.isclose(self.x[:, 0], 0, atol=1e-9))
            # Blocked dofs of a component
            dofs = (3 * line + along).astype(np.int32)
            bcs.append(fem.dirichletbc(zero, dofs, V.sub(along)))
        else:
            bottom = self._on(normal, block_tag(0, "bottom"))
            bcs.append(fem.dirichletbc(zero, bottom, V.sub(normal)))
        return bcs

    def _on(self, component: int, *faces: int) -> npt.NDArray[np.int32]:
        """Dofs of a component on tagged faces."""
        facets = np.concatenate([self.tags.find(face) for face in faces])
        return fem.locate_dofs_topological(self.u.function_space.sub(component), 2, facets)

    def _contacts(self) -> tuple[list[cx.Contact], list[cx.Contact]]:
        """Contacts of slabs and cushion, and of neighbouring slabs."""
        s, tags = self.setting, self.tags
        slabs = range(1, 1 + self.model.slabs)
        top = cx.Surface(tags, block_tag(0, "top"))
        below = {"friction": s.cushion_friction, "sliding": s.sliding, "method": s.method}
        if s.cushion_is_slave:
            bottoms = cx.Surface(tags, *(block_tag(i, "bottom") for i in slabs))
            cushion = [cx.Contact(slave=top, master=bottoms, **below)]
        else:
            cushion = [
                cx.Contact(slave=cx.Surface(tags, block_tag(i, "bottom")), master=top, **below)
                for i in slabs
            ]
        joints = [
            cx.Contact(
                slave=cx.Surface(tags, block_tag(i, "x1")),
                master=cx.Surface(tags, block_tag(i + 1, "x0")),
                friction=s.joint_friction,
                sliding=s.sliding,
                method=s.method,
            )
            for i in slabs[:-1]
        ]
        return cushion, joints

    def nodes_of(self, body: int) -> npt.NDArray[np.int32]:
        """Nodes of a body: 0 is the cushion, 1, 2, ... are the slabs."""
        cells = self._bodies.find(block_tag(body))
        return np.unique(self.u.function_space.dofmap.list[cells])

    def nodes_on(self, face: int) -> npt.NDArray[np.int32]:
        """Nodes of a tagged face."""
        return cx.Surface(self.tags, face).nodes(self.u.function_space)

    def nodes_of_slabs(self) -> npt.NDArray[np.int32]:
        """Nodes of all slabs."""
        return np.concatenate([self.nodes_of(i) for i in range(1, 1 + self.model.slabs)])

    def moved(self) -> Array:
        """Displacement along dam, slope and normal, m, shape (num_nodes, 3)."""
        return self.u.x.array.reshape(-1, 3)[:, list(self.setting.axes)]

    def section(self) -> float:
        """Place along the slope at which results are read: the row of nodes at mid length, m."""
        y = np.unique(self.x[self.nodes_of(1), 1].round(9))
        return float(y[np.argmin(np.abs(y - self.model.length / 2))])

    def at(self, body: int, *, x: float | None = None, y: float | None = None, top: bool) -> Any:
        """Nodes of a slab on its top or bottom at a place along the dam or the slope.

        Args:
            body: Number of the slab, from 1.
            x: Place along the dam, m; all if None. The nearest node of each row counts.
            y: Place along the slope, m; all if None.
            top: Whether the nodes are on the top, or on the bottom.
        """
        nodes = self.nodes_of(body)
        height = self.model.thickness_at(self.x[nodes, 1]) if top else 0.0
        nodes = nodes[np.isclose(self.x[nodes, 2], height, atol=1e-9)]
        if y is not None:
            nodes = nodes[np.isclose(self.x[nodes, 1], y, atol=1e-6)]
        if x is not None:
            distance = np.abs(self.x[nodes, 0] - x)
            nodes = nodes[distance < distance.min() + 1e-9]
        # Rows but for rounding
        return nodes[np.lexsort(self.x[nodes, :2].T.round(9))]
