# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem as peers read it, and their answers.

Nothing but NumPy is needed here: each peer runs in the Python that it is installed for.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]

YOUNG, NU, DOWN = 1.0, 0.3, 0.02
MU, LAMBDA = YOUNG / (2 * (1 + NU)), YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
SPHERE, BLOCK = 1, 2
SLAVE, MASTER = 11, 21
TOP, BOTTOM = 12, 22
# Faces where displacements are zero, by their components; those of the bottom are in all of them
FIXED = {0: (13, 23, BOTTOM), 1: (14, 24, BOTTOM), 2: (BOTTOM,)}


@dataclass
class Mesh:
    """Linear tetrahedra.

    Attributes:
        h: Size of the cells in the contact.
        x: Positions of the nodes, shape (n, 3).
        cells: Their nodes, shape (m, 4); volumes are positive.
        bodies: ``SPHERE`` or ``BLOCK`` of each cell, shape (m,).
        facets: Nodes of the tagged facets, shape (k, 3); normals point outwards.
        tags: Their tags, shape (k,).
    """

    h: float
    x: Floats
    cells: Integers
    bodies: Integers
    facets: Integers
    tags: Integers

    def on(self, *tags: int) -> Integers:
        """Facets with these tags, shape (n, 3)."""
        return self.facets[np.isin(self.tags, tags)]

    def nodes(self, *tags: int) -> Integers:
        """Nodes of the facets with these tags, ascending, shape (n,)."""
        return np.unique(self.on(*tags))

    def sides(self, *tags: int) -> Integers:
        """Cells that facets belong to, and which of their nodes is opposite, shape (n, 2)."""
        found = []
        wanted = np.sort(self.on(*tags), axis=1)
        for opposite in range(4):
            corners = np.sort(np.delete(self.cells, opposite, axis=1), axis=1)
            cells = np.flatnonzero(np.isin(corners, wanted).all(axis=1))
            # Three nodes of a surface need not be one of its facets
            same = (corners[cells, None] == wanted).all(axis=2).any(axis=1)
            found += [(int(cell), opposite) for cell in cells[same]]
        return np.array(found)

    def areas(self) -> Floats:
        """A third of the areas of the slave's facets at each of ``nodes(SLAVE)``, shape (n,)."""
        facets = self.on(SLAVE)
        a, b, c = (self.x[facets[:, k]] for k in range(3))
        areas = np.zeros(len(self.x))
        np.add.at(areas, facets, np.linalg.norm(np.cross(b - a, c - a), axis=1)[:, None] / 6)
        return areas[self.nodes(SLAVE)]


@dataclass
class Answer:
    """What a peer found.

    Attributes:
        u: Displacement of the nodes of the mesh, shape (n, 3).
        pressure: Contact pressure of ``mesh.nodes(SLAVE)``, shape (m,).
        counts: Equations (``dofs``), ``iterations``, CPU seconds (``cpu``), megabytes
            (``memory``) and the peer's ``version``.
    """

    u: Floats
    pressure: Floats
    counts: Mapping[str, Any]


def read(path: Path) -> Mesh:
    """Read a mesh that ``bench_peers.py`` wrote."""
    with np.load(path) as file:
        return Mesh(**{name: file[name] for name in file})


class Meter:
    """Process CPU seconds and memory since it was made, which is when the mesh has been read."""

    def __init__(self) -> None:
        try:
            # The largest memory so far counts from here on
            Path("/proc/self/clear_refs").write_text("5")
        except OSError:
            pass
        self._memory = megabytes(os.getpid(), "VmRSS")
        self._start = time.process_time()

    def read(self) -> dict[str, float]:
        """CPU seconds, and the largest memory above that of the start, MB."""
        return {
            "cpu": time.process_time() - self._start,
            "memory": megabytes(os.getpid(), "VmHWM") - self._memory,
        }


def megabytes(process: int, name: str) -> float:
    """An entry of a process's status on Linux, MB; zero where it has ended."""
    try:
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
    except OSError:
        return 0.0
    return max((int(line.split()[1]) / 1024 for line in lines if line.startswith(name)), default=0)


def main(solve: Callable[[Mesh, str, Path], Answer]) -> None:
    """Solve as the command line asks for: ``MESH SETTING FOLDER``.

    The answer comes to ``FOLDER/answer.npz``; the last line that is printed has the counts.
    """
    parser = argparse.ArgumentParser()
    parser.add_argument("mesh", type=Path, help="file that bench_peers.py writes")
    parser.add_argument("setting", help="as in peers.csv")
    parser.add_argument("folder", type=Path, help="for files of the run and the answer")
    given = parser.parse_args()
    found = solve(read(given.mesh), given.setting, given.folder)
    np.savez(given.folder / "answer.npz", u=found.u, pressure=found.pressure)
    print(json.dumps(dict(found.counts)))
