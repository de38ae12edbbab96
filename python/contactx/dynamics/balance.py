# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Energy and momentum of a time step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class Balance:
    """Energy and momentum at the end of a time step, and the work done in it.

    For linear elastic bodies energy is balanced to rounding: kinetic and strain energy grow by
    ``work_of_loads + work_of_supports - contact_loss``. In a nonlinear body the rest is the error
    of the midpoint rule. Momentum grows by the impulses of loads, supports and contacts.

    Attributes:
        dt: Length of the step, a time.
        kinetic: Kinetic energy at its end.
        strain: Strain energy at its end; None where no ``strain_energy`` was given.
        momentum: Momentum at its end, shape (gdim,).
        angular_momentum: Moment of momentum about the origin at its end: a number in 2D, shape (3,)
            in 3D.
        work_of_loads: Work of ``loads`` in the step.
        work_of_supports: Work of Dirichlet conditions in the step.
        contact_loss: Energy that contact has taken in the step, by impact and friction; negative
            where rigid obstacles that move have done work, or nodes have slid over curved or
            faceted surfaces, which turn in the step.
        impulse: Impulse on the slave side of each contact in the step, impacts included: a list
            of arrays of shape (gdim,). Over dt it is the mean force.
    """

    dt: float
    kinetic: float
    strain: float | None
    momentum: npt.NDArray[np.float64]
    angular_momentum: float | npt.NDArray[np.float64]
    work_of_loads: float
    work_of_supports: float
    contact_loss: float
    impulse: list[npt.NDArray[np.float64]]

    @property
    def energy(self) -> float:
        """Kinetic and, where it is known, strain energy."""
        return self.kinetic + (self.strain or 0.0)

    def lines(self) -> list[str]:
        """The balance as lines of text."""
        strain = "" if self.strain is None else f", strain energy {self.strain:.6g}"
        momentum = ", ".join(f"{p:.6g}" for p in self.momentum)
        return [
            f"time step {self.dt:.6g}: kinetic energy {self.kinetic:.6g}{strain}, momentum "
            f"({momentum})",
            f"work of loads {self.work_of_loads:.6g}, of supports {self.work_of_supports:.6g}, "
            f"lost in contact {self.contact_loss:.6g}",
        ]
