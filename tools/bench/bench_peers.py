# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Peers and both methods of contactx on the common Hertz problem, in one run: ``peers.csv``.

Each code in a process of its own on one thread, on the same mesh, in turn; the least process CPU
seconds of some runs, from the mesh in memory to the converged solution. Of CalculiX it is all that
ccx takes: it reads the deck, solves and writes its answer. contactx slides finitely; its pressures
are the recovered ones, contact.pressure.

Peers are installed by hand, none of them is needed elsewhere:

    apt-get install calculix-ccx python3-getfem libopenblas0-serial
    python -m venv ~/.cache/contactx/ngsolve
    ~/.cache/contactx/ngsolve/bin/pip install ngsolve

The rows of a peer that is not there stay as they are, with the date of their measurement.

    python tools/bench/bench_peers.py 0.02 0.01 0.005
    python tools/bench/bench_peers.py 0.01 --only CalculiX --runs 1 --keep
"""

from __future__ import annotations

import argparse
import datetime as dt
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import hertz_case
import numpy as np
import numpy.typing as npt
import pictures
import runner
import tables
from matplotlib.tri import LinearTriInterpolator, Triangulation
from peers import common, table

import contactx as cx
from dolfinx.mesh import entities_to_geometry

import measured
import reference
import story
from tether import tethered

SIZES, RUNS = (0.02, 0.01, 0.005), 3
# All but the fastest take minutes or gigabytes below
SMALLEST = 0.01
GETFEM = Path("/usr/bin/python3")
NGSOLVE = Path("~/.cache/contactx/ngsolve/bin/python")


@dataclass(frozen=True)
class Peer:
    """How a peer is run.

    Attributes:
        name: Its name in ``peers.csv``.
        script: Its script.
        settings: Settings by the smallest size that they are run at.
        package: What to install.
    """

    name: str
    script: str
    settings: dict[str, float]
    package: str


PEERS = (
    Peer(
        "CalculiX",
        "run_calculix.py",
        {
            "node-to-surface penalty 50E": SMALLEST,
            "surface-to-surface penalty 200, iterative": 0.0,
            "mortar, hard": SMALLEST,
        },
        "Debian's package calculix-ccx, so that ccx is on the path",
    ),
    Peer(
        "NGSolve",
        "run_ngsolve.py",
        {"penalty gamma 10, Cholesky": SMALLEST, "penalty gamma 3, CG": SMALLEST},
        "the package ngsolve in the environment that --ngsolve names",
    ),
    Peer(
        "GetFEM",
        "run_getfem.py",
        {"nodal multipliers (node-to-surface)": SMALLEST, "large-sliding ray tracing": SMALLEST},
        "Debian's packages python3-getfem and libopenblas0-serial, for the Python of --getfem",
    ),
)

COLUMNS: list[tables.Column] = [
    ("code and setting", "name", "s"),
    ("h", "h", "s"),
    ("displacements", "size", "s"),
    ("iterations", "iterations", "s"),
    ("CPU s (wall)", "time", "s"),
    ("MB", "memory", "s"),
    ("p_l2", "p_l2", "s"),
    ("depth", "pen", "s"),
]
FORMATS = {"h": "g", "dofs": "d", "iterations": "d", "memory": ".0f"}
FORMATS |= {"p0_err": ".3f", "p_l2": ".3f", "pen": ".2g"}


def write_mesh(path: str, h: float, copy: str) -> dict[str, Any]:
    """Write the mesh of a file as peers read it, in this process.

    Args:
        path: File of the mesh.
        h: Size of its cells in the contact.
        copy: File for peers.
    """
    data = hertz_case.read_mesh(path)
    domain = data.mesh
    x, cells = domain.geometry.x, domain.geometry.dofmaps[0].astype(np.int64)
    inverted = np.linalg.det(x[cells[:, 1:]] - x[cells[:, :1]]) < 0
    cells[inverted, 2:] = cells[inverted, :1:-1]
    bodies = np.zeros(len(cells), dtype=np.int64)
    bodies[data.cell_tags.indices] = data.cell_tags.values
    facets = entities_to_geometry(domain, 2, data.facet_tags.indices).astype(np.int64)
    tags = data.facet_tags.values.astype(np.int64)
    # Normals outwards: both bodies are convex
    for mine in (tags < common.MASTER, tags >= common.MASTER):
        a, b, c = (x[facets[mine, k]] for k in range(3))
        outwards = a - x[np.unique(facets[mine])].mean(axis=0)
        inwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), outwards) < 0
        turned = np.flatnonzero(mine)[inwards]
        facets[turned, 1:] = facets[turned, :0:-1]
    np.savez(copy, **vars(common.Mesh(h, x, cells, bodies, facets, tags)))
    return {"nodes": len(x)}


def run_peer(peer: Peer, python: Path, mesh: Path, setting: str) -> dict[str, Any]:
    """Run a peer once: its counts and errors, or the last line of its error as ``failed``."""
    threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
    script = str(Path(__file__).parent / "peers" / peer.script)
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            tethered([str(python), script, str(mesh), setting, folder]),
            env={k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | threads,
            capture_output=True,
            text=True,
        )
        if run.returncode != 0:
            lines = run.stderr.strip().splitlines() or [f"it ended with code {run.returncode}"]
            return {"failed": lines[-1]}
        found: dict[str, Any] = json.loads(run.stdout.splitlines()[-1])
        with np.load(Path(folder) / "answer.npz") as answer:
            return {**found, **errors(common.read(mesh), answer["u"], answer["pressure"])}


def errors(
    mesh: common.Mesh, u: npt.NDArray[np.float64], pressure: npt.NDArray[np.float64]
) -> dict[str, float]:
    """Errors of a peer's answer, as ``hertz_case.errors`` has them of contactx.

    Args:
        mesh: Mesh of the problem.
        u: Displacement of its nodes, shape (n, 3).
        pressure: Pressures of its slave nodes, shape (m,).
    """
    force = float(internal_forces(mesh, u)[mesh.nodes(common.BOTTOM), 2].sum())
    elastic = (common.YOUNG, common.NU)
    modulus = reference.contact_modulus(*elastic, *elastic)
    hertz = reference.HertzSphere(force=4 * abs(force), radius=1.0, modulus=modulus)
    slaves, masters = mesh.nodes(common.SLAVE), mesh.nodes(common.MASTER)
    r = np.hypot(*mesh.x[slaves, :2].T)
    near = r <= 1.3 * hertz.contact_radius
    w, exact = mesh.areas()[near], hertz.pressure(r[near])
    x = mesh.x + u
    triangles = np.searchsorted(masters, mesh.on(common.MASTER))
    surface = Triangulation(x[masters, 0], x[masters, 1], triangles)
    inner = x[slaves[np.hypot(*x[slaves, :2].T) < 0.3]]
    depth = LinearTriInterpolator(surface, x[masters, 2])(inner[:, 0], inner[:, 1]) - inner[:, 2]
    return {
        "p0_err": float(abs(pressure.max() / hertz.peak_pressure - 1)),
        "p_l2": math.sqrt(w @ (pressure[near] - exact) ** 2 / (w @ exact**2)),
        "pen": float(np.ma.max(np.ma.maximum(depth, 0.0))) / common.DOWN,
    }


def internal_forces(mesh: common.Mesh, u: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Forces that hold the displaced nodes of linear elastic tetrahedra, shape (n, 3)."""
    corners = mesh.x[mesh.cells]
    edges = corners[:, 1:] - corners[:, :1]
    # Gradients of the last three shape functions are the columns of the inverse
    inner = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1)
    slope = np.einsum("cki,ckj->cij", u[mesh.cells], gradients)
    strain = (slope + slope.transpose(0, 2, 1)) / 2
    trace = np.einsum("cii->c", strain)
    stress = 2 * common.MU * strain + common.LAMBDA * trace[:, None, None] * np.eye(3)
    volumes = np.linalg.det(edges) / 6
    forces = np.zeros_like(mesh.x)
    np.add.at(forces, mesh.cells, np.einsum("c,cij,ckj->cki", volumes, stress, gradients))
    return forces


