# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks whose displacement is solved for together with a pressure or a temperature."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

import basix.ufl
import contactx as cx
import ufl
from dolfinx import fem
from dolfinx.mesh import CellType

import meshes
from meshes import Tag
from scenes.problems import make_problem, pair_of

E, NU = 1.0, 0.3
MU, LAMBDA = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))
EXPANSION = 1e-3


def fix(V: fem.FunctionSpace, tags: Any, value: Any, *where: int) -> fem.DirichletBC:
    """Prescribe a value on tagged facets."""
    facets = np.concatenate([tags.find(tag) for tag in where])
    dim = V.mesh.topology.dim
    V.mesh.topology.create_connectivity(dim - 1, dim)
    return fem.dirichletbc(value, fem.locate_dofs_topological(V, dim - 1, facets), V)


def strain(u: Any) -> Any:
    """Small strain."""
    return ufl.sym(ufl.grad(u))


class Coupled:
    """Blocks that are pressed together and pushed aside, in one of several formulations."""

    def __init__(
        self,
        kind: str,
        cell: CellType = CellType.triangle,
        petsc_options: dict[str, Any] | None = None,
        **options: Any,
    ):
        """Set up.

        Args:
            kind: "plain", "mixed" with the pressure in cells, "mixed, pressure first", "blocks",
                "MINI", or "neo-Hooke" in MINI's elements.
        """
        dim = 2 if cell in (CellType.triangle, CellType.quadrilateral) else 3
        n = ((4, 3), (5, 3)) if dim == 2 else ((3, 3, 2), (4, 4, 2))
        data = meshes.blocks(cell, *n)
        self.tags, domain = data.facet_tags, data.mesh
        self.down = fem.Constant(domain, -0.05)
        F, self.w, V, self.displacement = _FORMS[kind](domain, dim)
        last = dim - 1
        self.bcs = [
            *(fix(V.sub(i), self.tags, 0.0, Tag.LOWER_BOTTOM) for i in range(dim)),
            *(fix(V.sub(i), self.tags, 0.02 * (i == 0), Tag.UPPER_TOP) for i in range(last)),
            fix(V.sub(last), self.tags, self.down, Tag.UPPER_TOP),
        ]
        self.F = F
        self.contact = self.new_contact(**options)
        self.problem = make_problem(
            F,
            self.w,
            [self.contact],
            self.bcs,
            displacement=self.displacement,
            petsc_options=petsc_options,
        )

    def new_contact(self, **options: Any) -> cx.Contact:
        """The contact between the blocks."""
        slave, master = (
            cx.Surface(self.tags, tag) for tag in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT)
        )
        return cx.Contact(slave, master, **options)

    @property
    def functions(self) -> Sequence[fem.Function]:
        """What is solved for."""
        return self.w if isinstance(self.w, list) else [self.w]


def _elements(domain: Any, dim: int) -> tuple[Any, Any, Any]:
    cell = domain.basix_cell()
    linear = basix.ufl.element("Lagrange", cell, 1)
    return linear, basix.ufl.element("Lagrange", cell, 1, shape=(dim,)), cell


def _saddle(u: Any, p: Any, v: Any, q: Any, dim: int) -> tuple[Any, Any]:
    """Residuals of forces and of volumes, p = lambda div u."""
    forces = ufl.inner(2 * MU * strain(u) + p * ufl.Identity(dim), strain(v)) * ufl.dx
    return forces, q * (ufl.div(u) - p / LAMBDA) * ufl.dx


def _plain(domain: Any, dim: int) -> Any:
    V = fem.functionspace(domain, _elements(domain, dim)[1])
    u, v = fem.Function(V), ufl.TestFunction(V)
    stress = 2 * MU * strain(u) + LAMBDA * ufl.div(u) * ufl.Identity(dim)
    return ufl.inner(stress, strain(v)) * ufl.dx, u, V, None


