# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rigid tools pushed deep into sheets and blocks, in few steps or from an overlap at the start."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import numpy as np

import contactx as cx

from stress.check import Check
from stress.families.grid import drawn, label
from stress.grids import even, grid
from stress.outcome import taken
from stress.parts import Parts
from stress.scene import METHODS, Case, Scene, relative
from stress.sides import folded, pressed, pushes, stays, watch
from stress.tools import Ball, LevelBall, Press, Roll

_DEPTHS = (0.5, 1.05, 1.5, 2.0, 3.0)
_STEPS = (1, 2, 4, 8, 16)
# Steps of the path to the deepest depth, on which all of them lie
_PATH = 60


class _Scene:
    """A tool of radius 1 above a body whose face at height zero it is pushed into.

    Attributes:
        case: The case.
        parts: The body.
    """

    def __init__(
        self,
        depth: float,
        *,
        tool: str,
        thick: float,
        tagged: str,
        method: str,
        friction: float,
        begin: float = 0.0,
        halved: bool = False,
        steps: int = 1,
        cut: bool = True,
    ):
        """Make it.

        Args:
            depth: How far the tool goes down.
            tool: "disc", "level" or "plane", in space "roll" or "ball".
            thick: Thickness of a sheet held at its ends; from 4 on a block held at its bottom.
            tagged: Whether the "face" or the "whole" boundary is the slave.
            method: Method of the contact.
            friction: Coefficient.
            begin: Part of the depth that is there from the start, an overlap in radii.
            halved: Whether cells are triangles.
            steps: Load steps.
            cut: Whether they are cut.
        """
        solid = tool in ("roll", "ball")
        block = thick >= 4
        n = max(1, min(8, round(3 * thick)))
        x = even(-5, 5, 40) if block else even(-4, 4, 40)
        if tool == "plane":
            x = even(-1.5, 1.5, 8)
        if solid:
            x = even(-4, 4, 32) if tool == "roll" else even(-3, 3, 15)
        across = [even(-0.25, 0.25, 1) if tool == "roll" else x] if solid else []
        top = "z1" if solid else "y1"
        body = grid(x, *across, even(-thick, 0, min(n, 2) if solid else n))
        self.parts = parts = Parts(body, halved=halved and not solid)
        ends = ["z0" if solid else "y0"] if block else ["x0", "x1"]
        if tool == "ball" and not block:
            ends += ["y0", "y1"]
        parts.hold(0, *ends)
        dim = 3 if solid else 2
        self._at = np.zeros(dim)
        # Beside the lines of the grid
        self._at[0] = 0.03
        self._height = 0.0 if tool == "plane" else 1.0
        kinds = {"disc": Ball, "ball": Ball, "level": LevelBall, "plane": Press, "roll": Roll}
        self._depth, self._begin = depth, begin
        self.tool = kinds[tool](parts.mesh, self._place(0.0), 1.0)
        sides = [top] if tagged == "face" else []
        contact = cx.Contact(
            parts.surface(0, *sides), self.tool.obstacle, friction=friction, method=method
        )
        self._down = -np.eye(dim)[-1]
        facets = parts.facets(0, *sides)
        views = [
            pressed(parts, facets, self.tool, None if tool == "plane" else 1.0, method),
            pushes(parts, self._down),
        ]
        if tool != "plane":
            face = parts.facets(0, top)
            views.append(stays(parts, lambda: self.tool.at, face, -20 * self._down))
        self.case = parts.case(
            contact,
            lambda t: self.tool.move(self._place(t)),
            size=min(thick, 1.0),
            steps=steps,
            cut=cut,
            step_answers=watch(*views),
            tools=[self.tool],
            notes=partial(folded, parts),
        )

    def _place(self, t: float) -> np.ndarray:
        begin = min(self._begin, self._depth)
        at = self._at.copy()
        at[-1] = self._height - begin - t * (self._depth - begin)
        return at

    def force(self) -> float:
        """How the supports push back."""
        return float(self.parts.forces()[self.parts.held, -1].sum())


@cache
def _path(**options: Any) -> dict[float, float]:
    """Forces at the depths that small steps reach rightly."""
    scene = _Scene(max(_DEPTHS), steps=_PATH, **options)
    return {round(t * max(_DEPTHS), 9): scene.force() for t in taken(scene.case)}


def _case(depth: float, begin: float, steps: int, cut: bool, **options: Any) -> Case:
    scene = _Scene(depth, begin=begin, steps=steps, cut=cut, **options)

    def answers() -> list[Check]:
        path = _path(**options)
        if options["friction"] > 0 or depth not in path:
            return []
        return [relative("force is that of small steps", scene.force(), path[depth], 0.03)]

    scene.case.answers = answers
    return scene.case


def _solvable(depth: float, begin: float, **options: Any) -> bool:
    # Where the centre begins behind the surface nobody can tell the sides
    others = [options, *({**options, "tagged": "face", "method": method} for method in METHODS)]
    return begin < 1 and any(depth in _path(**own) for own in others)


def tools() -> Iterator[Scene]:
    """How deep a rigid tool goes, in its radii."""
    bodies = drawn(
        36,
        1,
        tool=("disc", "disc", "level", "plane", "roll", "ball"),
        thick=(0.05, 0.2, 0.5, 2.0, 4.0),
        tagged=("face", "whole"),
        method=METHODS,
        friction=(0.0, 0.0, 0.3),
        halved=(False, False, True),
    )
    number = 0
    for options in bodies:
        if options["tool"] == "plane":
            options["thick"] = 4.0
        if options["tool"] == "level":
            # A function tells of no movement, which friction would ask for
            options["friction"] = 0.0
        if options["tool"] == "ball":
            options["thick"] = min(options["thick"], 0.5)
        if options["tool"] in ("roll", "ball"):
            options["halved"] = False
    bodies = [row for i, row in enumerate(bodies) if row not in bodies[:i]]
    for options in bodies:
        for depth in _DEPTHS:
            for steps in _STEPS:
                if options["tool"] == "ball" and steps not in (1, 4):
                    continue
                cut, begin = number % 3 > 0, (0.0, 0.0, 0.0, 0.4, 0.9, 1.05)[number // 5 % 6]
                if options["thick"] < 2:
                    # A thin sheet could as well be in front of such a tool
                    begin = min(begin, 0.9)
                number += 1
                own = {**options, "begin": begin, "steps": steps, "cut": cut}
                yield Scene(
                    "rigid tool, depth in radii",
                    f"{depth:g}",
                    label(own),
                    partial(_case, depth, **own),
                    partial(_solvable, depth, begin, **options),
                )
