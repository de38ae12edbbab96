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
_MAX_COMPILED = 3


def faces(f: ufl.core.expr.Expr) -> list[ufl.core.expr.Expr]:
    """Split a function with kinks into functions of which it is the largest.

    Args:
        f: Scalar expression: what is seen are ``max_value`` and ``abs`` in it, in sums, and times
            or over positive numbers.

    Returns:
        The functions, f alone if it has no such kink.
    """
    if isinstance(f, ufl.classes.MaxValue):
        return [face for operand in f.ufl_operands for face in faces(operand)]
    if isinstance(f, ufl.classes.Abs):
        (operand,) = f.ufl_operands
        return [*faces(operand), *faces(-operand)]
    if isinstance(f, ufl.classes.Sum):
        a, b = f.ufl_operands
        return [p + q for p in faces(a) for q in faces(b)]
    if isinstance(f, ufl.classes.Product | ufl.classes.Division):
        a, b = f.ufl_operands
        if _is_positive(b):
            return [p * b if isinstance(f, ufl.classes.Product) else p / b for p in faces(a)]
        if isinstance(f, ufl.classes.Product) and _is_positive(a):
            return [a * p for p in faces(b)]
    return [f]


def _is_positive(f: ufl.core.expr.Expr) -> bool:
    return isinstance(f, ufl.classes.RealValue) and float(f) > 0


class UFLFunction:
    """A UFL function of a vector, compiled for as many points as it is asked about."""

    def __init__(self, f: Callable[[Any], Any], name: str, *, in_faces: bool = False):
        """Take the function; nothing is compiled before it is asked for.

        Args:
            f: From a UFL vector to a scalar expression.
            name: Class that it was given to, for messages.
            in_faces: Whether kinks split it into the functions of which it is the largest.
        """
        self._f, self._name, self._in_faces = f, name, in_faces
        self._compiled: dict[tuple[int, ...], _Compiled] = {}

    def values(self, x: npt.NDArray[np.float64], order: int) -> Values:
        """Value, gradient and second derivative of each of its faces, one if it is not split.

        Shapes (faces, n), (faces, n, gdim), (faces, n, gdim, gdim).

        Raises:
            ValueError: If it is not one of UFL, no scalar, or holds what it may not.
        """
        if order == 0:
            # Of all nodes of a body, once
            return (self._compiled.get(x.shape) or self._compile(x.shape))(x)
        return self._compiled_for(x.shape)(x)

    def parameters(self, gdim: int) -> npt.NDArray[np.float64]:
        """Current values of the constants, also on a rank that has asked about no point."""
        compiled = next(iter(self._compiled.values()), None) or self._compiled_for((1, gdim))
        return compiled.constants()

    def _compiled_for(self, shape: tuple[int, ...]) -> _Compiled:
        if shape not in self._compiled:
            # Slave nodes, points of slave facets, and points of the audit
            while len(self._compiled) >= _MAX_COMPILED:
                del self._compiled[next(iter(self._compiled))]
            self._compiled[shape] = self._compile(shape)
        return self._compiled[shape]

    def _compile(self, shape: tuple[int, ...]) -> _Compiled:
        return _Compiled(self._f, self._name, *shape, in_faces=self._in_faces)


class UFLField:
    """A UFL function of a vector with a vector for its value, as ``UFLFunction`` has scalars."""

    def __init__(self, f: Callable[[Any], Any], name: str):
        """Take the function; nothing is compiled before it is asked for.

        Args:
            f: From a UFL vector to a vector expression of the same shape.
            name: What it is, for messages.
        """
        self._f, self._name = f, name
        self._compiled: _Compiled | None = None

    def values(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Values, shape (n, gdim).

        Raises:
            ValueError: If it is not one of UFL, no such vector, or holds what it may not.
        """
        if self._compiled is None or self._compiled.shape != x.shape:
            self._compiled = _Compiled(self._f, self._name, *x.shape, is_field=True)
        return self._compiled.table(x)[:, :-1]


class _Compiled:
    """A UFL function of the position, compiled for n points: a scalar with its derivatives.

    UFL evaluates on cells: here a chain of n cells, with the position constant on each.
    """

    def __init__(
        self,
        f: Callable[[Any], Any],
        name: str,
        n: int,
        gdim: int,
        *,
        is_field: bool = False,
        in_faces: bool = False,
    ):
        self.shape = n, gdim
        chain = mesh.create_interval(MPI.COMM_SELF, n, [0.0, 1.0])
        self._position = fem.Function(fem.functionspace(chain, ("DG", 0, (gdim,))))
        X = ufl.variable(self._position)
        try:
            value = ufl.as_ufl(f(X))
        except Exception as error:
            raise ValueError(
                f"the function of a {name} is not one of UFL: one of Python needs its gradient, too"
            ) from error
        if value.ufl_shape != ((gdim,) if is_field else ()):
            raise ValueError(
                f"the function of a {name} gave an expression of shape {value.ufl_shape}: it "
                f"must be {f'a vector of {gdim} components' if is_field else 'a scalar'}"
            )
        others = set(ufl.algorithms.extract_coefficients(value)) - {self._position}
        if others or ufl.algorithms.analysis.extract_type(value, ufl.classes.GeometricQuantity):
            raise ValueError(
                f"the function of a {name} holds a function or the coordinates of a mesh: it may "
                "hold its argument and fem.Constant alone. Write it with these"
            )
        if is_field:
            parts = [value[i] for i in range(gdim)]
        else:
            parts = []
            for face in faces(value) if in_faces else [value]:
                gradient = ufl.diff(face, X)
                second = ufl.diff(gradient, X)
                parts += [face, *(gradient[i] for i in range(gdim))]
                parts += [second[i, j] for i in range(gdim) for j in range(gdim)]
        # The last is not read; what does not depend on the position needs a mesh all the same
        values = ufl.as_vector([*parts, self._position[0]])
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

    def table(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """All parts at each point, shape (n, number of parts + 1)."""
        self._position.x.array[:] = x.ravel()
        for theirs, ours in self._constants:
            ours.value[...] = theirs.value
        values: npt.NDArray[np.float64] = self._expression.eval(self._mesh, self._cells)
        return values.reshape(len(x), -1)

    def __call__(
        self, x: npt.NDArray[np.float64]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Of each face: shapes (faces, n), (faces, n, gdim), (faces, n, gdim, gdim)."""
        n, gdim = x.shape
        table = self.table(x)[:, :-1].reshape(n, -1, 1 + gdim + gdim**2).swapaxes(0, 1)
        second = table[:, :, 1 + gdim :].reshape(-1, n, gdim, gdim)
        return table[:, :, 0], table[:, :, 1 : 1 + gdim], second
