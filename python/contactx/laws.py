# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Laws of friction that a user gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx._host.ufl_function import UFLFunction

type Array = npt.NDArray[np.float64]


class FrictionLaw:
    """Friction with any bound of the tangential traction: |t| <= f(p, s).

    p is the pressure, force/reference area, and s the accumulated slip of a slave node, a length,
    over all accepted steps and this one. Slip is opposite to t, as with Coulomb's law; see
    theory/friction of the manual. For example::

        cx.FrictionLaw(lambda p, s: ufl.as_ufl(0.1))                       # Tresca
        cx.FrictionLaw(lambda p, s: ufl.min_value(0.3 * p, 0.1))           # up to a limit
        cx.FrictionLaw(lambda p, s: (0.2 + 0.1 * ufl.exp(-s / 1e-3)) * p)  # weaker with slip
    """

    def __init__(
        self,
        f: Callable[[Any, Any], Any],
        gradient: Callable[[Array, Array], tuple[npt.ArrayLike, npt.ArrayLike]] | None = None,
    ):
        """Create a law.

        Args:
            f: Bound of the tangential traction, at least 0. Either of UFL: it takes two scalars
                and returns a scalar expression, which may hold ``fem.Constant`` and is
                differentiated by UFL. Or of Python: it takes arrays of shape (n,) and returns one.
            gradient: Derivatives of a Python function by p and by s, two arrays of shape (n,).

        Raises:
            TypeError: If f or gradient is not callable.
        """
        for name, given in (("f", f), ("gradient", gradient)):
            if not callable(given) and not (name == "gradient" and given is None):
                raise TypeError(
                    f"{name} of a FrictionLaw must be a function, not {type(given).__name__}"
                )
        self._f, self._gradient = f, gradient
        self._ufl = UFLFunction(lambda x: f(x[0], x[1]), "FrictionLaw")

    def values(self, p: Array, s: Array) -> tuple[Array, Array, Array]:
        """Evaluate the bound of the tangential traction and its derivatives.

        Args:
            p: Pressures, force/area, shape (n,).
            s: Lengths of slip, shape (n,).

        Returns:
            The bound, force/area, and its derivatives by p and by s, shape (n,) each.

        Raises:
            ValueError: If the function is not of UFL and has no gradient, or a shape does not fit.
        """
        if len(p) == 0:
            return p, p, p
        if self._gradient is None:
            bound, gradient, _ = self._ufl.values(np.column_stack([p, s]), 1)
            return bound[0], gradient[0, :, 0].copy(), gradient[0, :, 1].copy()
        given = (self._f(p, s), *self._gradient(p, s))
        found = [np.asarray(values, dtype=np.float64) for values in given]
        for name, values in zip(
            ("bound", "derivative by p", "derivative by s"), found, strict=True
        ):
            if values.shape not in ((), p.shape):
                raise ValueError(
                    f"the {name} of a FrictionLaw has the shape {values.shape} for {len(p)} "
                    f"pressures: it must be {p.shape}"
                )
        bound, by_p, by_s = (np.broadcast_to(values, p.shape).copy() for values in found)
        return bound, by_p, by_s
