# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""How much of a Newton step is taken."""

from __future__ import annotations

from collections.abc import Callable

from petsc4py import PETSc

import numpy as np

from contactx import cpp as core
from contactx.audit.deformed_cells import DeformedCells
from contactx.bulk import Bulk
from contactx.parallel.reduce import norm
from contactx.system import SaddlePointSystem


class StepLength:
    """The core's rule of how much of a Newton step is taken, see ``step_length.h``.

    All ranks must take part.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem, cells: DeformedCells):
        """Take the bulk.

        Args:
            bulk: The bulk.
            system: The coupled system.
            cells: Its cells.
        """
        self._bulk, self._system, self._cells = bulk, system, cells
        self._rule = core.StepLength()

    def begin_step(self, *, damped: bool) -> None:
        """Start a step.

        Args:
            damped: Whether steps are damped.
        """
        self._rule.begin_step(damped)

    @property
    def part(self) -> float:
        """Part of the last step that was taken."""
        return self._rule.part

    @property
    def limited(self) -> int:
        """Number of steps of this load step that cells have limited."""
        return self._rule.limited

    @property
    def damped(self) -> int:
        """Number of steps that the test of monotonicity has shortened."""
        return self._rule.damped

    @property
    def is_stuck(self) -> bool:
        """Whether the last steps have led nowhere."""
        return self._rule.is_stuck

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
        size = self._size(step)
        self._rule.begin(size, self._within_cells(step) if np.isfinite(size) else 1.0)
        if self._rule.has_trial:
            self._try(snes, x, step, residual)
        if self._rule.part < 1:
            step.scale(self._rule.part)

    def _size(self, vector: PETSc.Vec) -> float:
        """Norm of the displacements' part."""
        return norm(self._system.halo.comm, self._system.blocks(vector.array_r)[0])

    def _within_cells(self, step: PETSc.Vec) -> float:
        """Largest part of a step that turns no cell inside out."""
        if self._bulk.is_linear:
            return 1.0
        own = -self._system.blocks(step.array_r)[0].reshape(-1, self._system.block)
        way = self._system.halo.scatter_forward(own).ravel()
        u = self._bulk.u.x.array
        return self._cells.longest_way(u, way[: len(u)], core.StepLength.left)

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
                next_size = self._size(correction)
            self._rule.judge(next_size)
        residual(snes, x, force)
