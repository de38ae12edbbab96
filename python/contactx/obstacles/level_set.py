# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid obstacle that a function describes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx import cpp as core
from contactx._host.checks import is_number
from contactx._host.ufl_function import UFLField, UFLFunction, Values
from dolfinx import fem


class LevelSet(core.LevelSet):
    """Rigid body where a function is negative; deformable bodies may be where it is positive.

    The function need not be a distance: its zero is the surface, and g = f / |grad f| is the
    distance to first order. Beyond a ridge or an apex, as of ``max_value``, the closest point is on
    it; there the normal is the axis of the cone of normals. A change of the function does not tell
    how the material moves along the surface. For friction the material is at rest, and a step in
    which the function changes while the obstacle is touched is refused, unless it has a velocity.
    Plane, Sphere and Cylinder drag what touches them.
    """

    def __init__(
        self,
        f: Callable[[Any], Any],
        gradient: Callable[[npt.NDArray[np.float64]], npt.ArrayLike] | None = None,
        *,
        velocity: Callable[[Any], Any] | None = None,
        time: float | fem.Constant | None = None,
    ):
        """Create an obstacle.

        Args:
            f: Function of the position. Either of UFL: it takes a UFL vector of shape (gdim,)
                and returns a scalar expression, which may hold ``fem.Constant`` and is
                differentiated by UFL. Or of Python: it takes an array of shape (gdim, n), as in
                ``Function.interpolate``, and returns one of shape (n,), or for a convex body with
                ridges one of shape (m, n): a function for each of its m faces, of which the
                largest counts. ``max_value`` and ``abs`` of UFL tell these by themselves.
            gradient: Gradient of a Python function, from (gdim, n) to (gdim, n) or (m, gdim, n).
            velocity: Velocity of its material, such as that of a belt, which drags what touches it
                by friction or ties. A function of the position: in UFL with a vector as its value
                if f is in UFL, else of arrays as the gradient. It must agree with the change of f.
            time: Time, a number or a ``fem.Constant``: in a step the material moves with the
                velocity for the change of this time.

        Raises:
            TypeError: If f, gradient or velocity is not callable, or the time no number.
            ValueError: If there is a velocity without a time, or a time without a velocity.
        """
        if not callable(f):
            raise TypeError(f"f of a LevelSet must be a function, not {type(f).__name__}")
        if gradient is not None and not callable(gradient):
            raise TypeError(
                f"gradient of a LevelSet must be a function, not {type(gradient).__name__}"
            )
        if velocity is not None and not callable(velocity):
            raise TypeError(
                f"velocity of a LevelSet must be a function, not {type(velocity).__name__}"
            )
        if (velocity is None) != (time is None):
            given, missing = ("velocity", "time") if time is None else ("time", "velocity")
            raise ValueError(
                f"a LevelSet has a {given} but no {missing}: what its material moves by in a step "
                "needs both"
            )
        # Not methods of this object: what the core keeps must not keep the obstacle
        function = (
            UFLFunction(f, "LevelSet", in_faces=True)
            if gradient is None
            else _OfPython(f, gradient)
        )
        if velocity is None:
            super().__init__(function.values, function.parameters)
            return
        clock = _Clock(time)
        clock()
        field = UFLField(velocity, "LevelSet's velocity") if gradient is None else _Field(velocity)
        super().__init__(function.values, function.parameters, field.values, clock)


class _OfPython:
    """A Python function with its gradient."""

    def __init__(
        self,
        f: Callable[[Any], Any],
        gradient: Callable[[npt.NDArray[np.float64]], npt.ArrayLike],
    ):
        self._f, self._gradient = f, gradient

    def values(self, x: npt.NDArray[np.float64], order: int) -> Values:
        """Value and gradient of each face, shapes (faces, n) and (faces, n, gdim).

        The core makes differences of them.

        Raises:
            TypeError: If they are no real numbers.
            ValueError: If a shape does not fit.
        """
        f, g = (_real(np.asarray(function(x.T))) for function in (self._f, self._gradient))
        several = f.shape[:-1]
        if len(several) > 1 or f.shape[-1:] != (len(x),) or g.shape != (*several, *x.T.shape):
            raise ValueError(
                f"for points of shape {x.T.shape} the function of a LevelSet gave shape {f.shape} "
                f"and its gradient {g.shape}; they must be ({len(x)},) and {x.T.shape}, or, of m "
                f"faces, (m, {len(x)}) and (m, {x.shape[1]}, {len(x)})"
            )
        return np.atleast_2d(f), np.moveaxis(g, -2, -1), None

    def parameters(self, gdim: int) -> npt.NDArray[np.float64]:
        """None that are known, shape (0,)."""
        return np.zeros(0)


class _Field:
    """A velocity that a Python function gives."""

    def __init__(self, velocity: Callable[[Any], Any]):
        self._velocity = velocity

    def values(self, x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """Values, shape (n, gdim).

        Raises:
            TypeError: If they are no real numbers.
            ValueError: If their shape does not fit.
        """
        v = _real(np.asarray(self._velocity(x.T)))
        if v.shape != x.T.shape:
            raise ValueError(
                f"for points of shape {x.T.shape} the velocity of a LevelSet has shape {v.shape}; "
                "it must be the same"
            )
        return v.T


class _Clock:
    """The current time."""

    def __init__(self, time: Any):
        self._time = time

    def __call__(self) -> float:
        given = self._time.value if isinstance(self._time, fem.Constant) else self._time
        if not is_number(given):
            raise TypeError(
                f"time of a LevelSet is {given!r}: give a number, or a fem.Constant of one"
            )
        return float(given)


def _real(values: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Convert the values of a Python function to real numbers, their shape unchanged."""
    if values.dtype.kind not in "biuf":
        raise TypeError(
            f"the function of a LevelSet or its gradient gave values of type {values.dtype}: they "
            "must be real numbers"
        )
    real: npt.NDArray[np.float64] = values.astype(np.float64)
    return real
