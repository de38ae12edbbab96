# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Factor of contact's integrals: 2 pi r in axisymmetric models, a thickness in plane ones."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import ufl
from contactx.arguments import described, is_number
from contactx.nodal import matching_nodes
from contactx.refined import degree_of
from dolfinx import fem
from ufl.algorithms import extract_arguments
from ufl.domain import extract_domains


def check_weight(weight: Any) -> None:
    """Check the argument ``weight`` of a contact.

    Raises:
        TypeError: If it is no number and no expression of UFL.
        ValueError: If it is a number that is not positive, not scalar, or has test functions in it.
    """
    if is_number(weight):
        if not (np.isfinite(weight) and weight > 0):
            raise ValueError(f"weight is {weight}: give a positive number")
        return
    if not isinstance(weight, ufl.core.expr.Expr):
        raise TypeError(
            f"weight must be a number or an expression of UFL, not {described(weight)}: write "
            "2 * ufl.pi * ufl.SpatialCoordinate(mesh)[0], say"
        )
    if weight.ufl_shape != ():
        raise ValueError(f"weight has the shape {weight.ufl_shape}: give a scalar expression")
    if extract_arguments(weight):
        raise ValueError("weight has test or trial functions in it: give one of the position")
    if isinstance(weight, fem.Constant | fem.Function) and weight.dtype != np.float64:
        raise TypeError(
            f"weight holds {np.dtype(weight.dtype).name} values: give real numbers in double "
            "precision"
        )


def nodal_weight(
    weight: Any, V: fem.FunctionSpace, nodes: npt.NDArray[np.int32]
) -> npt.NDArray[np.float64]:
    """Values of a weight in the reference configuration; all ranks must take part.

    Args:
        weight: A number or a scalar expression of UFL.
        V: Space of the displacement.
        nodes: Nodes of V that this rank owns, shape (n,).

    Returns:
        The values, shape (n,).

    Raises:
        ValueError: If it is an expression on another mesh.
    """
    if is_number(weight):
        return np.full(len(nodes), float(weight))
    domains = extract_domains(weight)
    if any(domain is not V.mesh.ufl_domain() for domain in domains):
        raise ValueError(
            "weight is an expression on another mesh than the displacement's: write it with the "
            "SpatialCoordinate of that one"
        )
    if isinstance(weight, fem.Constant):
        return np.full(len(nodes), float(weight))
    Q = fem.functionspace(V.mesh, ("Lagrange", degree_of(V)))
    values = fem.Function(Q)
    if isinstance(weight, fem.Function):
        values.interpolate(weight)
    else:
        points = Q.element.interpolation_points
        values.interpolate(fem.Expression(weight, points, comm=V.mesh.comm))
    values.x.scatter_forward()
    at: npt.NDArray[np.float64] = values.x.array[matching_nodes(V, Q)[nodes]]
    return at


def is_axisymmetric(form: ufl.Form) -> bool:
    """True if all cell integrals of a plane form have a coordinate as a factor, as with 2 pi r."""
    integrals = [i for i in form.integrals() if i.integral_type() == "cell"]
    is_plane = all(
        i.ufl_domain().ufl_coordinate_element().reference_value_shape == (2,) for i in integrals
    )
    return (
        is_plane
        and len(integrals) > 0
        and all(_terms_have_factor(integral.integrand()) for integral in integrals)
    )


def _terms_have_factor(expression: ufl.core.expr.Expr) -> bool:
    """True if a coordinate is a factor of each term of a sum."""
    if isinstance(expression, ufl.algebra.Sum):
        return all(_terms_have_factor(term) for term in expression.ufl_operands)
    if isinstance(expression, ufl.algebra.Product):
        return any(_terms_have_factor(factor) for factor in expression.ufl_operands)
    if isinstance(expression, ufl.indexed.Indexed):
        return isinstance(expression.ufl_operands[0], ufl.SpatialCoordinate)
    return False
