# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs of many steps or many problems, and how much memory the process has."""

from __future__ import annotations

import gc
import os
import resource
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from scenes.steps import KINDS, Rubbing

_EVERY = 40


def resident() -> float:
    """Memory of the process now, MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 2**20


def objects() -> int:
    """Number of Python's objects that garbage collection leaves."""
    gc.collect()
    return len(gc.get_objects())


def open_files() -> int:
    """Number of open files."""
    return len(os.listdir("/proc/self/fd"))


def dragged(kind: str, steps: int) -> Iterator[int]:
    """Drag a block to and fro over a base; now and then a step fails and is cut.

    Args:
        kind: One of ``KINDS``.
        steps: Number of given steps.

    Yields:
        Number of each accepted step.
    """
    scene = Rubbing(**KINDS[kind])
    attempts = 0

    def update(t: float) -> None:
        nonlocal attempts
        attempts += 1
        scene._down.g.value[...] = -0.05 - 0.03 * np.sin(31 * t)
        scene._side.g.value[...] = 0.4 * np.sin(2 * np.pi * t * steps / 50)
        # A load that is not a number: the step does not converge
        scene.load.value[:] = np.nan if attempts % _EVERY == 0 else 0.0

    for step in scene.steps(steps, update=update):
        yield step.index
    assert attempts > steps + steps // _EVERY


def problems(steps: int) -> Iterator[int]:
    """Make a problem, solve it and drop it, again and again, of all kinds in turn."""
    for k in range(steps):
        kind = list(KINDS)[k % len(KINDS)]
        scene = Rubbing(**KINDS[kind])
        scene.update(0.25)
        scene.problem.solve()
        yield k + 1


RUNS: dict[str, Callable[[int], Iterator[int]]] = {
    "node to surface": lambda n: dragged("nodes", n),
    "surface to surface": lambda n: dragged("facets", n),
    "condensed": lambda n: dragged("condensed", n),
    "tied": lambda n: dragged("tied", n),
    "problems made and dropped": problems,
}
