# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Slaves that are coarser than what presses them, which then lies between their nodes."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import numpy as np

import contactx as cx

from stress.families.grid import label, variants
from stress.grids import disc, even, grid
from stress.outcome import rightly
from stress.parts import Parts
from stress.scene import METHODS, SWAP, Case, Scene
from stress.sides import apart, folded, pressed, pushes, stays, watch
from stress.tools import Ball, Punch

_RATIOS = (2, 5, 10, 20, 50)
# Where the middle of what presses lies, in facets from a node
_PLACES = {"node": 0.0, "beside": 0.1, "quarter": 0.25, "middle": 0.5}
# What a message must name for its advice to count
_ADVICE_REFINE = r"(?i)(refine|finer)[^.;:]* slave|slave[^.;:]* (refine|finer)"


def _lines(length: float, near: tuple[float, float] | None, h: float) -> np.ndarray:
    """Lines of cells of size 1 about zero, finer within a distance of a place."""
    coarse = even(-length, length, round(2 * length))
    if near is None:
        return coarse
    place, width = near
    parts = [coarse]
    # Sizes double from ring to ring of lines
    while h < 1:
        parts.append(np.arange(np.floor((place - width) / h), np.ceil((place + width) / h) + 1) * h)
        h, width = 2 * h, 2 * width
    lines = np.unique(np.round(np.concatenate(parts), 9))
    lines = lines[(lines >= -length) & (lines <= length)]
    return lines[np.r_[True, np.diff(lines) > 1e-6]]


def _rigid(
    ratio: float, shape: str, place: str, method: str, dim: int, steps: int, cut: bool, fine: bool
) -> Case:
    """A rigid tool whose surface is as long as two facets over the ratio."""
    size = 2.0 / ratio
    at = _PLACES[place]
    lines = _lines(3, (at, 3 * size) if fine else None, size / 6)
    if dim == 2:
        height = -_lines(3, (0.0, 3 * size), size / 6)[::-1] if fine else even(-2, 2, 4)
        body = grid(lines, height[height <= 0])
    else:
        # At a node, or within a face
        body = grid(lines, lines, even(-2, 0, 2))
    top, bottom = ("y1", "y0") if dim == 2 else ("z1", "z0")
    parts = Parts(body)
    parts.hold(0, bottom)
    depth = 0.5 * size
    where = np.full(dim, at)
    if shape == "punch":
        where[-1] = size / 2
        tool = Punch(parts.mesh, where, size / 2, size)
    else:
        where[-1] = size
        tool = Ball(parts.mesh, where, size)
    down = -np.eye(dim)[-1]
    contact = cx.Contact(parts.surface(0, top), tool.obstacle, method=method)
    facets = parts.facets(0, top)
    radius = None if shape == "punch" else size
    views = [
        pressed(parts, facets, tool, radius, method),
        pushes(parts, down),
        stays(parts, lambda: tool.at, facets, -20 * down),
    ]
    return parts.case(
        contact,
        lambda t: tool.move(where + t * depth * down),
        size=min(size, 1.0),
        steps=steps,
        cut=cut,
        step_answers=watch(*views),
        tools=[tool],
        notes=partial(folded, parts),
    )


def _soft(
    ratio: float, shape: str, place: str, method: str, steps: int, cut: bool, swapped: bool
) -> Case:
    """A fine body of which a facet is shorter by the ratio than those of the block under it."""
    at, n = _PLACES[place], 6
    if shape == "disc":
        # A quarter of its rim has n facets
        size = n * 2 / np.pi / ratio
        upper, radius = disc(n, size, (at, size)), size
    else:
        size = n / ratio / 2
        upper = grid(even(at - size, at + size, n), even(0, 2 * size, n))
        radius = None
    block = grid(even(-3, 3, 6), even(-2, 0, 2))
    parts = Parts(block, upper)
    parts.hold(0, "y0")
    top = parts.hold(1, "y1")
    sides = ["y0", "x0", "x1"] if shape == "disc" else ["y0"]
    surfaces = [parts.surface(0, "y1"), parts.surface(1, *sides)]
    contact = cx.Contact(*(surfaces[::-1] if swapped else surfaces), method=method)
    # Apart from what is allowed at each of the ratios
    depth = 0.55 * size
    faces = [(0, parts.facets(0, "y1")), (1, parts.facets(1, *sides))]
    slave, master = faces[::-1] if swapped else faces
    near = parts.bodies[1].faces["y0"][n // 2, 0]
    views = [
        apart(parts, slave, master, radius=radius, method=method, size=size),
        pushes(parts, (0.0, -1.0), parts.bodies[0].faces["y0"].ravel()),
        stays(parts, lambda: parts.positions()[near] + [0, 0.5 * size], faces[0][1], (0.0, 20.0)),
    ]
    return parts.case(
        contact,
        lambda t: top.move((0.0, -t * depth)),
        size=min(2 * size, 1.0),
        steps=steps,
        cut=cut,
        step_answers=watch(*views),
        notes=partial(folded, parts),
    )


@cache
def _refined(**options: Any) -> bool:
    # A solid so fine would take minutes: what helps in the plane helps there
    return rightly(_rigid(steps=4, cut=True, fine=True, **{**options, "dim": 2}))


@cache
def _swapped(**options: Any) -> bool:
    return rightly(_soft(steps=4, cut=True, swapped=True, **options))


_PLANE = list(variants(place=tuple(_PLACES), method=METHODS, steps=(1, 4)))


def rigid() -> Iterator[Scene]:
    """Facets of the slave over half the radius of a rigid ball, or half the width of a punch."""
    number = 0
    for ratio in _RATIOS:
        for shape in ("ball", "punch"):
            for own in [{**row, "dim": 2} for row in _PLANE] + [
                {"place": place, "method": method, "steps": 1, "dim": 3}
                for place in ("node", "middle")
                for method in METHODS
                if shape == "ball"
            ]:
                number += 1
                steps = own.pop("steps")
                options = {"ratio": ratio, "shape": shape, **own}
                cut = number % 3 > 0
                refined = partial(_refined, **options)
                yield Scene(
                    "slave coarser than a rigid tool",
                    f"{ratio:g}",
                    label({"shape": shape, **own, "steps": steps, "cut": cut}),
                    partial(_rigid, steps=steps, cut=cut, fine=False, **options),
                    refined,
                    {_ADVICE_REFINE: refined},
                )


def soft() -> Iterator[Scene]:
    """How many facets of the master lie along one of the slave; with the finer one as the slave."""
    number = 0
    for ratio in _RATIOS:
        for shape in ("disc", "punch"):
            for own in _PLANE:
                number += 1
                options = {"ratio": ratio, "shape": shape, **own}
                steps = options.pop("steps")
                for swapped in (False, True):
                    cut = number % 3 > 0
                    row = {"shape": shape, **own, "cut": cut, "fine slave": swapped}
                    helps = partial(_swapped, **options)
                    yield Scene(
                        "slave coarser than the master",
                        f"{ratio:g}",
                        label(row),
                        partial(_soft, steps=steps, cut=cut, swapped=swapped, **options),
                        helps,
                        {} if swapped else {SWAP: helps},
                    )
