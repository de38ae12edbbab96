# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arches that snap through under a disc, and belts that are wound around a drum."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import numpy as np

import contactx as cx

from stress.families.grid import label, variants
from stress.grids import Array, disc, even, grid
from stress.outcome import taken
from stress.parts import Parts
from stress.scene import METHODS, Case, Scene
from stress.sides import View, apart, folded, pressed, pushes, stays, unfolded, watch
from stress.tools import Ball

_RADIUS = 0.5
# How far the disc goes down, in heights of the arch
_DEPTHS = (0.5, 1.0, 1.5, 2.0)
_PATH = 64


def _arch(
    depth: float,
    *,
    rise: float,
    kind: str,
    material: str,
    method: str,
    steps: int = 1,
    cut: bool = True,
) -> Case:
    """An arch of span 4 between clamps, with a disc at its top that is pushed down."""
    thick, n = 0.1, 32
    arch = grid(
        even(-2, 2, n),
        even(-thick, 0, 1),
        shape=lambda p, q: (p, q + rise * np.cos(np.pi * p / 4) ** 2),
    )
    soft = kind != "rigid"
    at = np.array([0.02, rise + _RADIUS])
    bodies = [arch, *([disc(8, _RADIUS, at)] if soft else [])]
    parts = Parts(*bodies, material=material, young=(1.0, 10.0)[: len(bodies)])
    parts.hold(0, "x0", "x1")
    down = rise * depth
    face = parts.facets(0, "y1")
    views: list[View] = [pushes(parts, (0.0, -1.0), parts.held.copy())]
    tool = None
    if soft:
        top = parts.hold(1, "y1")
        sides = ["y0", "x0", "x1"]
        surfaces = [parts.surface(1, *sides), parts.surface(0, "y1")]
        faces = [(1, parts.facets(1, *sides)), (0, face)]
        if kind == "arch is the slave":
            surfaces, faces = surfaces[::-1], faces[::-1]
        contact = cx.Contact(*surfaces, method=method)

        def thickness(at: Array) -> float:
            """Of the arch where it is nearest: linear bodies may swell by much."""
            x = parts.positions()[: 2 * (n + 1)].reshape(-1, 2, 2)
            column = np.linalg.norm(x[:, 1] - at, axis=1).argmin()
            return float(np.linalg.norm(x[column, 1] - x[column, 0]))

        views.append(apart(parts, *faces, radius=_RADIUS, method=method, size=thickness))
        middle = int(np.argmin(np.linalg.norm(parts.x - at, axis=1)))
        views.append(stays(parts, lambda: parts.positions()[middle], face, (0.0, 20.0)))

        def update(t: float) -> None:
            top.move((0.0, -t * down))
    else:
        tool = Ball(parts.mesh, at, _RADIUS)
        contact = cx.Contact(parts.surface(0, "y1"), tool.obstacle, method=method)
        views.append(pressed(parts, face, tool, _RADIUS, method))
        views.append(stays(parts, lambda: tool.at, face, (0.0, 20.0)))

        def update(t: float) -> None:
            tool.move(at - [0.0, t * down])

    if parts.nonlinear:
        views.append(unfolded(parts))
    return parts.case(
        contact,
        update,
        size=thick,
        steps=steps,
        cut=cut,
        step_answers=watch(*views),
        tools=[tool],
        notes=tuple if parts.nonlinear else partial(folded, parts),
    )


@cache
def _reached(**options: Any) -> float:
    """How deep small steps go rightly."""
    case = _arch(max(_DEPTHS), steps=_PATH, **options)
    return max(taken(case), default=0.0) * max(_DEPTHS)


def _solvable(depth: float, **options: Any) -> bool:
    kinds = [options["kind"]]
    if options["kind"] != "rigid":
        kinds = ["disc is the slave", "arch is the slave"]
    rows = variants(kind=kinds, method=METHODS)
    return any(_reached(**{**options, **row}) > depth - 1e-9 for row in rows)


def arches() -> Iterator[Scene]:
    """How far the disc goes down, in heights of the arch."""
    number = 0
    for own in variants(
        rise=(0.3, 0.8),
        kind=("rigid", "disc is the slave", "arch is the slave"),
        material=("linear", "svk"),
        method=METHODS,
    ):
        for depth in _DEPTHS:
            for steps in (1, 4, 16) if own["kind"] == "rigid" else (1, 4):
                cut = number % 3 > 0
                number += 1
                yield Scene(
                    "arch under a disc, depth in heights",
                    f"{depth:g}",
                    label({**own, "steps": steps, "cut": cut}),
                    partial(_arch, depth, steps=steps, cut=cut, **own),
                    partial(_solvable, depth, **own),
                )


def _belt(thick: float, wound: float, friction: float, method: str, steps: int, cut: bool) -> Case:
    """A belt on a drum of radius 1, its ends pulled down."""
    parts = Parts(grid(even(-2, 2, 60), even(1, 1 + thick, 1)), material="svk")
    ends = parts.hold(0, "x0", "x1")
    tool = Ball(parts.mesh, (0.01, 0.0), 1.0)
    contact = cx.Contact(parts.surface(0, "y0"), tool.obstacle, friction=friction, method=method)
    face = parts.facets(0, "y0")
    views = [
        pressed(parts, face, tool, 1.0, method),
        pushes(parts, (0.0, 1.0)),
        stays(parts, lambda: tool.at, face, (0.0, -20.0)),
        unfolded(parts),
    ]
    return parts.case(
        contact,
        lambda t: ends.move((0.0, -t * wound)),
        size=thick,
        steps=steps,
        cut=cut,
        step_answers=watch(*views),
        tools=[tool],
    )


def belts() -> Iterator[Scene]:
    """Thickness of a belt over the radius of its drum."""
    number = 0
    for thick in (0.005, 0.01, 0.02, 0.05, 0.1):
        for own in variants(
            wound=(0.1, 0.4, 1.2), friction=(0.0, 0.3), method=METHODS, steps=(1, 4)
        ):
            number += 1
            row = {**own, "cut": number % 4 > 0}
            more = {**row, "steps": 64, "cut": True}
            yield Scene(
                "belt on a drum, thickness",
                f"{thick:g}",
                label(row),
                partial(_belt, thick, **row),
                partial(_small_steps, thick, **more),
            )


@cache
def _small_steps(thick: float, **options: Any) -> bool:
    return abs(max(taken(_belt(thick, **options)), default=0.0) - 1) < 1e-9
