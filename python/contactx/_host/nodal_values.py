# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Values at nodes that a user gives: numbers, functions, and the weight of contact's integrals."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import basix
import ufl
from contactx._host.checks import described, is_number
from contactx._host.nodes import degree_of
from dolfinx import fem
from ufl.algorithms import extract_arguments
from ufl.domain import extract_domains


def matching_nodes(V: fem.FunctionSpace, Q: fem.FunctionSpace) -> npt.NDArray[np.int32]:
    """Node of the scalar space Q at each node of the vector space V of the same degree."""
    index_map = V.dofmap.index_map
    match = np.empty(index_map.size_local + index_map.num_ghosts, dtype=np.int32)
    match[V.dofmap.list.ravel()] = Q.dofmap.list.ravel()
    return match


class NodalValue:
    """A number, or a function of a scalar Lagrange space, read anew at each use."""

    def __init__(self, value: Any, name: str, V: fem.FunctionSpace, nodes: npt.NDArray[np.int32]):
        """Find the nodes of the function.

        Args:
            value: A number, a ``fem.Constant`` or a ``fem.Function``.
            name: Name of the argument.
            V: Space of the displacement.
            nodes: Nodes of V that this rank owns, shape (n,).

        Raises:
            TypeError: If its values are not of real double precision.
            ValueError: If the function is not of a scalar Lagrange space on V's mesh, linear or of
                V's degree, or the constant is no number.
        """
        self._value = value
        self._name = name
        if isinstance(value, fem.Function | fem.Constant) and value.dtype != np.float64:
            raise TypeError(
                f"{name} holds {np.dtype(value.dtype).name} values: give real numbers in double "
                "precision"
            )
        if isinstance(value, fem.Function):
            Q = value.function_space
            element = Q.ufl_element()
            degree = degree_of(V)
            fits = element.element_family == basix.ElementFamily.P and element.degree in (1, degree)
            scalar = element.block_size == 1 and not element.discontinuous
            if Q.mesh is not V.mesh or not (fits and scalar):
                raise ValueError(
                    f"{name} is a function of {element}: interpolate it into "
                    'functionspace(mesh, ("Lagrange", 1)) on the displacement\'s mesh'
                )
            self._between: fem.Function | None = None
            if element.degree != degree:
                # A linear one where there are nodes between the vertices
                Q = fem.functionspace(V.mesh, ("Lagrange", degree))
                self._between = fem.Function(Q)
            self._nodes = matching_nodes(V, Q)[nodes]
        elif isinstance(value, fem.Constant) and value.value.shape != ():
            raise ValueError(
                f"{name} is a constant of shape {value.value.shape}: give one of a number"
            )

    @property
    def is_number(self) -> bool:
        """True if it is a number, which never changes."""
        return not isinstance(self._value, fem.Function | fem.Constant)

    def now(self) -> Any:
        """Current value: a number, or an array of shape (n,).

        Raises:
            ValueError: If it is not finite at the nodes of this rank.
        """
        if isinstance(self._value, fem.Function):
            function = self._value
            if self._between is not None:
                self._between.interpolate(function)
                function = self._between
            value = function.x.array[self._nodes]
        else:
            value = float(self._value)
        if not np.all(np.isfinite(value)):
            raise ValueError(
                f"{self._name} is not finite: give finite numbers (manual: "
                "errors/values-not-finite)"
            )
        return value


class ContactValues:
    """Friction and offset of a contact as they are now: the core's ``problem::Values``.

    Attributes:
        vary: Whether they may change.
    """

    def __init__(self, friction: NodalValue | None, offset: NodalValue, num_nodes: int):
        """Take the values.

        Args:
            friction: Coefficient of friction; None of laws that take none.
            offset: What is taken off the gap.
            num_nodes: Number of slave nodes of this rank.
        """
        self._friction, self._offset, self._num_nodes = friction, offset, num_nodes
        self.vary = not all(v is None or v.is_number for v in (friction, offset))

    def friction(self) -> npt.NDArray[np.float64] | None:
        """Coefficients of friction, shape (n,)."""
        return None if self._friction is None else self._full(self._friction)

    def offset(self) -> npt.NDArray[np.float64]:
        """Lengths that are taken off the gap, shape (n,)."""
        return self._full(self._offset)

    def _full(self, value: NodalValue) -> npt.NDArray[np.float64]:
        return np.array(np.broadcast_to(value.now(), self._num_nodes), dtype=np.float64)


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
