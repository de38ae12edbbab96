# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How much of a Newton step is taken."""

from __future__ import annotations

from collections.abc import Callable

from petsc4py import PETSc

import numpy as np

from contactx.audit.deformed_cells import DeformedCells
from contactx.bulk import Bulk
from contactx.parallel.reduce import norm
from contactx.system import SaddlePointSystem

# Part of min(det F, 1) that a step leaves in each cell. Measured from 0.1 to 0.5: rollers on soft
# blocks take the fewest iterations, and most of them converge
_LEFT = 0.4
# Trial steps of a damped one; the last is taken
_TRIALS = 6
# Part of a step that leads nowhere, and how many such in turn end the loop
_NOTHING = 1e-3
_STUCK = 3
# By how much a damped step is at least and at most shorter than the one before
_SHORTER = (0.1, 0.5)


class StepLength:
    """Shortens Newton steps that go too far; all ranks must take part.

    A step of a nonlinear bulk turns no cell inside out. Where steps are damped they also pass the
    natural monotonicity test (Deuflhard, Newton Methods for Nonlinear Problems, 2004, ch. 3): the
    next correction, by the same Jacobian, must be shorter. Residuals say little of slender bodies,
    whose stiffnesses differ by orders of magnitude.

    Attributes:
        part: Part of the last step that was taken.
        limited: Number of steps of this load step that cells have limited.
        damped: Number of steps that the test has shortened.
        is_stuck: Whether the last steps have led nowhere.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, cells: DeformedCells):
        """Take the bulk.

        Args:
            bulk: The bulk.
            system: The coupled system.
            cells: Its cells.
        """
        self._bulk, self._system, self._cells = bulk, system, cells
        self._comm = system.halo.comm
        self.begin_step(damped=False)

    def begin_step(self, *, damped: bool) -> None:
        """Start a step.

        Args:
            damped: Whether steps are damped.
        """
        self._is_damped = damped
        self.part = 1.0
        self.limited = self.damped = self._tiny = 0

    def shorten(
        self,
        snes: PETSc.SNES,
        x: PETSc.Vec,
        step: PETSc.Vec,
        residual: Callable[[PETSc.SNES, PETSc.Vec, PETSc.Vec], None],
    ) -> None:
        """Shorten a step.

        Args:
            snes: The solver, whose factors are those of the step.
            x: The iterate.
            step: What is to be taken off it, changed in place.
            residual: Evaluates the residual at an iterate.
        """
        self.part = 1.0
        if not np.isfinite(self._size(step)):
            return
        self.part = self._within_cells(step)
        self.limited += self.part < 1
        if self._is_damped:
            part = self._monotonous(snes, x, step, residual)
            self.damped += part < self.part
            self.part = part
        self._tiny = self._tiny + 1 if self.part < _NOTHING else 0
        if self.part < 1:
            step.scale(self.part)

    @property
    def is_stuck(self) -> bool:
        """See the class."""
        return self._tiny >= _STUCK

    def _size(self, vector: PETSc.Vec) -> float:
        """Norm of the displacements' part; multipliers are no lengths."""
        return float(norm(self._comm, self._system.blocks(vector.array_r)[0]))

    def _within_cells(self, step: PETSc.Vec) -> float:
        """Largest part of a step that turns no cell inside out."""
        if self._bulk.is_linear:
            return 1.0
        own = -self._system.blocks(step.array_r)[0].reshape(-1, self._system.block)
        way = self._system.halo.scatter_forward(own).ravel()
        u = self._bulk.u.x.array
        return self._cells.longest_way(u, way[: len(u)], _LEFT)

    def _monotonous(
        self,
        snes: PETSc.SNES,
        x: PETSc.Vec,
        step: PETSc.Vec,
        residual: Callable[[PETSc.SNES, PETSc.Vec, PETSc.Vec], None],
    ) -> float:
        """Largest tried part of a step after which the next correction is shorter."""
        ksp = snes.getKSP()
        trial, force, correction = (x.duplicate() for _ in range(3))
        size = self._size(step)
        part = self.part
        for _ in range(_TRIALS):
            trial.waxpy(-part, step, x)
            residual(snes, trial, force)
            shorter = _SHORTER[0]
            if np.isfinite(force.norm()):
                ksp.solve(force, correction)
                next_size = self._size(correction)
                if next_size <= (1 - part / 4) * size:
                    break
                # It is (1 - t) times this one, and a part that grows with the square of t
                square = 2 * abs(next_size / size - (1 - part)) / part**2 if size > 0 else 0.0
                shorter = 1 / (square * part) if square > 0 else 1.0
            part *= min(max(shorter, _SHORTER[0]), _SHORTER[1])
        residual(snes, x, force)
        return part
