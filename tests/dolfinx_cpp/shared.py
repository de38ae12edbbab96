# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the scripts share: mesh files, solvers, and figures as C++ programs print them."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import contactx as cx  # isort: skip

from mpi4py import MPI
from petsc4py import PETSc

from dolfinx import io

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "demos"))

LU = {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}


def direct() -> PETSc.KSP:
    """A direct solver for a loop of one's own."""
    ksp = PETSc.KSP().create(MPI.COMM_WORLD)
    ksp.setType("preonly")
    ksp.getPC().setType("lu")
    ksp.getPC().setFactorSolverType("mumps")
    return ksp


def newton_step(
    assembler: cx.ContactAssembler, ksp: PETSc.KSP, b: PETSc.Vec, dx: PETSc.Vec
) -> None:
    """One step of Newton's method."""
    assembler.residual(b)
    b.scale(-1)
    assembler.set_up(ksp)
    ksp.solve(b, dx)
    assembler.update(dx, assembler.limit(dx))


def read(name: str) -> tuple[Any, Any]:
    """Mesh and facet tags of a file."""
    with io.XDMFFile(MPI.COMM_WORLD, f"{name}.xdmf", "r") as file:
        domain = file.read_mesh(name="mesh")
        facets = domain.topology.dim - 1
        domain.topology.create_entities(facets)
        domain.topology.create_connectivity(facets, facets + 1)
        return domain, file.read_meshtags(domain, "facet_tags")


def write(name: str, domain: Any, tags: Any) -> None:
    """Write them, on one rank."""
    domain.name, tags.name = "mesh", "facet_tags"
    with io.XDMFFile(MPI.COMM_SELF, f"{name}.xdmf", "w") as file:
        file.write_mesh(domain)
        domain.topology.create_connectivity(domain.topology.dim - 1, domain.topology.dim)
        file.write_meshtags(tags, domain.geometry)


def sentence(text: str) -> str:
    """First sentence of a message."""
    return text.removeprefix("contact did not converge: ").split(". ")[0].split("\n")[0]


def show(*words: Any) -> None:
    """Print on the first rank."""
    if MPI.COMM_WORLD.rank == 0:
        print(*words)


def texts(figures: Iterable[float]) -> list[str]:
    """Numbers as they are printed."""
    # Rounding has a sign
    return [f"{0.0 if abs(f) < 5e-14 else f:.13f}" for f in figures]