def installed(given: argparse.Namespace) -> Iterator[tuple[Peer, Path]]:
    """Peers that are there and the Pythons to run them; says what is missing of others."""
    pythons = {
        "CalculiX": Path(sys.executable) if shutil.which("ccx") else None,
        "GetFEM": importing("getfem", given.getfem),
        "NGSolve": importing("ngsolve", given.ngsolve),
    }
    for peer in PEERS:
        python = pythons[peer.name]
        if python is not None:
            yield peer, python
        elif given.only in (None, peer.name):
            tables.note(f"{peer.name} is missing, its rows stay: install {peer.package}")


def importing(module: str, python: Path) -> Path | None:
    """The Python if it has the module."""
    python = python.expanduser()
    if not python.exists():
        return None
    run = subprocess.run([python, "-c", f"import {module}"], capture_output=True)
    return python if run.returncode == 0 else None


def measure(given: argparse.Namespace) -> Iterator[dict[str, Any]]:
    """Measure all that is there, in turn, and yield the fastest run of each."""
    peers = [(peer, python) for peer, python in installed(given) if given.only in (None, peer.name)]
    for h in given.sizes:
        path = hertz_case.mesh_file(h)
        with tempfile.TemporaryDirectory() as folder:
            mesh = Path(folder) / "mesh.npz"
            copied = runner.alone("bench_peers:write_mesh", path=str(path), h=h, copy=str(mesh))
            if "failed" in copied:
                raise RuntimeError(f"no mesh of size {h:g} for peers: {copied['failed']}")
            found: dict[tuple[str, str], list[dict[str, Any]]] = {}
            for run in range(given.runs):
                for method in story.METHODS if given.only in (None, table.OURS) else ():
                    found.setdefault((table.OURS, method), []).append(ours(str(path), method))
                for peer, python in peers:
                    for setting, smallest in peer.settings.items():
                        if h >= smallest:
                            one = run_peer(peer, python, mesh, setting)
                            found.setdefault((peer.name, setting), []).append(one)
                tables.note(f"h = {h:g}: run {run + 1} of {given.runs} done")
        for (name, setting), runs in found.items():
            least = min(runs, key=lambda one: one.get("cpu", math.inf))
            yield {"peer": name, "setting": setting, "h": h, **least}


