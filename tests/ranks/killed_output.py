# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_killed.py: writes steps until one rank is killed, some time after the first step."""

import os
import subprocess
import sys
from pathlib import Path

from mpi4py import MPI

import contactx as cx
from dolfinx import fem, mesh

WORLD = MPI.COMM_WORLD
# Steps that no run comes to
MOST = 10_000

if __name__ == "__main__":
    folder, seconds, rank = Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])
    domain = mesh.create_unit_square(WORLD, 60, 60)
    u = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (2,))), name="u")
    with cx.VTKOutput(folder / "run.pvd", u, []) as output:
        for step in range(MOST):
            u.x.array[:] = step
            output.write(float(step))
            if step == 0 and WORLD.rank == rank:
                subprocess.Popen(["sh", "-c", f"sleep {seconds}; kill -KILL {os.getpid()}"])
