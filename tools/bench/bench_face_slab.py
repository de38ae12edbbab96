# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Figures of the face slabs: mesh, slave, sliding, row of slabs, scheme 2; time and memory in 3D.

Slices at 0.17 degrees and 0.3 MPa unless said otherwise, with the support of 10 layers. Process CPU
seconds on one thread, set-up and solve; the largest memory of this process so far.

    python tools/bench/bench_face_slab.py              # all but the 3D presets
    python tools/bench/bench_face_slab.py mesh row
    python tools/bench/bench_face_slab.py paper        # or coarse
    python tools/bench/bench_face_slab.py table push_paper   # the paper's numbers, in 3D
"""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "demos"))

import face_slab
import numpy as np
from rich.console import Console
from rich.table import Table

from meshes import FACE_SLABS, FaceSlab
from slab_results import laws, measure
from slab_scene import Scene, Setting
from slab_schemes import Try, scheme_1, scheme_2, slice_of, try_supports
from story import METHODS

SLICE = replace(FACE_SLABS["slice"], layers=10)
SETTLEMENT, PRESSURE = 0.09092, 0.3


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
        f"{m.largest:.3f}",
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
        other = replace(model, matching=False)
        yield solve("  other cells", Setting(other))
        yield solve("    slabs are slaves", Setting(other, cushion_is_slave=False))
        yield solve("    surface-to-surface", Setting(other, method="surface-to-surface"))


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
    """Scheme 2 in steps of half a millimetre: the peak, and where rows of joint nodes close.

    By layers; then by the cushion's thickness and by the largest cells, those at the pushed sides.
    """
    for layers in (5, 10, 20):
        for method in METHODS:
            pushed(f"{layers} layers, {method}", replace(SLICE, layers=layers), method, 40)
    for thickness in (1.0, 2.0, 3.5):
        for largest in (2.5, 0.5, 0.2):
            model = replace(
                slice_of(FACE_SLABS["paper"]), cushion_thickness=thickness, largest=largest
            )
            for method in METHODS:
                pushed(f"{thickness:g} m, cells of {largest:g} m, {method}", model, method, 40)


def push_paper() -> None:
    """Scheme 2 in 3D on the paper's number of nodes."""
    pushed("paper", FACE_SLABS["paper"], METHODS[1], 20)


def pushed(name: str, model: FaceSlab, method: str, steps: int) -> None:
    """Print a run of scheme 2: its peaks, where they are, and what follows."""
    found: list[tuple[float, float, float, int]] = []

    def each(scene: Scene) -> None:
        joint, m = scene.joints[0], measure(scene)
        closed = joint.interface.nodes.closed
        x = scene.x[joint.slave_nodes[closed]]
        rows = np.unique((x[:, 2] / scene.model.thickness_at(x[:, 1])).round(6))
        found.append((1000 * float(scene.push[0].value), m.stress, m.largest, len(rows)))

    begin = time.process_time()
    setting = Setting(replace(model, opening=(0.0, 2e-3)), method=method)
    scheme_2(setting, PRESSURE, 0.02, steps=steps, each=each, progress=False)
    pushes, middle, whole, rows = (np.array(values) for values in zip(*found, strict=True))
    words = [
        f"{place}: peak {values.max():.2f} MPa at {pushes[values.argmax()]:.1f} mm, "
        f"{values[-1]:.2f} at the end ({100 * (values[-1] / values.max() - 1):+.0f} %)"
        for place, values in (("mid length", middle), ("whole slab", whole))
    ]
    second = pushes[np.argmax(rows >= 2)]
    seconds = time.process_time() - begin
    print(f"{name}: {'; '.join(words)}; second row closes at {second:.1f} mm; {seconds:.0f} CPU s")


def show(title: str, rows: Iterator[list[str]]) -> None:
    """Print a table of runs."""
    names = ("", "nodes", "slaves", "iterations", "degrees", "MPa", "whole slab", "opening mm")
    table = Table(*names, "balance", "Coulomb", "CPU s", "MB", title=title)
    for cells in rows:
        table.add_row(*cells)
    Console(width=150).print(table)


PARTS: dict[str, Callable[[], object]] = {
    "mesh": lambda: show("mesh and slave", mesh()),
    "sliding": lambda: show("small and finite sliding", sliding()),
    "row": lambda: show("slabs in a row", row()),
    "push": push,
    "push_paper": push_paper,
    "table": lambda: face_slab.main(["--table", "--preset", "paper"]),
    "coarse": lambda: show("coarse", preset("coarse")),
    "paper": lambda: show("paper", preset("paper")),
}

if __name__ == "__main__":
    for part in sys.argv[1:] or ("mesh", "sliding", "row", "push"):
        PARTS[part]()
