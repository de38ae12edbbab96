# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Length of Newton steps."""

from __future__ import annotations

from collections.abc import Callable

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core


class StepLength:
    """The core's rule of how much of a Newton step is taken, see ``step_length.h``.

    All ranks must take part.
    """

    def __init__(self, loop: core.Loop):
        """Take the loop.

        Args:
            loop: The loop, whose rule this is.
        """
        self._loop, self._rule = loop, loop.length

    @property
    def limited(self) -> int:
        """Number of steps of this load step that cells have limited."""
        return self._rule.limited

    @property
    def damped(self) -> int:
        """Number of steps that the test of monotonicity has shortened."""
        return self._rule.damped

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
        self._loop.foresee(step.array_r)
        size = self._loop.size_of(step.array_r)
        self._rule.begin(size, self._within_cells(step) if np.isfinite(size) else 1.0)
        if self._rule.has_trial:
            self._try(snes, x, step, residual)
        if self._rule.part < 1:
            step.scale(self._rule.part)

    def _within_cells(self, step: PETSc.Vec) -> float:
        """Largest part of a step that turns no cell inside out."""
        return self._loop.within_cells(step.array_r)

    def _try(
        self,
        snes: PETSc.SNES,
        x: PETSc.Vec,
        step: PETSc.Vec,
        residual: Callable[[PETSc.SNES, PETSc.Vec, PETSc.Vec], None],
    ) -> None:
        """Try parts of a step."""
        ksp = snes.getKSP()
        trial, force, correction = (x.duplicate() for _ in range(3))
        while self._rule.has_trial:
            trial.waxpy(-self._rule.part, step, x)
            residual(snes, trial, force)
            next_size = np.inf
            if np.isfinite(force.norm()):
                ksp.solve(force, correction)
                next_size = self._loop.size_of(correction.array_r)
            self._rule.judge(next_size)
        residual(snes, x, force)
