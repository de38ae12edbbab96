# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks that rub on a plane or on a base, driven by all displacements of their faces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import contactx as cx
import ufl
from dolfinx import fem, mesh

import meshes
from meshes import Tag
from story import displacement, elasticity

type Array = npt.NDArray[np.float64]


def neo_hookean(u: fem.Function, young: float, nu: float) -> ufl.Form:
    """Residual of compressible neo-Hookean bodies, in plane strain where the mesh is plane."""
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    gdim = len(u)
    F = ufl.Identity(gdim) + ufl.grad(u)
    J = ufl.det(F)
    density = mu / 2 * (ufl.tr(F.T * F) - gdim - 2 * ufl.ln(J)) + lmbda / 2 * ufl.ln(J) ** 2
    return ufl.derivative(density * ufl.dx(metadata={"quadrature_degree": 3}), u)


class DrivenFaces:
    """All displacements of some faces.

    Attributes:
        bc: The Dirichlet condition.
        x: Reference positions of the faces' nodes, shape (n, gdim).
    """

    def __init__(self, u: fem.Function, tags: mesh.MeshTags, *faces: int):
        """Hold them."""
        V = u.function_space
        facets = np.concatenate([tags.find(face) for face in faces])
        dofs = fem.locate_dofs_topological(V, tags.dim, facets)
        self._value = fem.Function(V)
        self._nodes = dofs
        self.bc = fem.dirichletbc(self._value, dofs)
        self.x: Array = V.tabulate_dof_coordinates()[dofs, : len(u)]

    def move(self, by: Sequence[float] | Array) -> None:
        """Set the displacement: one for all nodes, or one a node."""
        gdim = self.x.shape[1]
        self._value.x.array.reshape(-1, gdim)[self._nodes] = by


class DrivenBlock:
    """A unit block whose top is driven, on a rigid plane or on a base whose bottom is driven.

    Attributes:
        u: Displacement.
        top: The block's top.
        bottom: The base's bottom; None on a plane.
        contact: The block's lower face on the plane or the base.
        problem: The problem.
        iterations: Of each step.
        count: Number of slave nodes by status.
    """

    def __init__(
        self,
        cell: mesh.CellType,
        *,
        plane: cx.Plane | None = None,
        friction: Any = 0.3,
        sliding: str = "finite",
        n_upper: int = 3,
        n_lower: int = 4,
        width: float = 3.0,
        shift: float = 0.83,
        gap: float = 0.0,
        height: float = 1.0,
        young: float | tuple[float, float] = 1.0,
        nu: float = 0.3,
        material: Callable[[fem.Function, Any, float], ufl.Form] = elasticity,
        rigid_base: bool = False,
    ):
        """Set the problem up, nothing moved yet."""
        flat = cell in (mesh.CellType.triangle, mesh.CellType.quadrilateral)
        self.gdim = gdim = 2 if flat else 3
        data = meshes.blocks(
            cell,
            (n_upper,) * gdim,
            (n_lower,) * (gdim - 1) + (1 if rigid_base else n_lower,),
            size_upper=(1.0,) * (gdim - 1) + (height,),
            size_lower=(width,) * (gdim - 1) + (1.0,),
            shift=(shift,) * (gdim - 1),
            gap=gap,
        )
        domain, tags = data.mesh, data.facet_tags
        if plane is not None:
            domain, tags = meshes.single(data, Tag.UPPER)
        self.tags = tags
        self.u = displacement(domain)
        if isinstance(young, tuple):
            E = fem.Function(fem.functionspace(domain, ("DG", 0)))
            for body, value in zip((Tag.UPPER, Tag.LOWER), young, strict=True):
                E.x.array[data.cell_tags.find(body)] = value
            young = E
        self.F = material(self.u, young, nu)
        self.top = DrivenFaces(self.u, tags, Tag.UPPER_TOP)
        self.bottom: DrivenFaces | None = None
        if plane is None:
            # One layer of cells is held by both of its faces
            faces = (Tag.LOWER_BOTTOM, Tag.LOWER_CONTACT) if rigid_base else (Tag.LOWER_BOTTOM,)
            self.bottom = DrivenFaces(self.u, tags, *faces)
        self.contact = cx.Contact(
            cx.Surface(tags, Tag.UPPER_CONTACT),
            cx.Surface(tags, Tag.LOWER_CONTACT) if plane is None else plane,
            friction=friction,
            sliding=sliding,
        )
        self.problem = cx.ContactProblem(
            self.F,
            self.u,
            contacts=[self.contact],
            bcs=[driven.bc for driven in (self.top, self.bottom) if driven is not None],
            petsc_options_prefix="driven_",
        )
        self._residual = fem.form(self.F)
        self.iterations: list[int] = []
        self.count: dict[str, int] = {}

    def step(self, *top: float) -> None:
        """Move the top to a place and solve."""
        self.top.move(top)
        self.solve()

    def solve(self) -> None:
        """Solve and check Coulomb's law."""
        self.problem.solve()
        self.iterations.append(self.problem.report.iterations)
        self.count = check_coulomb(self.contact, self.problem.report.history[-1].tolerance)

    @property
    def reactions(self) -> Array:
        """Forces of the bulk, in equilibrium those of supports and contact, shape (num_dofs,)."""
        forces: Array = fem.assemble_vector(self._residual).array
        return forces

    @property
    def tangential(self) -> Array:
        """Total force on the block along a horizontal surface, shape (gdim - 1,)."""
        return self.contact.force[:-1]

    @property
    def normal(self) -> float:
        """Total force on the block across a horizontal surface."""
        return float(self.contact.force[-1])


