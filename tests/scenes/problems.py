# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What most scenes do alike: the contact of two bodies, problems, direct solvers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from petsc4py import PETSc

import contactx as cx
from dolfinx import fem, mesh

from meshes import Tag


def pair_of(tags: mesh.MeshTags, **options: Any) -> cx.Contact:
    """The upper body, the slave, on the lower one."""
    slave, master = (cx.Surface(tags, tag) for tag in (Tag.UPPER_CONTACT, Tag.LOWER_CONTACT))
    return cx.Contact(slave, master, **options)


def make_problem(
    F: Any,
    u: fem.Function,
    contacts: Sequence[cx.Contact],
    bcs: Sequence[fem.DirichletBC] = (),
    **options: Any,
) -> cx.ContactProblem:
    """A problem whose options of PETSc have a prefix of the tests."""
    options = {"petsc_options_prefix": "tests_", **options}
    return cx.ContactProblem(F, u, contacts=contacts, bcs=bcs, **options)


def direct_solver() -> PETSc.KSP:
    """For Newton loops of one's own."""
    ksp = PETSc.KSP().create()
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    return ksp
