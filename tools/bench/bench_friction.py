# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Both methods on the scenes with friction: how far their results are apart.

Cattaneo and Mindlin with a master of the slave's cell size and of one 1.5 times larger; the block
pushed to and fro on a plane and on an elastic base in 2D and 3D; the slice of the face slabs with
the support of 10 layers, either side of the cushion's contact as the slave. Where a formula gives
the value it stands beside; errors in L2 are relative to the formula's curve.

    python tools/bench/bench_friction.py mindlin block slab
    python tools/bench/bench_friction.py mindlin 0.04
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import bench_face_slab
import cattaneo_mindlin
import numpy as np
import runner
import sliding_block
import tables

import slab_results
import slab_scene
import slab_schemes
import story

FIRST = story.METHODS[0]
COLUMNS: list[tables.Column] = [
    ("scene", "scene", "s"),
    ("result", "name", "s"),
    ("formula", "expected", ".6g"),
    *((method, method, ".6g") for method in story.METHODS),
    ("difference", "difference", "+.1e"),
]
# Cell sizes; layers of the slice
SIZES = {"mindlin": (0.04, 0.015), "block": (0.1, 0.25), "slab": (10, 20)}


def mindlin(h: float, coarser: float, method: str) -> dict[str, Any]:
    """Press and push two cylinders whose master's cells are so many times the slave's."""
    scene = cattaneo_mindlin.create(h, "finite", method, coarser * h)
    cattaneo_mindlin.apply(scene)
    exact = cattaneo_mindlin.formula(scene.contact)
    found = cattaneo_mindlin.Tractions(scene)
    results = [_entry(result) for result in found.compare(exact)]
    # The curves are recovered ones; those of the multipliers beside them
    nodes = scene.contact.slave_nodes
    order = np.argsort(scene.problem.u.function_space.tabulate_dof_coordinates()[nodes, 0])
    p, q = scene.contact.interface.nodes.pressure[order], -scene.contact.multiplier[order, 0]
    for name, raw, curve in (("pressure", p, exact.pressure), ("shear", q, exact.shear)):
        label = f"raw {name}'s difference / formula's, L2"
        results.append(_entry(story.Result.of_curves(label, found.area, raw, curve(found.x))))
    return {"results": results}


def block(h: float, dim: int, base: str, method: str) -> dict[str, Any]:
    """Push a block to and fro."""
    slider = sliding_block.Slider(h, dim, base, "finite", method)
    slider.run()
    # From the first reversal on the path is a closed loop
    path, forces = np.array(slider.path), np.array(slider.forces)
    loop = slice(int(np.argmax(path)), None)
    results = [_entry(result) for result in slider.compare(base)]
    results.append(("work lost in the loop", None, float(np.trapezoid(forces[loop], path[loop]))))
    return {"results": results, "curve": slider.forces}


def slab(layers: int, cushion_is_slave: bool, method: str) -> dict[str, Any]:
    """Turn the slabs of a slice towards each other."""
    model = replace(bench_face_slab.SLICE, layers=layers, matching=False)
    setting = slab_scene.Setting(model, method=method, cushion_is_slave=cushion_is_slave)
    scene = slab_schemes.scheme_1(
        setting, bench_face_slab.SETTLEMENT, bench_face_slab.PRESSURE, steps=1, progress=False
    )
    found = slab_results.measure(scene)
    return {
        "results": [
            ("rotation, degrees", None, found.rotation),
            ("largest stress, MPa", None, found.stress),
            ("opening below, mm", None, 1000 * found.opening),
            (
                "stress of the top beside the joint, MPa",
                None,
                found.means["half of its top beside the joint"],
            ),
        ]
    }


def _entry(result: story.Result) -> tuple[str, float | None, float]:
    """Name, expected and computed; of a difference that should vanish itself alone."""
    name = result.name.split(": ")[-1]
    return name, float(result.expected) or None, float(result.computed)


def jobs(part: str, sizes: Sequence[float]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Name and arguments of the runs of a part, the method apart."""
    for size in sizes:
        if part == "mindlin":
            for coarser in (1.0, 1.5):
                yield (
                    f"cylinders, h = {size:g}, master {coarser:g}",
                    {"h": size, "coarser": coarser},
                )
        elif part == "slab":
            for slave in ("cushion", "slabs"):
                job = {"layers": round(size), "cushion_is_slave": slave == "cushion"}
                yield f"slice, {round(size)} layers, slave {slave}", job
        else:
            # The coarser one is the one in 3D
            dim = 2 if size == min(sizes) else 3
            for base in sliding_block.BASES:
                yield f"block in {dim}D on {base}", {"h": size, "dim": dim, "base": base}


def run(part: str, sizes: Sequence[float]) -> Iterator[dict[str, Any]]:
    """Measure all scenes of a part by all methods."""
    for scene, job in jobs(part, sizes):
        found = {m: runner.alone(f"bench_friction:{part}", **job, method=m) for m in story.METHODS}
        failed = [f"{m}: {row['failed']}" for m, row in found.items() if "failed" in row]
        if failed:
            yield {"scene": scene, "failed": "; ".join(failed)}
            continue
        for k, (name, expected, first) in enumerate(found[FIRST]["results"]):
            row = {"scene": scene, "name": name, "expected": expected}
            for method in story.METHODS:
                row[method] = found[method]["results"][k][2]
                if method != FIRST and first != 0:
                    row["difference"] = row[method] / first - 1
            yield row
        if "curve" in found[FIRST]:
            curves = [np.array(row["curve"]) for row in found.values()]
            apart = max(float(np.abs(curve - curves[0]).max()) for curve in curves)
            share = apart / float(np.abs(curves[0]).max())
            yield {"scene": scene, "name": "force, largest difference", "difference": share}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print; arguments are parts, and sizes of all of them."""
    parts = [word for word in argv if word in SIZES] or list(SIZES)
    sizes = [float(word) for word in argv if word not in SIZES]
    rows = [row for part in parts for row in run(part, sizes or SIZES[part])]
    tables.show("Methods with friction", COLUMNS, rows, runner.OUTPUT / "methods_friction.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