def parts(contact: cx.Contact) -> tuple[Array, Array]:
    """Pressure and tangential traction of the slave nodes, shapes (n,) and (n, gdim)."""
    normal, traction = contact.interface.nodes.normal, contact.multiplier
    p: Array = np.einsum("ij,ij->i", normal, traction)
    return p, traction - p[:, None] * normal


def check_coulomb(
    contact: cx.Contact, tolerance: float, which: npt.NDArray[np.bool_] | None = None
) -> dict[str, int]:
    """Check Coulomb's law and the normal conditions at slave nodes.

    Args:
        contact: Contact.
        tolerance: Force up to which the conditions were solved.
        which: Which nodes to check, shape (n,); all if None.

    Returns:
        Number of all nodes by status.
    """
    nodes = contact.interface.nodes
    p, t = parts(contact)
    mu = np.broadcast_to(contact.interface.law.friction(nodes), p.shape)
    # A row of the conditions is a force: area times a traction, or times c and a length
    stress = tolerance / nodes.area
    length = stress / nodes.c + 1e-15 * np.abs(contact.interface.positions()).max()
    stick, slips, is_open = (nodes.status == k for k in (1, 2, 0))
    which = np.ones(len(p), dtype=bool) if which is None else which
    size_t, size_s = np.linalg.norm(t, axis=1), np.linalg.norm(nodes.slip, axis=1)

    def holds(condition: Array) -> bool:
        return bool(np.all(condition[which]))

    assert holds(~is_open | (np.abs(contact.multiplier).max(axis=1) <= stress))
    assert holds(is_open | (p >= 0))
    assert holds(is_open | (np.abs(nodes.gap) <= length))
    assert holds(~is_open | np.isnan(nodes.gap) | (nodes.gap >= -length))
    assert holds(size_t <= mu * p * (1 + 1e-9) + stress)
    assert holds(~stick | (size_s <= length))
    assert holds(~slips | (np.abs(size_t - mu * p) <= 1e-9 * mu * p + stress))
    # t = -mu p s / |s|, without a direction of what is rounding
    against = t * size_s[:, None] + (mu * p)[:, None] * nodes.slip
    # On the edge of the cone slip may be as wrong as 1e-10 of the traction is worth
    edge = 1e-10 * mu * p / nodes.c
    bound = (1e-9 * mu * p + stress) * size_s + 2 * mu * p * (length + edge)
    assert holds(~slips | (np.linalg.norm(against, axis=1) <= bound))
    return {"open": int(is_open.sum()), "stick": int(stick.sum()), "slip": int(slips.sum())}