def _mixed(domain: Any, dim: int, *, is_first: bool = True) -> Any:
    _, vector, cell = _elements(domain, dim)
    parts = [vector, basix.ufl.element("DG", cell, 0)]
    d = 0 if is_first else 1
    W = fem.functionspace(domain, basix.ufl.mixed_element(parts if is_first else parts[::-1]))
    w = fem.Function(W)
    trial, test = ufl.split(w), ufl.split(ufl.TestFunction(W))
    F = sum(_saddle(trial[d], trial[1 - d], test[d], test[1 - d], dim))
    return F, w, W.sub(d), d


def _blocks(domain: Any, dim: int) -> Any:
    _, vector, cell = _elements(domain, dim)
    V = fem.functionspace(domain, vector)
    Q = fem.functionspace(domain, basix.ufl.element("DG", cell, 0))
    u, p = fem.Function(V), fem.Function(Q)
    F = _saddle(u, p, ufl.TestFunction(V), ufl.TestFunction(Q), dim)
    return list(F[::-1]), [p, u], V, 1


def _bubbles(domain: Any, dim: int) -> Any:
    linear, _, cell = _elements(domain, dim)
    bubble = basix.ufl.element("Bubble", cell, dim + 1)
    vector = basix.ufl.blocked_element(basix.ufl.enriched_element([linear, bubble]), shape=(dim,))
    return fem.Function(fem.functionspace(domain, basix.ufl.mixed_element([vector, linear])))


def _mini(domain: Any, dim: int) -> Any:
    w = _bubbles(domain, dim)
    W = w.function_space
    u, p = ufl.split(w)
    v, q = ufl.split(ufl.TestFunction(W))
    return sum(_saddle(u, p, v, q, dim)), w, W.sub(0), 0


def _neo_hooke(domain: Any, dim: int) -> Any:
    w = _bubbles(domain, dim)
    u, p = ufl.split(w)
    F = ufl.Identity(dim) + ufl.grad(u)
    J = ufl.det(F)
    energy = MU / 2 * (ufl.tr(F.T * F) - dim - 2 * ufl.ln(J)) + p * (J - 1) - p**2 / 2e4
    # Bubbles are of high degree, and their exact integrals dear
    dx = ufl.dx(metadata={"quadrature_degree": 4})
    return ufl.derivative(energy * dx, w), w, w.function_space.sub(0), 0


_FORMS: dict[str, Any] = {
    "plain": _plain,
    "mixed": _mixed,
    "mixed, pressure first": lambda domain, dim: _mixed(domain, dim, is_first=False),
    "blocks": _blocks,
    "MINI": _mini,
    "neo-Hooke": _neo_hooke,
}


def thermal(friction: float = 0.2, **options: Any) -> tuple[Any, ...]:
    """Blocks that expand as they are heated; their conductivity depends on the temperature.

    Returns:
        Residuals, displacement, temperature, conditions on the temperature and on the displacement,
        and the contact.
    """
    data = meshes.blocks(CellType.triangle, (4, 3), (5, 3))
    tags, domain = data.facet_tags, data.mesh
    V = fem.functionspace(domain, ("Lagrange", 1, (2,)))
    Q = fem.functionspace(domain, ("Lagrange", 1))
    u, T = fem.Function(V), fem.Function(Q)
    v, q = ufl.TestFunction(V), ufl.TestFunction(Q)
    e = strain(u) - EXPANSION * T * ufl.Identity(2)
    F = [
        ufl.inner(2 * MU * e + LAMBDA * ufl.tr(e) * ufl.Identity(2), strain(v)) * ufl.dx,
        (1 + 0.01 * T) * ufl.inner(ufl.grad(T), ufl.grad(q)) * ufl.dx,
    ]
    heat = [
        fix(Q, tags, 100.0, Tag.UPPER_TOP),
        fix(Q, tags, 0.0, Tag.UPPER_CONTACT),
        fix(Q, tags, 20.0, Tag.LOWER_BOTTOM),
        fix(Q, tags, 50.0, Tag.LOWER_CONTACT),
    ]
    hold = [fix(V.sub(i), tags, 0.0, Tag.LOWER_BOTTOM, Tag.UPPER_TOP) for i in range(2)]
    contact = pair_of(tags, friction=friction, **options)
    return F, u, T, heat, hold, contact
