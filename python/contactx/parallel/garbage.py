# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""PETSc's objects of several ranks that Python has let go of."""

from __future__ import annotations

from mpi4py import MPI
from petsc4py import PETSc


def collect(comm: MPI.Comm) -> None:
    """Free them; all ranks must take part.

    petsc4py only puts them aside, as Python lets go of them at other times on other ranks. Without
    this the matrices of all iterations would stay.

    Args:
        comm: Communicator of the objects.
    """
    if comm.size > 1:
        PETSc.garbage_cleanup(comm)
