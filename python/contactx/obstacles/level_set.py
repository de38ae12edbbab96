# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacle that a function describes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx.ufl_function import UFLFunction, Values


class LevelSet(core.LevelSet):
    """Body where a function is negative; bodies may be where it is positive.

    The function need not be a distance: its zero is the surface, and g = f / |grad f| is the
    distance to first order. A function that changes tells of no movement along its surface: for
    friction its material is at rest, and a step in which it changes while it is touched is refused.
    Plane, Sphere and Cylinder drag what touches them.
    """

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
        # Not methods of this object: what the core keeps must not keep the obstacle
        function = UFLFunction(f, "LevelSet") if gradient is None else _OfPython(f, gradient)
        super().__init__(function.values, function.parameters)


class _OfPython:
    """A Python function with its gradient."""

    def __init__(
        self,
        f: Callable[[Any], Any],
        gradient: Callable[[npt.NDArray[np.float64]], npt.ArrayLike],
    ):
        self._f, self._gradient = f, gradient

    def values(self, x: npt.NDArray[np.float64], order: int) -> Values:
        """Value and gradient, shapes (n,) and (n, gdim); the core makes differences of them.

        Raises:
            TypeError: If they are no real numbers.
            ValueError: If a shape does not fit.
        """
        f, g = (_real(np.asarray(function(x.T))) for function in (self._f, self._gradient))
        if f.shape != (len(x),) or g.shape != x.T.shape:
            raise ValueError(
                f"for points of shape {x.T.shape} the function of a LevelSet gave shape {f.shape} "
                f"and its gradient {g.shape}; they must be ({len(x)},) and {x.T.shape}"
            )
        return f, g.T, None

    def parameters(self, gdim: int) -> npt.NDArray[np.float64]:
        """None that are known, shape (0,)."""
        return np.zeros(0)


def _real(values: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """What a Python function gave, shape as it is."""
    if values.dtype.kind not in "biuf":
        raise TypeError(
            f"the function of a LevelSet or its gradient gave values of type {values.dtype}: they "
            "must be real numbers"
        )
    real: npt.NDArray[np.float64] = values.astype(np.float64)
    return real
