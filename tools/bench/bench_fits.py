# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Perfect fits of chords: as they are, adjusted, and adjusted and smooth.

A pin in its own hole, frictionless and held from turning: stress without load, over Young's
modulus; under a load the largest pressure and half of the angle of contact, beside those of 360
nodes on 360 that match. A taper is pushed in and pulled out: forces, nodes that are open where the
closed ring has none, peak over mean pressure; beside curved quadratic elements.

    python tools/bench/bench_fits.py pin taper
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from typing import Any

import runner
import tables

import story
from scenes import fits

# Chords of the pin and of its hole
CHORDS = ((60, 36), (96, 60), (200, 120))
SIZES = (2.0,)
# Gaps and overlaps of the chords are smaller
ADJUST = 0.1
OPTIONS: dict[str, dict[str, Any]] = {
    "chords": {},
    "adjust": {"adjust": ADJUST},
    "adjust, smooth": {"adjust": ADJUST, "smooth": True},
}
CURVED = "curved quadratic"

PIN: list[tables.Column] = [
    ("chords", "mesh", "s"),
    ("options", "options", "s"),
    ("method", "method", "s"),
    ("it", "iterations", "d"),
    ("stress without load : E", "stress", ".1e"),
    ("peak", "peak", ".2f"),
    ("right", "right_peak", ".1f"),
    ("half angle", "angle", ".1f"),
    ("right", "right_angle", ".1f"),
]
TAPER: list[tables.Column] = [
    ("h", "h", "g"),
    ("options", "options", "s"),
    ("method", "method", "s"),
    ("dofs", "dofs", "d"),
    ("it", "iterations", "d"),
    ("push-in N", "push_in", ".0f"),
    ("pull-out N", "pull_out", ".0f"),
    ("open", "open", "d"),
    ("of", "nodes", "d"),
    ("peak : mean", "peak", ".2f"),
]


def pin(n: int, n_hole: int, options: str, method: str) -> dict[str, Any]:
    """The pin without and with its load, in this process."""
    chosen = {**OPTIONS[options], "method": method}
    idle = fits.PinInHole(n, n_hole, bearing=0.0, **chosen)
    idle.problem.solve()
    loaded = fits.PinInHole(n, n_hole, **chosen)
    loaded.problem.solve()
    p = loaded.contact.pressure.x.array
    return {
        "iterations": loaded.problem.report.iterations,
        "stress": idle.stress / fits.STEEL,
        "peak": float(p.max()),
        "right_peak": fits.PIN_PEAK,
        "angle": loaded.half_angle,
        "right_angle": fits.PIN_ANGLE,
    }


def taper(h: float, options: str, method: str) -> dict[str, Any]:
    """The taper, in this process."""
    scene = fits.Taper(h, 2 if options == CURVED else 1, method=method, **OPTIONS.get(options, {}))
    found = scene.push()
    return {
        **found,
        "dofs": len(scene.problem.u.x.array),
        "nodes": len(scene.contact.slave_nodes),
        "push_in": scene.largest,
        "pull_out": scene.least,
    }


def pins(chords: Sequence[tuple[int, int]]) -> Iterator[dict[str, Any]]:
    """Pins of different numbers of chords."""
    for n, n_hole in chords:
        for options in OPTIONS:
            for method in story.METHODS:
                job = {"n": n, "n_hole": n_hole, "options": options, "method": method}
                yield {"mesh": f"{n} : {n_hole}", **runner.alone("bench_fits:pin", **job)}


def tapers(sizes: Sequence[float]) -> Iterator[dict[str, Any]]:
    """Tapers of different cell sizes."""
    for h in sizes:
        for options in (*OPTIONS, CURVED):
            for method in story.METHODS:
                yield runner.alone("bench_fits:taper", h=h, options=options, method=method)


PARTS: dict[str, tables.Part] = {
    "pin": (PIN, pins, CHORDS, "A steel pin in its own hole, MPa and degrees"),
    "taper": (TAPER, tapers, SIZES, "A taper 1:10, pushed in by 0.3 mm and pulled out"),
}


def main(argv: Sequence[str], sizes: Sequence[Any] | None = None) -> list[dict[str, Any]]:
    """Measure and print.

    Args:
        argv: Names of ``PARTS``; all if empty.
        sizes: In place of those of each part.
    """
    return tables.show_parts(PARTS, argv, runner.OUTPUT / "fits", sizes)


if __name__ == "__main__":
    sys.exit(tables.failures(main(sys.argv[1:])))
