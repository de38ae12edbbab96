# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks that rub on a plane or on a base, driven by all displacements of their faces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from story import displacement, elasticity

import contactx as cx
import ufl
from contactx import meshes
from contactx.meshes import Tag
from dolfinx import fem, mesh

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

    def step(self, *top: float) -> None:
        """Move the top to a place and solve."""
        self.top.move(top)
        self.solve()

    def solve(self) -> None:
        """Solve and check Coulomb's law."""
        self.problem.solve()
        self.iterations.append(self.problem.report.iterations)
        check_coulomb(self.contact)

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


def check_coulomb(contact: cx.Contact) -> dict[str, int]:
    """Check Coulomb's law and the normal conditions at every node.

    Returns:
        Number of nodes by status.
    """
    nodes = contact.interface.nodes
    p, t = parts(contact)
    slip = nodes.slip
    mu = np.broadcast_to(np.asarray(contact.interface.law.friction(nodes)), p.shape)
    stick, sliding, is_open = (nodes.status == k for k in (1, 2, 0))
    scale = p.max(initial=0.0)
    tiny = 1e-9 * scale
    length = np.abs(contact.interface.state.position.array).max()
    size_t, size_s = np.linalg.norm(t, axis=1), np.linalg.norm(slip, axis=1)
    assert np.all(contact.multiplier[is_open] == 0)
    assert np.all(p[~is_open] >= 0)
    assert np.all(np.abs(nodes.gap[~is_open]) <= 1e-9 * length)
    assert np.all(nodes.gap[is_open & ~np.isnan(nodes.gap)] >= -1e-9 * length)
    assert np.all(size_t <= mu * p * (1 + 1e-9) + 1e-3 * tiny)
    assert np.all(size_s[stick] <= 1e-9 * length)
    np.testing.assert_allclose(size_t[sliding], (mu * p)[sliding], rtol=1e-8, atol=tiny)
    # t = -mu p s / |s|, without dividing by a slip that is rounding
    against = t[sliding] * size_s[sliding, None] + (mu * p)[sliding, None] * slip[sliding]
    bound = 1e-9 * (scale * length)
    np.testing.assert_allclose(against, 0, atol=bound)
    return {"open": is_open.sum(), "stick": stick.sum(), "slip": sliding.sum()}
