# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two spheres pressed together by a force: contact radius and peak pressure against Hertz.

A quarter of two half spheres, whose flat faces stay plane and whose displacement is found by
secants. Either sphere is the slave; with the stiff one in finite sliding Hertz's linear theory does
not hold, see ``scenes.two_spheres``. The soft sphere's cells are 1.5 times smaller than those of
the stiff one.

    python tools/bench/bench_spheres.py 0.1 0.05
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import hertz_case
import runner
import tables

import story
from scenes import two_spheres

SIZES = (0.1, 0.05, 0.03, 0.02)
CASES = (("soft", "finite"), ("soft", "small"), ("stiff", "small"), ("stiff", "finite"))
COLUMNS: list[tables.Column] = [
    ("h", "h", "g"),
    ("a/h", "ratio", ".1f"),
    ("slave", "slave", "s"),
    ("sliding", "sliding", "s"),
    ("method", "method", "s"),
    ("dofs", "dofs", "d"),
    ("it", "each", "s"),
    ("CPU s", "cpu", ".1f"),
    ("a raw", "a_raw", "+.4f"),
    ("a", "a_best", "+.4f"),
    ("p0 raw", "p0_raw", "+.4f"),
    ("p0", "p0_best", "+.4f"),
]


def measure(h: float, slave: str, sliding: str, method: str) -> dict[str, Any]:
    """Solve in this process.

    Args:
        h: Cell size of the soft sphere in the contact.
        slave: "soft" or "stiff".
        sliding: "finite" or "small".
        method: Method of the contact.
    """
    data = two_spheres.mesh(h, slave)
    meter = runner.Meter()
    scene = two_spheres.TwoSpheres(data, slave=slave, sliding=sliding, method=method)
    scene.press()
    measured = meter.read()
    contact = scene.contact
    a_raw, p0_raw = scene.errors(contact.multiplier)
    a_best, p0_best = scene.errors(contact.pressure.x.array[contact.slave_nodes])
    found = {"a_raw": a_raw, "p0_raw": p0_raw, "a_best": a_best, "p0_best": p0_best}
    each = " ".join(map(str, scene.iterations))
    ratio = two_spheres.HERTZ.contact_radius / h
    return {**hertz_case.counts(scene.problem), **measured, **found, "each": each, "ratio": ratio}


def main(argv: Sequence[str]) -> list[dict[str, Any]]:
    """Measure and print."""
    rows = [
        runner.alone("bench_spheres:measure", h=h, slave=slave, sliding=sliding, method=method)
        for h in [float(h) for h in argv] or SIZES
        for slave, sliding in CASES
        for method in story.METHODS
    ]
    hertz = two_spheres.HERTZ
    title = f"Two spheres; Hertz: a = {hertz.contact_radius:.5f}, p0 = {hertz.peak_pressure:.5g}"
    tables.show(title, COLUMNS, rows, runner.OUTPUT / "spheres.csv")
    return rows


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
