# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tips, plates and blocks that are moved past one another, which they overlap too much for."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import numpy as np

import contactx as cx

from stress.families.grid import label, variants
from stress.grids import Body, even, grid
from stress.outcome import taken
from stress.parts import Parts
from stress.scene import METHODS, Case, Scene
from stress.sides import apart, folded, pushes, stays, watch

# Width at the foot and at the end over the height, and how many cells there are
_SHAPES = {
    "plate": (0.1, 0.1, (1, 10)),
    "tip": (0.4, 0.04, (2, 10)),
    "block": (1.0, 1.0, (4, 4)),
    "thin plate": (0.02, 0.02, (1, 12)),
}
_GAP = 0.02


def _standing(shape: str, up: bool, at: float, finer: int) -> Body:
    """A body of height 1 on its foot, or hanging from it; its lines are not those of the other."""
    foot, end, (n, m) = _SHAPES[shape]
    sign = 1.0 if up else -1.0
    return grid(
        even(-0.5, 0.5, n * finer),
        even(0, 1, m * finer),
        shape=lambda p, q: (at + p * (foot + (end - foot) * q), sign * q),
    )


def _lifted(body: Body, by: float) -> Body:
    return Body(body.x + np.array([0.0, by]), body.cells, body.faces)


def _case(
    way: float,
    *,
    shapes: tuple[str, str],
    overlap: float,
    tagged: str,
    method: str,
    swapped: bool = False,
    steps: int = 1,
    cut: bool = True,
) -> Case:
    """A hanging body is moved to the right against a standing one.

    Both are linear: what bends keeps its height, so that it can never slip past.
    """
    width = [_SHAPES[s][0] for s in shapes]
    ends = [_SHAPES[s][1] for s in shapes]
    # Flanks of tips slope: at half of the overlap they are this far apart
    share = 1 - overlap / 2
    at = sum((f + (e - f) * share) / 2 for f, e in zip(width, ends, strict=True)) + _GAP
    fine = 1 if shapes[0] != shapes[1] else 2
    left = _lifted(_standing(shapes[0], False, 0.0, fine), 2 - overlap)
    parts = Parts(left, _standing(shapes[1], True, at, 1))
    top = parts.hold(0, "y0")
    parts.hold(1, "y0")
    foot = np.unique(parts.bodies[1].faces["y0"])
    if tagged == "face":
        sides = ["x1"], ["x0"]
    else:
        sides = ["x0", "x1", "y1"], ["x0", "x1", "y1"]
    surfaces = [parts.surface(k, *names) for k, names in enumerate(sides)]
    faces = [(k, parts.facets(k, *names)) for k, names in enumerate(sides)]
    if swapped:
        surfaces, faces = surfaces[::-1], faces[::-1]
    contact = cx.Contact(*surfaces, method=method)
    end = np.unique(parts.bodies[0].faces["y1"])
    size = min(*width, *ends)
    views = [
        apart(parts, *faces, radius=None, method=method, size=size),
        pushes(parts, (1.0, 0.0), foot),
        # What hangs ends on the left of what stands. A part of it may come to lie on top, as high
        # as the left face is, but where its end is farthest to the left it has not passed it
        stays(
            parts,
            lambda: min(parts.positions()[end], key=lambda point: point[0]),
            parts.facets(1, "x0"),
            (-20.0, 0.0),
        ),
    ]
    return parts.case(
        contact,
        lambda t: top.move((t * way, 0.0)),
        size=size,
        steps=steps,
        cut=cut,
        step_answers=watch(*views),
        notes=partial(folded, parts),
    )


@cache
def _reached(**options: Any) -> float:
    """How far small steps go rightly."""
    return max(taken(_case(1.0, steps=64, **options)), default=0.0)


def _solvable(way: float, **options: Any) -> bool:
    """Whether the bodies can be moved so far; what is tagged, and how, is no matter of theirs."""
    others = [
        options,
        {**options, "swapped": True},
        *({**options, "tagged": "face", "method": method} for method in METHODS),
    ]
    return any(_reached(**own) > way - 0.02 for own in others)


def passing() -> Iterator[Scene]:
    """How far one is moved, in heights of either."""
    number = 0
    pairs = [
        ("plate", "plate"),
        ("tip", "tip"),
        ("block", "block"),
        ("thin plate", "thin plate"),
        ("plate", "block"),
        ("tip", "plate"),
    ]
    for own in variants(shapes=pairs, overlap=(0.1, 0.4), tagged=("face", "whole"), method=METHODS):
        for way in (0.1, 0.3, 0.6, 1.0):
            for steps in (1, 3):
                number += 1
                row = {**own, "steps": steps, "cut": number % 3 > 0}
                yield Scene(
                    "past one another, way in heights",
                    f"{way:g}",
                    label(row),
                    partial(_case, way, **row),
                    partial(_solvable, way, **own),
                )
