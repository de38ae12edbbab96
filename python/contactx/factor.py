# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Factor c of the gap in the complementarity."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from contactx.interface import Interface
from contactx.parallel.halo import Halo
from contactx.parallel.reduce import total


def set_factors(
    interfaces: Sequence[Interface], stiffness: npt.NDArray[np.float64], halo: Halo
) -> None:
    """Set the factor: the stiffness of a pair over the slave node's area.

    Slave node and master facet are springs in series: where one is much stiffer than the other, the
    softer one decides how fast a gap closes. Any c > 0 has the same solution. All ranks must take
    part.

    Args:
        interfaces: Discrete sides of the contacts.
        stiffness: Stiffness of each owned node, force/length, NaN where one cannot move.
        halo: Nodes of this rank.
    """
    own = np.zeros_like(stiffness)
    np.divide(1, stiffness, out=own, where=stiffness > 0)
    compliance = halo.extend(own)
    for interface in interfaces:
        nodes = interface.nodes
        product = compliance[interface.slaves] + interface.master.compliance(compliance)
        product *= nodes.area
        usable = product[product > 0]
        logs, count = total(halo.comm, np.array([np.log(usable).sum(), len(usable)]))
        # Where nothing can move: the geometric mean of the others
        usual = np.exp(logs / count) if count > 0 else 1.0
        nodes.c[:] = 1 / np.where(product > 0, product, usual)
