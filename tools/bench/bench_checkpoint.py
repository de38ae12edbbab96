# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checkpoints on several ranks: bytes and memory of the rank that has most of them.

A cube of hexahedra with functions at nodes, in cells and at quadrature points. What a rank writes
and reads, over an equal part of the file; and by how much its memory grows meanwhile, at most.

    python tools/bench/bench_checkpoint.py 20 40
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from mpi4py import MPI

import runner
import tables

import contactx as cx
from contactx._host.checkpoint.shared_file import SharedFile
from contactx._host.parallel.reduce import largest
from dolfinx import mesh

from ranks.relaxed import Relaxed

# Cells along an edge: 24,000 and a million displacements
SIZES = (19, 69)
RANKS = (1, 2, 4)

COLUMNS = [
    ("displacements", "dofs", ",d"),
    ("ranks", "ranks", "d"),
    ("file MB", "file", ".1f"),
    ("written MB", "written", ".2f"),
    (": part", "written part", ".3f"),
    ("read MB", "read", ".2f"),
    (": part", "read part", ".3f"),
    ("memory MB\nwriting", "memory writing", ".0f"),
    ("memory MB\nreading", "memory reading", ".0f"),
]


class Counted:
    """Bytes that this rank writes and reads, while in use."""

    def __init__(self) -> None:
        self.written = self.read = 0

    def __enter__(self) -> Counted:
        """Count from here on."""
        self._whole = SharedFile.write, SharedFile.read

        def write(file: SharedFile, at: int, values: Any) -> None:
            self.written += len(values)
            self._whole[0](file, at, values)

        def read(file: SharedFile, at: int, values: Any) -> None:
            self.read += len(values)
            self._whole[1](file, at, values)

        SharedFile.write, SharedFile.read = write, read
        return self

    def __exit__(self, *_: object) -> None:
        """Count no more."""
        SharedFile.write, SharedFile.read = self._whole


def measure(cells: int, folder: str) -> dict[str, Any]:
    """Write a checkpoint and read it, on all ranks.

    Args:
        cells: Number of cells along an edge.
        folder: Where the file goes.
    """
    comm = MPI.COMM_WORLD
    domain = mesh.create_unit_cube(comm, cells, cells, cells, mesh.CellType.hexahedron)
    problem, path = Relaxed(domain), Path(folder) / "cube.state"
    # What forms and exchanges need once
    small = Relaxed(mesh.create_unit_cube(comm, 2, 2, 2, mesh.CellType.hexahedron))
    options = {"update": small.update, "history": small.history, "progress": False}
    cx.LoadSteps(small, 1, **options).save(Path(folder) / "small.state")

    options = {"update": problem.update, "history": problem.history, "progress": False}
    steps = cx.LoadSteps(problem, 1, **options)
    memory = {}
    with Counted() as counted:
        meter = runner.Meter()
        steps.save(path)
        memory["memory writing"] = meter.read()["memory"]
        meter = runner.Meter()
        cx.LoadSteps(problem, 1, restart=path, **options)
        memory["memory reading"] = meter.read()["memory"]
    size = path.stat().st_size
    row = {"written": counted.written, "read": counted.read, **memory}
    row = {name: float(largest(comm, float(value))) for name, value in row.items()}
    for name in ("written", "read"):
        row[f"{name} part"] = row[name] * comm.size / size
        row[name] /= 1e6
    dofs = 3 * problem.u.function_space.dofmap.index_map.size_global
    return {"dofs": dofs, "file": size / 1e6, **row}


def rows(sizes: Iterable[int], ranks: Iterable[int] = RANKS) -> list[dict[str, Any]]:
    """Measure some sizes on some numbers of ranks."""
    with tempfile.TemporaryDirectory() as folder:
        return [
            runner.on_ranks("bench_checkpoint:measure", n, cells=cells, folder=folder)
            for cells in sizes
            for n in ranks
        ]


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    measured = rows([int(n) for n in argv] or SIZES)
    title = "Checkpoints: the rank that has most"
    tables.show(title, COLUMNS, measured, runner.OUTPUT / "checkpoint.csv")
    return measured


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
