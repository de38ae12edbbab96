# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_one_rank.py under mpiexec."""

from mpi4py import MPI

import numpy as np

import contactx as cx
import ufl
from dolfinx import fem, mesh

domain = mesh.create_unit_cube(MPI.COMM_WORLD, 2, 2, 2)
u = fem.Function(fem.functionspace(domain, ("Lagrange", 1, (3,))))
F = ufl.inner(ufl.grad(u), ufl.grad(ufl.TestFunction(u.function_space))) * ufl.dx
facets = mesh.locate_entities_boundary(domain, 2, lambda x: np.isclose(x[2] * (1 - x[2]), 0))
below = mesh.compute_midpoints(domain, 2, facets)[:, 2] < 0.5
tags = mesh.meshtags(domain, 2, facets, np.where(below, 1, 2).astype(np.int32))
try:
    contact = cx.Contact(cx.Surface(tags, 1), cx.Surface(tags, 2))
    cx.ContactProblem(F, u, contacts=[contact], petsc_options_prefix="ranks_")
except RuntimeError as error:
    print(f"refused: {error}", flush=True)
