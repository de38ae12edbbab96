# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacle that a function describes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import ufl
from contactx.obstacles.obstacle import Geometry, Obstacle, Placement
from dolfinx import fem, mesh

# Numbers of points that a function of UFL is kept compiled for
_MOST_COMPILED = 3


class LevelSet(Obstacle):
    """Body where a function is negative; bodies may be where it is positive.

    The function need not be a distance: its zero is the surface, and g = f / |grad f| is the
    distance to first order. A function that changes tells of no movement along its surface: for
    friction its material is at rest, and a step in which it changes while it is touched is refused.
    Plane, Sphere and Cylinder drag what touches them.
    """

    usual_mistake = (
        "Perhaps the sign of its function is wrong: it must be positive where bodies may be"
    )
    tells_movement = False

    def __init__(
        self,
        f: Callable[[Any], Any],
        gradient: Callable[[npt.NDArray[np.float64]], npt.ArrayLike] | None = None,
    ):
        """Create an obstacle.

        Args:
            f: Function of the position. Either of UFL: it takes a UFL vector of shape (gdim,)
                and returns a scalar expression, which may hold ``fem.Constant`` and is
                differentiated by UFL. Or of Python: it takes an array of shape (gdim, n), as in
                ``Function.interpolate``, and returns one of shape (n,).
            gradient: Gradient of a Python function, from (gdim, n) to (gdim, n).

        Raises:
            TypeError: If f or gradient is not callable.
        """
        if not callable(f):
            raise TypeError(f"f of a LevelSet must be a function, not {type(f).__name__}")
        if gradient is not None and not callable(gradient):
            raise TypeError(
                f"gradient of a LevelSet must be a function, not {type(gradient).__name__}"
            )
        self._f = f
        self._gradient = gradient
        self._compiled: dict[tuple[int, ...], _Compiled] = {}

    def evaluate(self, x: npt.NDArray[np.float64]) -> Geometry:
        """See ``Obstacle``; g = f / |grad f|.

        Raises:
            ValueError: If a Python function has no gradient, a shape does not fit, or the
                function or its gradient is not finite or its gradient zero at a slave node.
        """
        n, gdim = x.shape
        if n == 0:
            # A rank without slave nodes: neither UFL nor a user's function needs to take that
            return Geometry(*(np.zeros((0,) + (gdim,) * k) for k in (0, 1, 1, 2)))
        if self._gradient is None:
            f, g, H = self._compiled_for(x)(x)
        else:
            f, g = self._values(x)
            H = self._second_derivative(x)
        size = np.linalg.norm(g, axis=1)
        bad = ~(np.isfinite(f) & np.isfinite(size) & (size > 0))
        if bad.any():
            raise ValueError(
                f"the function of a LevelSet or its gradient is not finite, or the gradient zero, "
                f"at {bad.sum()} slave nodes, first at {x[np.flatnonzero(bad)[0]]}: the gradient "
                "must point outward wherever a slave node may come"
            )
        normal = g / size[:, None]
        projector = np.eye(gdim) - normal[:, :, None] * normal[:, None, :]
        curvature = np.einsum("nij,njk->nik", projector, H) / size[:, None, None]
        along = np.einsum("nij,nj->ni", H, normal)
        gap = f / size
        gradient = normal - gap[:, None] * along / size[:, None]
        return Geometry(gap, gradient, normal, curvature)

    def distance(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Obstacle``; points between slave nodes may be where the function means nothing."""
        f, _, size = self._first_order(x)
        gap = np.copysign(np.inf, f)
        np.divide(f, size, out=gap, where=size > 0)
        gap[~np.isfinite(f) | ~np.isfinite(size)] = np.inf
        return gap

    def normals(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Obstacle``."""
        _, g, size = self._first_order(x)
        usable = np.isfinite(size) & (size > 0)
        return np.divide(g, size[:, None], out=np.zeros_like(g), where=usable[:, None])

    def _first_order(self, x: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], ...]:
        """Function, its gradient and the size of that."""
        if len(x) == 0:
            return np.zeros(0), np.zeros(x.shape), np.zeros(0)
        f, g = self._values(x) if self._gradient is not None else self._compiled_for(x)(x)[:2]
        return f, g, np.linalg.norm(g, axis=1)

    def _compiled_for(self, x: npt.NDArray[np.float64]) -> _Compiled:
        if x.shape not in self._compiled:
            # Slave nodes, points of slave facets, and what the audit looks at
            while len(self._compiled) >= _MOST_COMPILED:
                del self._compiled[next(iter(self._compiled))]
            self._compiled[x.shape] = _Compiled(self._f, *x.shape)
        return self._compiled[x.shape]

    def placement(self, gdim: int) -> Placement:
        """See ``Obstacle``; a function tells of no movement, so its material counts as at rest."""
        return Placement(np.zeros(gdim))

    def parameters(self) -> npt.NDArray[np.float64]:
        """See ``Obstacle``; the constants of a UFL function that has been evaluated."""
        values = [np.zeros(0), *(c.constants() for c in self._compiled.values())]
        return np.concatenate(values)

    def level(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """See ``Obstacle``; the function itself."""
        if len(x) == 0:
            return np.zeros(0)
        if self._gradient is not None:
            return self._values(x)[0]
        compiled = self._compiled.get(x.shape) or _Compiled(self._f, *x.shape)
        return compiled(x)[0]

    def _values(
        self, x: npt.NDArray[np.float64]
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Value and gradient of a Python function, shapes (n,) and (n, gdim)."""
        assert self._gradient is not None
        f, g = (_real(np.asarray(function(x.T))) for function in (self._f, self._gradient))
        if f.shape != (len(x),) or g.shape != x.T.shape:
            raise ValueError(
                f"for points of shape {x.T.shape} the function of a LevelSet gave shape {f.shape} "
                f"and its gradient {g.shape}; they must be ({len(x)},) and {x.T.shape}"
            )
        return f, g.T

    def _second_derivative(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Central differences of the gradient, symmetric, shape (n, gdim, gdim).

        They only serve the tangent: the solution does not depend on them.
        """
        # Not a length of these points alone: which ones they are depends on the partition
        size = self.extent or np.ptp(x, axis=0).max()
        h = 1e-6 * np.maximum(np.abs(x).max(axis=1, keepdims=True) * 1e-3, max(size, 1e-30))
        columns = []
        for i in range(x.shape[1]):
            dx = h * np.eye(x.shape[1])[i]
            columns.append((self._values(x + dx)[1] - self._values(x - dx)[1]) / (2 * h))
        H = np.stack(columns, axis=2)
        symmetric: npt.NDArray[np.float64] = (H + H.transpose(0, 2, 1)) / 2
        return symmetric


def _real(values: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """What a Python function gave, shape as it is."""
    if values.dtype.kind not in "biuf":
        raise TypeError(
            f"the function of a LevelSet or its gradient gave values of type {values.dtype}: they "
            "must be real numbers"
        )
    real: npt.NDArray[np.float64] = values.astype(np.float64)
    return real


class _Compiled:
    """A UFL function of the position with its derivatives, compiled for n points.

    UFL evaluates on cells: here a chain of n cells, with the position constant on each.
    """

    def __init__(self, f: Callable[[Any], Any], n: int, gdim: int):
        chain = mesh.create_interval(MPI.COMM_SELF, n, [0.0, 1.0])
        self._position = fem.Function(fem.functionspace(chain, ("DG", 0, (gdim,))))
        X = ufl.variable(self._position)
        try:
            value = ufl.as_ufl(f(X))
        except Exception as error:
            raise ValueError(
                "the function of a LevelSet is not one of UFL: for a function of Python give its "
                "gradient too, LevelSet(f, gradient)"
            ) from error
        if value.ufl_shape != ():
            raise ValueError(
                f"the function of a LevelSet gave an expression of shape {value.ufl_shape}: it "
                "must be a scalar"
            )
        others = set(ufl.algorithms.extract_coefficients(value)) - {self._position}
        if others or ufl.algorithms.analysis.extract_type(value, ufl.classes.GeometricQuantity):
            raise ValueError(
                "the function of a LevelSet holds a function or the coordinates of a mesh: it may "
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
