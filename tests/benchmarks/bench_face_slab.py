# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Figures of the face slabs: mesh, slave, sliding, row of slabs, scheme 2; time and memory in 3D.

Slices at 0.17 degrees and 0.3 MPa unless said otherwise, with the support of 10 layers. Process CPU
seconds on one thread, set-up and solve; the largest memory of this process so far.

    python tests/benchmarks/bench_face_slab.py              # all but the 3D presets
    python tests/benchmarks/bench_face_slab.py mesh row
    python tests/benchmarks/bench_face_slab.py paper        # or coarse
"""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[2] / "demos"))

import numpy as np
from rich.console import Console
from rich.table import Table

from meshes import FACE_SLABS
from slab_results import laws, measure
from slab_scene import Scene, Setting
from slab_schemes import Try, scheme_1, scheme_2, try_supports

SLICE = replace(FACE_SLABS["slice"], layers=10)
SETTLEMENT, PRESSURE = 0.07339, 0.3


def solve(name: str, setting: Setting, steps: int = 1, settlement: float = SETTLEMENT) -> list[str]:
    """One row of a table."""
    begin, counts = time.process_time(), []
    scene = scheme_1(
        setting,
        settlement,
        PRESSURE,
        steps=steps,
        progress=False,
        each=lambda scene: counts.append(scene.problem.report.iterations),
    )
    seconds = time.process_time() - begin
    m, errors = measure(scene), laws(scene)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [
        name,
        str(len(scene.x)),
        str(sum(len(contact.slave_nodes) for contact in scene.problem.contacts)),
        " ".join(map(str, counts)),
        f"{m.rotation:.5f}",
        f"{m.stress:.3f}",
        f"{m.lower:.3f}",
        f"{1000 * m.opening:.4f}",
        f"{errors.balance:.0e}",
        f"{errors.coulomb:.0e}",
        f"{seconds:.1f}",
        f"{memory:.0f}",
    ]


def mesh() -> Iterator[list[str]]:
    """Layers, with either slave, and matching."""
    for layers in (5, 10, 20, 40):
        model = replace(SLICE, layers=layers)
        yield solve(f"{layers} layers", Setting(model))
        yield solve("  slabs are slaves", Setting(model, cushion_is_slave=False))
        yield solve("  matching", Setting(replace(model, matching=True)))


def sliding() -> Iterator[list[str]]:
    """Small and finite sliding, in one step and in ten."""
    for kinematics in ("small", "finite"):
        for steps in (1, 10):
            setting = Setting(SLICE, sliding=kinematics)
            yield solve(f"{kinematics}, {steps} steps", setting, steps)


def row() -> Iterator[list[str]]:
    """One to six slabs on the same settlement."""
    for slabs in range(1, 7):
        yield solve(f"{slabs} slabs", Setting(replace(SLICE, slabs=slabs)))


def preset(name: str) -> Iterator[list[str]]:
    """A preset in 3D in ten steps, with the support found on its slice."""
    setting = Setting(FACE_SLABS[name])
    tries: list[Try] = []
    found = try_supports(setting, 0.17, PRESSURE, tries.append)
    yield solve(f"{name}, after {len(tries)} tries", setting, 10, found.settlement)


def push() -> None:
    """Scheme 2 in steps of half a millimetre: the peak, and where rows of joint nodes close."""
    table = Table("layers", "slave", "peak MPa", "at mm", "last MPa", "second row closes at mm")
    for layers in (5, 10, 20):
        model = replace(SLICE, layers=layers, cushion_thickness=2.0, opening=(0.0, 2e-3))
        for slave in ("cushion", "slabs"):
            pushes, stresses, rows = [], [], []

            def each(scene: Scene, keep: Any = (pushes, stresses, rows)) -> None:
                joint = scene.joints[0]
                nodes = joint.slave_nodes[joint.status.x.array[joint.slave_nodes] > 0]
                values = (1000 * float(scene.push[0].value), measure(scene).largest)
                for found, value in zip(keep, (*values, len(nodes) // 2), strict=True):
                    found.append(value)

            setting = Setting(model, cushion_is_slave=slave == "cushion")
            scheme_2(setting, PRESSURE, 0.02, steps=40, each=each, progress=False)
            peak = int(np.argmax(stresses))
            second = int(np.argmax(np.array(rows) >= 2))
            table.add_row(
                str(layers),
                slave,
                f"{stresses[peak]:.2f}",
                f"{pushes[peak]:.1f}",
                f"{stresses[-1]:.2f}",
                f"{pushes[second]:.1f}",
            )
    Console(width=110).print(table)


def show(title: str, rows: Iterator[list[str]]) -> None:
    """Print a table of runs."""
    names = ("", "nodes", "slaves", "iterations", "degrees", "MPa", "lower", "opening mm")
    table = Table(*names, "balance", "Coulomb", "CPU s", "MB", title=title)
    for cells in rows:
        table.add_row(*cells)
    Console(width=150).print(table)


PARTS: dict[str, Callable[[], None]] = {
    "mesh": lambda: show("mesh and slave", mesh()),
    "sliding": lambda: show("small and finite sliding", sliding()),
    "row": lambda: show("slabs in a row", row()),
    "push": push,
    "coarse": lambda: show("coarse", preset("coarse")),
    "paper": lambda: show("paper", preset("paper")),
}

if __name__ == "__main__":
    for part in sys.argv[1:] or ("mesh", "sliding", "row", "push"):
        PARTS[part]()
