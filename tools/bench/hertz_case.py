# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem as a benchmark: its meshes from files, and its errors."""

from __future__ import annotations

import inspect
import shutil
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import runner
from matplotlib.tri import LinearTriInterpolator, Triangulation

import basix.ufl
import contactx as cx
import ufl
from dolfinx.io import XDMFFile
from dolfinx.io.gmsh import MeshData
from dolfinx.mesh import create_mesh

import meshes
import scenes
from meshes import Tag

DOWN = 0.02
MESHES = {
    "tetrahedra": meshes.hertz_sphere,
    "curved": partial(meshes.hertz_sphere, order=2),
    "hexahedra": meshes.hertz_grid,
}


def mesh_file(h: float, cells: str = "tetrahedra") -> Path:
    """File of a mesh, made in a process of its own unless there is one.

    gmsh's memory and time are not those of a solver, and all runs shall have the same mesh.

    Args:
        h: Cell size in the contact.
        cells: One of ``MESHES``.

    Raises:
        RuntimeError: If the mesh cannot be made.
    """
    folder = runner.OUTPUT / "meshes"
    folder.mkdir(parents=True, exist_ok=True)
    made = folder / f"hertz_{cells}_{h:g}"
    make = MESHES[cells]
    source = Path(inspect.getfile(make.func if isinstance(make, partial) else make))
    if made.exists() and made.stat().st_mtime < source.stat().st_mtime:
        shutil.rmtree(made)
    if not made.exists():
        with tempfile.TemporaryDirectory(dir=folder) as work:
            result = runner.alone("hertz_case:write_mesh", h=h, folder=work, cells=cells)
            if "failed" in result:
                raise RuntimeError(f"no mesh of size {h:g}: {result['failed']}")
            (Path(work) / "whole").rename(made)
    return made / "mesh.xdmf"


def write_mesh(h: float, folder: str, cells: str = "tetrahedra") -> dict[str, float]:
    """Mesh the problem into a file."""
    data = MESHES[cells](h)
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


def read_mesh(path: str | Path, shared: bool = False) -> MeshData:
    """Read such a file.

    Args:
        path: The file.
        shared: Whether each rank has a part of the contact.
    """
    # contactx must load the wheels' MPI first
    from mpi4py import MPI

    with XDMFFile(MPI.COMM_WORLD, path, "r") as file:
        if shared:
            cells, x = (
                read(name="mesh") for read in (file.read_topology_data, file.read_geometry_data)
            )
            element = basix.ufl.element("Lagrange", "tetrahedron", 1, shape=(3,))
            partitioner = cx.partitioner(x, _comes_close)
            domain = create_mesh(
                MPI.COMM_WORLD, cells, ufl.Mesh(element), x, partitioner=partitioner
            )
        else:
            domain = file.read_mesh(name="mesh")
        domain.topology.create_connectivity(2, 3)
        cells, facets = (file.read_meshtags(domain, name) for name in ("cells", "facets"))
    return MeshData(domain, cells, facets, None, None, {})


def _comes_close(x: npt.NDArray[np.float64]) -> npt.NDArray[np.bool_]:
    """Points of both surfaces within twice the radius of the contact that Hertz gives."""
    r = np.hypot(x[0], x[1])
    return np.asarray((r < 0.25) & (np.abs(x[2]) < 0.04))


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


def errors(
    problem: cx.ContactProblem, contact: cx.Contact, young: dict[Tag, float] | None = None
) -> dict[str, float]:
    """Errors as the peers' are measured: peak and L2 norm of the pressure, penetration.

    ``p0_err`` and ``p_l2`` are those of the raw multipliers, ``p0_best`` and ``p_l2_best`` those of
    ``contact.pressure``, which changes the total force by ``force_best``. ``pen`` is geometric,
    ``gap`` the most negative gap of the method, both relative to the prescribed displacement.
    """
    peak = scenes.hertz_of(contact, young).peak_pressure
    best = contact.pressure.x.array[contact.slave_nodes]
    raw = contact.multiplier
    return {
        "force": 4 * float(contact.force[2]),
        "p0_err": float(abs(raw.max() / peak - 1)),
        "p_l2": scenes.pressure_error(problem, contact, young),
        "p0_best": float(abs(best.max() / peak - 1)),
        "p_l2_best": scenes.pressure_error(problem, contact, young, best),
        "force_best": problem.report.recovery[0],
        "pen": _penetration(problem, contact) / DOWN,
        "gap": max(0.0, -float(np.nanmin(contact.discrete.nodes.gap))) / DOWN,
    }


def _penetration(problem: cx.ContactProblem, contact: cx.Contact) -> float:
    """How deep the deepest slave node is below the deformed facets of the master.

    They are taken as a height over x and y, independent of the library's pairs and gaps.
    """
    V = problem.u.function_space
    x = V.tabulate_dof_coordinates() + problem.u.x.array.reshape(-1, 3)
    facets = contact.master.facet_nodes(V)
    nodes, corners = np.unique(facets.nodes, return_inverse=True)
    points, triangles = x[nodes], corners.reshape(len(facets.offsets) - 1, -1)
    if triangles.shape[1] == 4:
        points, triangles = _four_triangles(points, triangles)
    surface = Triangulation(points[:, 0], points[:, 1], triangles)
    slaves = x[contact.slave_nodes]
    near = np.hypot(slaves[:, 0], slaves[:, 1]) < 0.3
    below = LinearTriInterpolator(surface, points[:, 2])(slaves[near, 0], slaves[near, 1])
    return float(np.ma.max(np.ma.maximum(below - slaves[near, 2], 0.0)))


def _four_triangles(
    points: npt.NDArray[np.float64], facets: npt.NDArray[Any]
) -> tuple[npt.NDArray[np.float64], npt.NDArray[Any]]:
    """Split bilinear facets at their middles, which lie on them."""
    middles = len(points) + np.arange(len(facets))
    sides = ((0, 1), (1, 3), (3, 2), (2, 0))
    triangles = [np.stack([facets[:, i], facets[:, j], middles], axis=1) for i, j in sides]
    return np.concatenate([points, points[facets].mean(axis=1)]), np.concatenate(triangles)