def ours(path: str, method: str) -> dict[str, Any]:
    """Run contactx once, with the errors of the pressures that users get."""
    job = {"path": path, "sliding": "finite", "method": method}
    found = runner.alone("bench_methods:measure", **job)
    if "failed" in found:
        return {"failed": found["failed"]}
    recovered = {"p0_err": found["p0_best"], "p_l2": found["p_l2_best"]}
    return {**found, **recovered, "version": cx.__version__, "commit": measured.commit()}


def written(row: dict[str, Any]) -> table.Row:
    """A row as it stands in ``peers.csv``."""
    of_all = {"date": dt.date.today().isoformat(), "machine": measured.machine()}
    every = {**row, **of_all, "cpu": format(row["cpu"], ".1f" if row["cpu"] >= 1 else ".2f")}
    text = {k: format(every[k], FORMATS.get(k, "")) for k in table.COLUMNS if k in every}
    return {"wall": "", "commit": "", **text}


def draw(path: Path, **words: str) -> None:
    """Picture of the error over time of all that ``peers.csv`` has.

    Args:
        path: The image file.
        words: Note and source of the picture.
    """
    groups = table.numbers()
    pictures.lines(
        groups,
        path,
        ours=sum(name.startswith(table.OURS) for name in groups),
        axes=(("cpu", "p_l2"),),
        words={
            "cpu": "process CPU seconds, one thread",
            "p_l2": "relative L2 error of the contact pressure",
        },
        title="An elastic sphere on an elastic block: error against time",
        **words,
    )
    tables.note(f"see {path}")


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure, write and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("sizes", type=float, nargs="*", help="cell sizes in the contact")
    parser.add_argument("--runs", type=int, default=RUNS, help="runs of which the least counts")
    names = [table.OURS, *(peer.name for peer in PEERS)]
    parser.add_argument("--only", choices=names, help="measure this code alone")
    parser.add_argument("--keep", action="store_true", help="leave peers.csv as it is")
    parser.add_argument("--getfem", type=Path, default=GETFEM, help="Python that has GetFEM")
    parser.add_argument("--ngsolve", type=Path, default=NGSOLVE, help="Python that has NGSolve")
    given = parser.parse_args(argv)
    given.sizes = given.sizes or list(SIZES)
    # Let the forms be compiled, once for all runs
    for method in story.METHODS:
        ours(str(hertz_case.mesh_file(0.2)), method)
    rows = list(measure(given))
    good = [written(row) for row in rows if "failed" not in row]
    for row in rows:
        if "failed" in row:
            tables.note(f"failed: {row['peer']}, {row['setting']}, {row['h']:g}: {row['failed']}")
    every = good if given.keep else table.update(good)
    title = "Common Hertz problem, peers and contactx"
    tables.show(title, COLUMNS, [table.shown(row) for row in every], runner.OUTPUT / "peers.csv")
    draw(runner.OUTPUT / "error_time.png")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
