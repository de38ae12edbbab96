# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Which law a contact has."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from contactx.law.coulomb import Coulomb, Tied
from contactx.law.law import Frictionless, Law
from contactx.nodal import NodalValue
from dolfinx import fem


def make_law(
    tied: bool,
    friction: float | fem.Constant | fem.Function,
    V: fem.FunctionSpace,
    slaves: npt.NDArray[np.int32],
) -> Law:
    """Make the law of a contact.

    Args:
        tied: Whether the slave nodes keep their place on the master.
        friction: Coefficient of friction; the number 0 for none.
        V: Space of the displacement.
        slaves: Slave nodes of this rank, shape (n,).

    Raises:
        ValueError: If friction is a function of another space, or a constant that is no number.
    """
    if tied:
        return Tied()
    if friction != 0:
        return Coulomb(NodalValue(friction, "friction", V, slaves), V.mesh.comm)
    return Frictionless()
