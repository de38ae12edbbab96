# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Recovered pressures beside multipliers and plain averages, at edges and inside.

Largest pressures at the edge where two face slabs crush each other, at the corner of a punch with
upright and with leaning sides, as slave and as master, on meshes that match and that do not, and
errors of Hertz's pressure from coarse to fine, by both methods. Plain averages are what recovery
does where no pressure rises towards an edge, and dF by how much it changes the total force.

    python tools/bench/bench_recovery.py joint punch hertz
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import hertz_case
import numpy as np
import numpy.typing as npt
import runner
import tables

import contactx as cx

import scenes
import story
from meshes import FACE_SLABS
from scenes.punched_block import PunchedBlock
from slab_results import measure
from slab_scene import Setting
from slab_schemes import scheme_1

LAYERS = (5, 10, 20, 40)
# The demo's slice at 0.17 degrees and 0.3 MPa
SETTLEMENT, PRESSURE = 0.09092, 0.3
# Cells along the block and along the punch, which is a fifth of it
PUNCHES = ((40, 8), (80, 16), (80, 13), (80, 23))
SIZES = {"tetrahedra": (0.04, 0.02, 0.01, 0.005), "hexahedra": (0.04, 0.02, 0.01)}

EDGES: list[tables.Column] = [
    ("scene", "scene", "s"),
    ("mesh", "mesh", "s"),
    ("method", "method", "s"),
    ("closed", "closed", "d"),
    ("raw", "raw", ".4g"),
    ("averages", "averages", ".4g"),
    ("recovered", "recovered", ".4g"),
    ("stress", "stress", ".4g"),
    ("lowest", "lowest", ".3g"),
    ("dF", "force", "+.0e"),
]
ERRORS: list[tables.Column] = [
    ("cells", "cells", "s"),
    ("h", "h", "g"),
    ("sliding", "sliding", "s"),
    ("method", "method", "s"),
    ("p_l2 raw", "raw", ".4f"),
    ("averages", "averages", ".4f"),
    ("recovered", "recovered", ".4f"),
    ("dF", "force", "+.0e"),
]


def averages(contact: cx.Contact) -> npt.NDArray[np.float64]:
    """Pressures of the slave nodes that are averaged alone, as those in tension are."""
    nodes = contact.interface.nodes
    recovery = cx.cpp.Recovery(contact.interface.slave_nodes, contact.interface.halo.x)
    return np.asarray(-recovery.pressure(-nodes.pressure, nodes.area, nodes.closed))


def edge(contact: cx.Contact) -> dict[str, Any]:
    """Largest pressures of a contact, and its lowest one of a closed node over that."""
    nodes = contact.interface.nodes
    p = contact.pressure.x.array[contact.slave_nodes]
    raw, area = np.asarray(nodes.pressure), np.asarray(nodes.area)
    return {
        "closed": int(np.sum(nodes.closed)),
        "raw": float(raw.max()),
        "averages": float(averages(contact).max()),
        "recovered": float(p.max()),
        "lowest": float(p[nodes.closed].min() / p.max()),
        "force": float(area @ p / (area @ raw) - 1),
    }


def joint(layers: int, method: str) -> dict[str, Any]:
    """The face slabs' slice, in this process; ``stress`` is that of the slab beside the edge."""
    setting = Setting(replace(FACE_SLABS["slice"], layers=layers), method=method)
    scene = scheme_1(setting, SETTLEMENT, PRESSURE, steps=1, progress=False)
    return {**edge(scene.joints[0]), "stress": measure(scene).stress}


def punch(n: int, cells: int, lean: float, is_slave: bool, method: str) -> dict[str, Any]:
    """A punch on a block, in this process."""
    scene = PunchedBlock(
        2, n=n, punch=cells, width=0.4, lean=lean, swapped=is_slave, method=method, audit="warn"
    )
    scene.problem.solve()
    return edge(scene.contact)


def hertz(path: str, sliding: str, method: str) -> dict[str, Any]:
    """The common Hertz problem, in this process."""
    scene = scenes.HertzSphere(hertz_case.read_mesh(path), sliding, method=method)
    scene.problem.solve()
    plain = averages(scene.contact)
    errors = hertz_case.errors(scene.problem, scene.contact)
    return {
        "raw": errors["p_l2"],
        "averages": scenes.pressure_error(scene.problem, scene.contact, pressure=plain),
        "recovered": errors["p_l2_best"],
        "force": errors["force_best"],
    }


def joints() -> Iterator[dict[str, Any]]:
    """The slabs by their layers."""
    for method in story.METHODS:
        for layers in LAYERS:
            row = runner.alone("bench_recovery:joint", layers=layers, method=method)
            yield {"scene": "crushed joint", "mesh": f"{layers} layers", **row}


def punches() -> Iterator[dict[str, Any]]:
    """Punches with upright and leaning sides, on meshes of which the first two match."""
    for lean, name in ((0.0, "flat punch"), (1.0, "wedge corner")):
        for is_slave in (True, False):
            for method in story.METHODS:
                for n, cells in PUNCHES:
                    job = {"n": n, "cells": cells, "lean": lean, "is_slave": is_slave}
                    row = runner.alone("bench_recovery:punch", **job, method=method)
                    side = "slave" if is_slave else "master"
                    yield {"scene": f"{name}, {side}", "mesh": f"{n // 5} : {cells}", **row}


def spheres() -> Iterator[dict[str, Any]]:
    """Hertz's problem from coarse to fine."""
    for cells, sizes in SIZES.items():
        for h in sizes:
            path = str(hertz_case.mesh_file(h, cells))
            for sliding in ("finite", "small"):
                for method in story.METHODS:
                    job = {"path": path, "sliding": sliding, "method": method}
                    yield {"cells": cells, "h": h, **runner.alone("bench_recovery:hertz", **job)}


PARTS: dict[str, tuple[list[tables.Column], Callable[[], Iterator[dict[str, Any]]], str]] = {
    "joint": (EDGES, joints, "Face slabs crushed at their joint, MPa"),
    "punch": (EDGES, punches, "Corners of punches, over Young's modulus"),
    "hertz": (ERRORS, spheres, "The common Hertz problem"),
}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    every = []
    for name in argv or PARTS:
        columns, measured, title = PARTS[name]
        rows = list(measured())
        tables.show(title, columns, rows, runner.OUTPUT / f"recovery_{name}.csv")
        every += rows
    return every


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
