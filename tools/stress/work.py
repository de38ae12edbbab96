# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Work that is put into bodies without friction, against the energy that they store.

All materials of the map have an energy. What a step adds to it is the work of the bodies' own
forces along the straight way from the state before, which Gauss's points find from the residual
alone; what the residual is at rest are loads. Work of loads and of prescribed displacements is
taken by the trapezoidal rule over the steps. Contact without friction does no work on two bodies
together, so that both are the same but for the error of that rule. Of a force that only rises or
only falls within a step it is at most half of its change, times the way.

Nothing is said:

- of obstacles, whose movement is not known here, and of offsets, which do work themselves;
- before ``LEAST`` states, and of the way to the first one: bodies may overlap at the start;
- where that bound is more than ``MOST`` of the work, as in few long steps, or where bodies go up
  and down a slope within one;
- of a step that snaps: bodies move ``SNAPS`` times as far as what is moved, and less is stored than
  given. An arch that leaves its symmetric shape within a step releases energy, which statics loses;
- by surface-to-surface, where the slave's facets are ``COARSE`` times as long as the master's, or
  the master has an edge: facets that are covered in part measure their gaps over what is covered,
  and how that changes is left out of the forces. That is 12 % of the energy of a disc of a
  twentieth of a facet, and 5 % with an edge that is pressed into an arm.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dolfinx import fem

from stress import faces
from stress.check import Check
from stress.faces import Array, Numbers

LEAST, MOST, COARSE, SNAPS = 4, 0.3, 2.0, 2.0
# What is left where the rule is exact
_EXACT = 1e-3
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)


def covers(slave: Numbers, master: Numbers, x: Array) -> bool:
    """Whether the slave's facets are mostly covered wholly."""
    fine = faces.sizes(x[slave]).max() < COARSE * faces.sizes(x[master]).max()
    return bool(fine) and len(faces.edges(master, x)) == 0


class Work:
    """The sums over the steps of a problem, from its first state on."""

    def __init__(self, u: fem.Function, residual: Callable[[], Array], fixed: Array):
        """Prepare what does not change.

        Args:
            u: Displacement.
            residual: Residual of the bodies at its present values.
            fixed: Where it is prescribed.
        """
        self._u, self._forces, self._fixed = u, residual, fixed
        self._states = 0
        self._before: tuple[Array, Array]
        self._stored = self._given = self._size = self._open = 0.0

    def __call__(self, small: Array) -> Check:
        """Take the present state, and compare.

        Args:
            small: What of each force is rounding, shape (num_dofs,).
        """
        u = self._u.x.array.copy()
        at_rest = self._residual(np.zeros_like(u))
        # What acts from outside: reactions and loads
        given = np.where(self._fixed, self._residual(u), 0.0) - at_rest
        if self._states > 0:
            u0, given0 = self._before
            step = u - u0
            stored = 0.0
            for point, weight in zip(_POINTS, _WEIGHTS, strict=True):
                inner = self._residual(u0 + 0.5 * (1 + point) * step) - at_rest
                stored += 0.5 * weight * float(inner @ step)
            of_step = 0.5 * float((given0 + given) @ step)
            open_ = float((0.5 * np.abs(given - given0) + small) @ np.abs(step))
            if not (self._snaps(step) and of_step - stored > open_):
                self._stored += stored
                self._given += of_step
                self._size += 0.5 * float(np.abs(given0 + given) @ np.abs(step))
                self._open += open_
        self._before = u, given
        self._states += 1
        size = max(self._size, 1e-300)
        explained = self._open / size
        lost = abs(self._given - self._stored) / size
        if self._states < LEAST or explained > MOST:
            lost = 0.0
        return Check("work without friction is stored", lost, explained + _EXACT)

    def _snaps(self, step: Array) -> bool:
        """Whether bodies move farther than what is moved, if anything is."""
        way = np.abs(step)
        return 0 < SNAPS * float(way[self._fixed].max(initial=0.0)) < float(way.max())

    def _residual(self, u: Array) -> Array:
        now = self._u.x.array.copy()
        self._u.x.array[:] = u
        try:
            return self._forces()
        finally:
            self._u.x.array[:] = now
