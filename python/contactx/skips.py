# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a contact does not need."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np

from contactx.interface import Interface
from contactx.parallel.reduce import total


def skips(interface: Interface, gdim: int, comm: MPI.Comm) -> dict[str, int]:
    """What a contact does not need, and how often: nodes, unknowns and searches.

    Args:
        interface: Discrete side of the contact.
        gdim: Geometric dimension.
        comm: Communicator.
    """
    counts = np.array([len(interface.slaves), interface.master.paired.sum()])
    n, paired = total(comm, counts).tolist()
    return {
        "search": interface.skipped_searches,
        "pairs out of reach": n - paired,
        "tangential unknowns": 0 if interface.law.is_vector else n * (gdim - 1),
        "master sides": paired if interface.master.is_rigid else 0,
    }
