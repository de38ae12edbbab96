# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edges that something smooth touches: forces by both methods, and either side as the slave.

The corner of a block slides along a bent arm: the force on the block, and the part of its work that
the bodies have not stored, which without friction is none. The arm's nodes cannot see the corner
between them: with the arm as the slave the audit refuses node-to-surface, at the depth shown. A
ball is pushed on a plate's edge: the force, and how much of it goes across, beside the direction
from the edge to the ball's middle.

    python tools/bench/bench_edges.py tip ball
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import runner
import tables

import contactx as cx

import measured
import story
from scenes import ball_at_edge
from scenes.tip_on_arm import TipOnArm

# Cells along the arm, and sizes of the ball's and the plate's cells
CELLS = (20, 40)
SIZES = (0.28, 0.13)

TIP: list[tables.Column] = [
    ("n", "n", "d"),
    ("method", "method", "s"),
    ("slave", "slave", "s"),
    ("depth", "depth", ".3f"),
    ("F along", "along", "+.4e"),
    ("F down", "down", "+.4e"),
    ("work not stored", "lost", "+.4f"),
]
BALL: list[tables.Column] = [
    ("h", "h", "g"),
    ("method", "method", "s"),
    ("slave", "slave", "s"),
    ("it", "iterations", "d"),
    ("F", "force", ".5f"),
    ("across : down", "ratio", ".4f"),
    ("right", "right", ".4f"),
]


def tip(n: int, method: str, swapped: bool) -> dict[str, Any]:
    """The corner on the arm, in this process: how deep it comes until it is refused, if it is."""
    scene = TipOnArm(n, method=method, swapped=swapped)
    try:
        force, work = scene.pushed()
    except cx.ConvergenceError as error:
        return {"depth": -float(scene.way.value[1]), "refused": str(error.report.reason)}
    return {
        "depth": -float(scene.way.value[1]),
        "along": float(force[0]),
        "down": float(-force[1]),
        "lost": float(work / scene.energy() - 1),
    }


def ball(h: float, method: str, swapped: bool) -> dict[str, Any]:
    """The ball on the edge, in this process."""
    scene = ball_at_edge.BallAtEdge(h, method=method, swapped=swapped)
    iterations = scene.push()
    force = scene.force
    return {
        "iterations": iterations,
        "force": float(np.linalg.norm(force)),
        "ratio": float(force[0] / force[2]),
        "right": ball_at_edge.RIGHT,
    }


def tips(n: Sequence[int]) -> Iterator[dict[str, Any]]:
    """The corner on arms of different numbers of cells."""
    for cells in n:
        for method in story.METHODS:
            for swapped, slave in ((False, "corner"), (True, "arm")):
                row = runner.alone("bench_edges:tip", n=cells, method=method, swapped=swapped)
                yield {"slave": slave, **row}


def balls(h: Sequence[float]) -> Iterator[dict[str, Any]]:
    """The ball on meshes of different sizes."""
    for size in h:
        for method in story.METHODS:
            for swapped, slave in ((False, "ball"), (True, "plate")):
                row = runner.alone("bench_edges:ball", h=size, method=method, swapped=swapped)
                yield {"slave": slave, **row}


PARTS: dict[str, tables.Part] = {
    "tip": (TIP, tips, CELLS, "A corner slides along a bent arm, over Young's modulus"),
    "ball": (BALL, balls, SIZES, "A ball on the edge of a plate, over Young's modulus"),
}


def main(argv: Sequence[str], sizes: Sequence[float] | None = None) -> list[dict[str, Any]]:
    """Measure and print.

    Args:
        argv: Names of ``PARTS``; all if empty.
        sizes: In place of those of each part.
    """
    return tables.show_parts(PARTS, argv, runner.OUTPUT / "edges", sizes)


if __name__ == "__main__":
    sys.exit(measured.run("edges", main, sys.argv[1:]))
