# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The common Hertz problem by CalculiX: writes a deck, runs ccx, reads its files.

All that ccx does counts as its time: it reads the deck, solves and writes its answer.
"""

from __future__ import annotations

import os
import re
import subprocess
import time
from pathlib import Path
from typing import Any

import common
import numpy as np
from common import MASTER, SLAVE, TOP, Answer, Floats, Mesh

# Parameters of the contact pair, its behaviour, and the linear solver
SETTINGS = {
    "surface-to-surface penalty 200, iterative": (
        "TYPE=SURFACE TO SURFACE",
        "PRESSURE-OVERCLOSURE=LINEAR\n200.",
        "ITERATIVE CHOLESKY",
    ),
    "node-to-surface penalty 50E": (
        "TYPE=NODE TO SURFACE",
        "PRESSURE-OVERCLOSURE=LINEAR\n50.",
        "SPOOLES",
    ),
    # Hard is what it is without a behaviour: with HARD it is as soft as 50 E
    "mortar, hard": ("TYPE=MORTAR", None, "SPOOLES"),
}
# Stiffness of springs in place of supports, where E h is 0.01
SPRING = 1e3
# Number of a tetrahedron's side by the node opposite
SIDES = (3, 4, 2, 1)


def solve(mesh: Mesh, setting: str, folder: Path) -> Answer:
    """Solve in a process of ccx.

    Args:
        mesh: Mesh of the problem.
        setting: One of ``SETTINGS``.
        folder: Folder of ccx's files.
    """
    (folder / "hertz.inp").write_text(deck(mesh, setting))
    counts = run(folder)
    fields = read_frd(folder / "hertz.frd", len(mesh.x))
    # Opening, two slips, pressure and two shears
    pressure = fields["CONTACT"][mesh.nodes(SLAVE), 3]
    return Answer(fields["DISP"][:, :3], pressure, counts)


def deck(mesh: Mesh, setting: str) -> str:
    """The problem in ccx's words."""
    pair, behaviour, solver = SETTINGS[setting]
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k}, {x:.12e}, {y:.12e}, {z:.12e}" for k, (x, y, z) in enumerate(mesh.x, 1)]
    lines += ["*ELEMENT, TYPE=C3D4, ELSET=BODIES"]
    lines += [", ".join(map(str, [k, *nodes])) for k, nodes in enumerate(mesh.cells + 1, 1)]
    for name, tag in (("SLAVE", SLAVE), ("MASTER", MASTER)):
        lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"]
        lines += [f"{cell + 1}, S{SIDES[node]}" for cell, node in mesh.sides(tag)]
    lines += ["*NSET, NSET=TOP", *(f"{node + 1}," for node in mesh.nodes(TOP))]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{common.YOUNG}, {common.NU}"]
    lines += ["*SOLID SECTION, ELSET=BODIES, MATERIAL=M"]
    lines += ["*SURFACE INTERACTION, NAME=I"]
    lines += [f"*SURFACE BEHAVIOR, {behaviour}"] if behaviour else []
    lines += [f"*CONTACT PAIR, INTERACTION=I, {pair}", "SLAVE, MASTER"]
    # The mortar pair's matrix is singular where a slave node has two supports: springs hold them
    slaves = mesh.nodes(SLAVE)[: None if "MORTAR" in pair else 0]
    supports, first = ["*BOUNDARY"], len(mesh.cells) + 1
    for component, tags in enumerate(common.FIXED.values(), 1):
        nodes = mesh.nodes(*tags)
        fixed, held = np.setdiff1d(nodes, slaves) + 1, np.intersect1d(nodes, slaves) + 1
        supports += [f"{node}, {component}, {component}" for node in fixed]
        if len(held):
            lines += [f"*ELEMENT, TYPE=SPRING1, ELSET=SPRINGS{component}"]
            lines += [f"{k}, {node}" for k, node in enumerate(held, first)]
            lines += [f"*SPRING, ELSET=SPRINGS{component}", f"{component}", f"{SPRING}"]
            first += len(held)
    lines += supports
    lines += ["*STEP, INC=1", f"*STATIC, DIRECT, SOLVER={solver}", "1., 1."]
    lines += ["*BOUNDARY", f"TOP, 3, 3, {-common.DOWN}"]
    lines += ["*NODE FILE", "U", "*CONTACT FILE", "CDIS, CSTR"]
    lines += ["*END STEP", ""]
    return "\n".join(lines)


def run(folder: Path) -> dict[str, Any]:
    """Run ccx on one thread: its counts, time and memory."""
    output = folder / "hertz.out"
    before = os.times()
    with output.open("w") as file:
        process = subprocess.Popen(
            ["ccx", "-i", "hertz"],
            cwd=folder,
            env={**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"},
            stdout=file,
            stderr=subprocess.STDOUT,
        )
        # What the kernel reports at the end may be the memory of the one that started it
        memory = 0.0
        while process.poll() is None:
            memory = max(memory, common.megabytes(process.pid, "VmHWM"))
            time.sleep(0.01)
    after = os.times()
    text = output.read_text()
    if process.returncode != 0 or "Job finished" not in text:
        errors = re.findall(r"\*ERROR.*", text) or [f"it ended with code {process.returncode}"]
        raise RuntimeError(f"ccx: {errors[-1]}")
    return {
        "dofs": int(re.findall(r"number of equations\s*\n\s*(\d+)", text)[-1]),
        "iterations": len(re.findall(r"^ iteration +\d+ *$", text, re.M)),
        "cpu": sum(after[2:4]) - sum(before[2:4]),
        "memory": memory,
        "version": version(),
    }


def version() -> str:
    """Version of ccx."""
    text = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout
    return str(re.findall(r"Version (\S+)", text)[0])


def read_frd(path: Path, nodes: int) -> dict[str, Floats]:
    """Last values of each nodal field of an frd file, shape (nodes, components)."""
    fields: dict[str, Floats] = {}
    values = None
    for line in path.read_text().splitlines():
        if line.startswith(" -4"):
            name, components = line.split()[1:3]
            fields[name] = values = np.zeros((nodes, int(components)))
        elif line.startswith(" -3"):
            values = None
        elif line.startswith(" -1") and values is not None:
            numbers = [line[k : k + 12] for k in range(13, len(line.rstrip()), 12)]
            values[int(line[3:13]) - 1, : len(numbers)] = list(map(float, numbers))
    return fields


if __name__ == "__main__":
    common.main(solve)
