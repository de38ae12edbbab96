# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Materials beside the linear one of ``story``, and a property that differs between bodies."""

from __future__ import annotations

from typing import Any

import ufl
from dolfinx import fem

from meshes import Tag


def neo_hookean(u: fem.Function, young: Any, nu: Any, degree: int | None = None) -> ufl.Form:
    """Residual of compressible neo-Hookean bodies, in plane strain where the mesh is plane.

    Args:
        u: Displacement.
        young: Young's modulus at small strains.
        nu: Poisson's ratio at small strains.
        degree: Degree of the quadrature; UFL's estimate if None.
    """
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    gdim = len(u)
    F = ufl.Identity(gdim) + ufl.grad(u)
    log_j = ufl.ln(ufl.det(F))
    density = mu / 2 * (ufl.tr(F.T * F) - gdim - 2 * log_j) + lmbda / 2 * log_j**2
    return ufl.derivative(density * _measure(degree), u)


def of_bodies(data: Any, upper: float, lower: float) -> fem.Function:
    """A value for the upper body's cells and one for the lower body's.

    Args:
        data: Mesh with tags of its cells.
        upper: Value of the upper body.
        lower: Value of the lower body.
    """
    result = fem.Function(fem.functionspace(data.mesh, ("DG", 0)))
    for body, value in ((Tag.UPPER, upper), (Tag.LOWER, lower)):
        result.x.array[data.cell_tags.find(body)] = value
    return result


def st_venant_kirchhoff(
    u: fem.Function, young: Any, nu: Any, degree: int | None = None
) -> ufl.Form:
    """Residual of bodies that hardly resist being squeezed to nothing, or turned inside out.

    Args:
        u: Displacement.
        young: Young's modulus at small strains.
        nu: Poisson's ratio at small strains.
        degree: Degree of the quadrature; UFL's estimate if None.
    """
    mu, lmbda = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    F = ufl.Identity(len(u)) + ufl.grad(u)
    E = (F.T * F - ufl.Identity(len(u))) / 2
    density = mu * ufl.inner(E, E) + lmbda / 2 * ufl.tr(E) ** 2
    return ufl.derivative(density * _measure(degree), u)


def _measure(degree: int | None) -> ufl.Measure:
    return ufl.dx if degree is None else ufl.dx(metadata={"quadrature_degree": degree})
