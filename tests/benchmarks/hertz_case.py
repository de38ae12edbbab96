# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem as a benchmark: its mesh from a file, and its errors."""

from __future__ import annotations

import inspect
import shutil
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import runner
import scenes
from matplotlib.tri import LinearTriInterpolator, Triangulation

import contactx as cx
from contactx import meshes, reference
from dolfinx.io import XDMFFile
from dolfinx.io.gmsh import MeshData

DOWN = 0.02


def mesh_file(h: float) -> Path:
    """File of a mesh, made in a process of its own unless there is one.

    gmsh's memory and time are not those of a solver, and all runs shall have the same mesh.

    Args:
        h: Cell size in the contact.

    Raises:
        RuntimeError: If the mesh cannot be made.
    """
    folder = runner.OUTPUT / "meshes"
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / f"hertz_{h:g}"
    source = Path(inspect.getfile(meshes.hertz_sphere))
    if made.exists() and made.stat().st_mtime < source.stat().st_mtime:
        shutil.rmtree(made)
    if not made.exists():
        with tempfile.TemporaryDirectory(dir=folder) as work:
            result = runner.alone("hertz_case:write_mesh", h=h, folder=work)
            if "failed" in result:
                raise RuntimeError(f"no mesh of size {h:g}: {result['failed']}")
            (Path(work) / "whole").rename(made)
    return made / "mesh.xdmf"


def write_mesh(h: float, folder: str) -> dict[str, float]:
    """Mesh the problem into a file."""
    data = meshes.hertz_sphere(h)
    domain = data.mesh
    domain.name = "mesh"
    domain.topology.create_connectivity(2, 3)
    whole = Path(folder) / "whole"
    whole.mkdir()
    with XDMFFile(domain.comm, whole / "mesh.xdmf", "w") as file:
        file.write_mesh(domain)
        for name, tags in (("cells", data.cell_tags), ("facets", data.facet_tags)):
            tags.name = name
            file.write_meshtags(tags, domain.geometry)
    return {"cells": domain.topology.index_map(3).size_global}


def read_mesh(path: str | Path) -> MeshData:
    """Read such a file."""
    # contactx must load the wheels' MPI first
    from mpi4py import MPI

    with XDMFFile(MPI.COMM_WORLD, path, "r") as file:
        domain = file.read_mesh(name="mesh")
        domain.topology.create_connectivity(2, 3)
        cells, facets = (file.read_meshtags(domain, name) for name in ("cells", "facets"))
    return MeshData(domain, cells, facets, None, None, {})


def counts(problem: cx.ContactProblem) -> dict[str, Any]:
    """Size of a problem and what its last solve took."""
    report = problem.report
    return {
        "dofs": len(problem.u.x.array),
        "took": "condensed" if report.hierarchies or report.krylov else "direct",
        "iterations": report.iterations,
        "krylov": report.krylov,
        "hierarchies": report.hierarchies,
        "uncondensed": len(report.uncondensed),
    }


def errors(problem: cx.ContactProblem, contact: cx.Contact) -> dict[str, float]:
    """Errors as the peers' are measured: peak and L2 norm of the pressure, penetration."""
    force = 4 * float(contact.force[2])
    modulus = reference.contact_modulus(1.0, scenes.NU, 1.0, scenes.NU)
    peak = reference.HertzSphere(force=force, radius=1.0, modulus=modulus).peak_pressure
    return {
        "force": force,
        "p0_err": float(abs(contact.multiplier.max() / peak - 1)),
        "p_l2": scenes.pressure_error(problem, contact),
        "pen": _penetration(problem, contact) / DOWN,
    }


def _penetration(problem: cx.ContactProblem, contact: cx.Contact) -> float:
    """How deep the deepest slave node is below the deformed facets of the master.

    They are taken as a height over x and y, independent of the library's pairs and gaps.
    """
    V = problem.u.function_space
    x = V.tabulate_dof_coordinates() + problem.u.x.array.reshape(-1, 3)
    facets = contact.master.facet_nodes(V)
    nodes, corners = np.unique(facets.nodes, return_inverse=True)
    surface = Triangulation(x[nodes, 0], x[nodes, 1], corners.reshape(-1, 3))
    slaves = x[contact.slave_nodes]
    near = np.hypot(slaves[:, 0], slaves[:, 1]) < 0.3
    below = LinearTriInterpolator(surface, x[nodes, 2])(slaves[near, 0], slaves[near, 1])
    return float(np.ma.max(np.ma.maximum(below - slaves[near, 2], 0.0)))
