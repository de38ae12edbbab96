# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Iterations where active sets creep and cells may turn inside out, and what mesh refinement adds.

Beams pressed on a former in one step, belts pulled around a drum with friction in five, a roller
pressed into a block in one.

python tools/bench/bench_globalisation.py 50 100 200 400 800 1600
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import Any

import runner
import tables

import contactx as cx

from scenes import slender
from scenes.materials import st_venant_kirchhoff
from scenes.roller import Roller
from story import METHODS, elasticity

SIZES = (50, 100, 200, 400, 800, 1600)
BELTS = (100, 200, 400)
MATERIALS: dict[str, slender.Material] = {"linear": elasticity, "svk": st_venant_kirchhoff}
SCENE: list[tables.Column] = [
    ("scene", "scene", "s"),
    ("method", "method", "s"),
    ("material", "material", "s"),
    ("mu", "mu", "g"),
    ("cells", "cells", "d"),
]
COLUMNS: list[tables.Column] = [
    *SCENE,
    ("steps", "steps", "d"),
    ("it", "it", "d"),
    ("failed", "discarded", "d"),
    ("path", "interior", "d"),
    ("limited", "limited", "d"),
    ("damped", "damped", "d"),
    ("least det F", "det", ".2g"),
]


def _row(reports: Sequence[cx.Report]) -> dict[str, Any]:
    return {
        "steps": len(reports),
        "it": sum(r.iterations for r in reports),
        "discarded": sum(r.discarded for r in reports),
        "interior": sum(r.interior for r in reports),
        "limited": sum(r.limited for r in reports),
        "damped": sum(r.shortened for r in reports),
        "det": min(r.audit.smallest_det for r in reports),
    }


def press_beam(shape: str, method: str, material: str, mu: float, cells: int) -> dict[str, Any]:
    """Press a beam on the former."""
    options = {"snes_max_it": 200}
    strip = slender.beam(
        cells,
        shape,
        material=MATERIALS[material],
        method=method,
        friction=mu,
        petsc_options=options,
    )
    return _row([slender.press(strip, shape)])


def pull_belt(pull: str, method: str, material: str, mu: float, cells: int) -> dict[str, Any]:
    """Pull a belt around the drum; a straight one is wound on it."""
    wound = pull in slender.PULLS
    strip = slender.belt(
        cells, wound=wound, material=MATERIALS[material], friction=mu, method=method
    )
    right, left = slender.PULLS[pull] if wound else (1.2, 1.2)
    return _row(slender.run_belt(strip, right, left))


def roll(depth: str, method: str, material: str, mu: float, cells: int) -> dict[str, Any]:
    """Press the roller."""
    return _row([Roller(material, method, mu, n=cells).press(float(depth))])


def _measured(title: str, name: str, measure: Callable[..., Any], **scene: Any) -> dict[str, Any]:
    kind = scene.pop("kind")
    found = runner.alone(f"bench_globalisation:{measure.__name__}", **{name: kind}, **scene)
    return {"scene": f"{title}, {kind}", **scene, **found}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    sizes = [int(n) for n in argv] or SIZES
    rows = [
        _measured("beam", "shape", press_beam, kind=shape, method=m, material=s, mu=0.0, cells=n)
        for shape in slender.SHAPES
        for m in METHODS
        for s in MATERIALS
        for n in sizes
    ]
    rows += [
        _measured("belt", "pull", pull_belt, kind=pull, method=m, material="svk", mu=0.3, cells=n)
        for pull in (*slender.PULLS, "straight")
        for m in METHODS
        for n in (BELTS if not argv else [n for n in sizes if n <= max(BELTS)])
    ]
    rows += [
        _measured("roller", "depth", roll, kind=depth, method=m, material=s, mu=mu, cells=n)
        for depth in ("0.3", "0.5")
        for s in ("svk", "neo-hooke")
        for m in METHODS
        for mu in (0.0, 0.1)
        for n in ((10, 16) if not argv else (10,))
    ]
    tables.show("Globalisation", COLUMNS, rows, runner.OUTPUT / "globalisation.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
