# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Functions of UFL that are evaluated at points, with their derivatives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import ufl
from dolfinx import fem, mesh

# Value, gradient and second derivative, if there is one
type Values = tuple[
    npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64] | None
]

# Numbers of points that a function of UFL is kept compiled for
_MOST_COMPILED = 3


class UFLFunction:
    """A UFL function of a vector, compiled for as many points as it is asked about."""

    def __init__(self, f: Callable[[Any], Any], name: str):
        """Take the function; nothing is compiled before it is asked for.

        Args:
            f: From a UFL vector to a scalar expression.
            name: Class that it was given to, for messages.
        """
        self._f, self._name = f, name
        self._compiled: dict[tuple[int, ...], _Compiled] = {}

    def values(self, x: npt.NDArray[np.float64], order: int) -> Values:
        """Value, gradient and second derivative, shapes (n,), (n, gdim), (n, gdim, gdim).

        Raises:
            ValueError: If it is not one of UFL, no scalar, or holds what it may not.
        """
        if order == 0:
            # Of all nodes of a body, once
            return (self._compiled.get(x.shape) or _Compiled(self._f, self._name, *x.shape))(x)
        return self._compiled_for(x.shape)(x)

    def parameters(self, gdim: int) -> npt.NDArray[np.float64]:
        """Current values of the constants, also on a rank that has asked about no point."""
        compiled = next(iter(self._compiled.values()), None) or self._compiled_for((1, gdim))
        return compiled.constants()

    def _compiled_for(self, shape: tuple[int, ...]) -> _Compiled:
        if shape not in self._compiled:
            # Slave nodes, points of slave facets, and what the audit looks at
            while len(self._compiled) >= _MOST_COMPILED:
                del self._compiled[next(iter(self._compiled))]
            self._compiled[shape] = _Compiled(self._f, self._name, *shape)
        return self._compiled[shape]


class _Compiled:
    """A UFL function of the position with its derivatives, compiled for n points.

    UFL evaluates on cells: here a chain of n cells, with the position constant on each.
    """

    def __init__(self, f: Callable[[Any], Any], name: str, n: int, gdim: int):
        chain = mesh.create_interval(MPI.COMM_SELF, n, [0.0, 1.0])
        self._position = fem.Function(fem.functionspace(chain, ("DG", 0, (gdim,))))
        X = ufl.variable(self._position)
        try:
            value = ufl.as_ufl(f(X))
        except Exception as error:
            raise ValueError(
                f"the function of a {name} is not one of UFL: for a function of Python give its "
                f"gradient too, {name}(f, gradient)"
            ) from error
        if value.ufl_shape != ():
            raise ValueError(
                f"the function of a {name} gave an expression of shape {value.ufl_shape}: it "
                "must be a scalar"
            )
        others = set(ufl.algorithms.extract_coefficients(value)) - {self._position}
        if others or ufl.algorithms.analysis.extract_type(value, ufl.classes.GeometricQuantity):
            raise ValueError(
                f"the function of a {name} holds a function or the coordinates of a mesh: it may "
                "hold its argument and fem.Constant alone"
            )
        gradient = ufl.diff(value, X)
        second = ufl.diff(gradient, X)
        values = ufl.as_vector(
            [value, *(gradient[i] for i in range(gdim))]
            + [second[i, j] for i in range(gdim) for j in range(gdim)]
            # Not read; a function that does not depend on the position needs a mesh all the same
            + [self._position[0]]
        )
        # The user's constants live on another mesh
        constants = ufl.algorithms.analysis.extract_constants(values)
        self._constants = [(c, fem.Constant(chain, c.value)) for c in constants]
        values = ufl.replace(values, dict(self._constants))
        self._expression = fem.Expression(values, np.array([[0.5]]), comm=MPI.COMM_SELF)
        self._mesh = chain
        self._cells = np.arange(n, dtype=np.int32)

    def constants(self) -> npt.NDArray[np.float64]:
        """Current values of the user's constants, one after the other."""
        values = [np.zeros(0), *(np.ravel(theirs.value) for theirs, _ in self._constants)]
        return np.concatenate(values)

    def __call__(
        self, x: npt.NDArray[np.float64]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Value, gradient and second derivative, shapes (n,), (n, gdim), (n, gdim, gdim)."""
        n, gdim = x.shape
        self._position.x.array[:] = x.ravel()
        for theirs, ours in self._constants:
            ours.value[...] = theirs.value
        table = self._expression.eval(self._mesh, self._cells).reshape(n, -1)
        second = table[:, 1 + gdim : -1].reshape(n, gdim, gdim)
        return table[:, 0], table[:, 1 : 1 + gdim], second
