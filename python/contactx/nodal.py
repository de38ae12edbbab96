# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Values at nodes that a user gives as a number or as a function."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

import basix
from dolfinx import fem


def matching_nodes(V: fem.FunctionSpace, Q: fem.FunctionSpace) -> npt.NDArray[np.int32]:
    """Node of the scalar linear space Q at each node of the vector space V."""
    index_map = V.dofmap.index_map
    match = np.empty(index_map.size_local + index_map.num_ghosts, dtype=np.int32)
    match[V.dofmap.list.ravel()] = Q.dofmap.list.ravel()
    return match


def reference_positions(V: fem.FunctionSpace) -> npt.NDArray[np.float64]:
    """Positions of the nodes of a linear space, ghosts included, shape (num_nodes, gdim).

    They are the mesh's own to the last bit. What DOLFINx evaluates differs by rounding from cell
    to cell, and with it which of two facets is the nearer one would depend on the ranks.
    """
    geometry, dofs, index_map = V.mesh.geometry, V.dofmap.list, V.dofmap.index_map
    x = np.zeros((index_map.size_local + index_map.num_ghosts, geometry.dim))
    # Vertices come first in the geometry of a cell
    x[dofs] = geometry.x[geometry.dofmaps[0][:, : dofs.shape[1]], : geometry.dim]
    return x


class NodalValue:
    """A number, or a function of a scalar linear space, read anew at each use."""

    def __init__(self, value: Any, name: str, V: fem.FunctionSpace, nodes: npt.NDArray[np.int32]):
        """Find the nodes of the function.

        Args:
            value: A number, a ``fem.Constant`` or a ``fem.Function``.
            name: Name of the argument.
            V: Space of the displacement.
            nodes: Nodes of V that this rank owns, shape (n,).

        Raises:
            TypeError: If its values are not of real double precision.
            ValueError: If the function is not of a scalar linear space on V's mesh, or the constant
                is no number.
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
            linear = (element.element_family, element.degree) == (basix.ElementFamily.P, 1)
            scalar = element.block_size == 1 and not element.discontinuous
            if Q.mesh is not V.mesh or not (linear and scalar):
                raise ValueError(
                    f"{name} is a function of {element}: interpolate it into "
                    'functionspace(mesh, ("Lagrange", 1)) on the displacement\'s mesh'
                )
            self._nodes = matching_nodes(V, Q)[nodes]
        elif isinstance(value, fem.Constant) and value.value.shape != ():
            raise ValueError(
                f"{name} is a constant of shape {value.value.shape}: give one of a number"
            )

    @property
    def is_number(self) -> bool:
        """Whether it is a number, which never changes."""
        return not isinstance(self._value, fem.Function | fem.Constant)

    def now(self) -> Any:
        """Current value: a number, or an array of shape (n,).

        Raises:
            ValueError: If it is not finite at the nodes of this rank.
        """
        if isinstance(self._value, fem.Function):
            value = self._value.x.array[self._nodes]
        else:
            value = float(self._value)
        if not np.all(np.isfinite(value)):
            raise ValueError(f"{self._name} is not finite: give finite numbers")
        return value
