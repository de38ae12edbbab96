# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Newton steps that a material cannot take."""

from __future__ import annotations

from petsc4py import PETSc

import numpy as np

from contactx.bulk import Bulk
from contactx.callback import keeps_its_error
from contactx.parallel.reduce import everywhere
from contactx.system import SaddlePointSystem

_SHORTEST = 8


class Backtrack:
    """Halves Newton steps until the bulk has forces there, such as where no cell is inside out.

    A bulk that is linear has them everywhere, and is not asked.

    Attributes:
        error: Error that a callback raised.
    """

    def __init__(self, bulk: Bulk, system: SaddlePointSystem):
        """Take the bulk.

        Args:
            bulk: The bulk.
            system: The coupled system.
        """
        self._bulk, self._system = bulk, system
        self.error: BaseException | None = None

    @property
    def is_needed(self) -> bool:
        """Whether there are steps that the bulk cannot take."""
        return not self._bulk.is_linear

    @keeps_its_error
    def shorten(self, x: PETSc.Vec, y: PETSc.Vec) -> bool:
        """Shorten a step, as PETSc calls it before a line search; all ranks must take part.

        Args:
            x: Iterate.
            y: What is taken off it, changed in place.

        Returns:
            Whether it was changed.
        """
        trial = x.duplicate()
        for halved in range(_SHORTEST):
            trial.waxpy(-1.0, y, x)
            self._system.scatter(trial)
            if everywhere(x.comm.tompi4py(), np.isfinite(self._bulk.residual()).all()):
                return halved > 0
            y.scale(0.5)
        return True
