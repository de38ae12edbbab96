# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Rollers pressed into blocks of large strains, whose cells must not turn inside out."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial
from typing import Any

import contactx as cx

from stress.check import Check
from stress.families.grid import label, variants
from stress.grids import disc, even, grid
from stress.outcome import taken
from stress.parts import Parts
from stress.scene import METHODS, Case, Scene, relative
from stress.sides import View, apart, pressed, pushes, stays, unfolded, watch
from stress.tools import Ball

_DEPTHS = (0.25, 0.5, 0.75, 1.0, 1.5)
# Steps of the path to the deepest depth, on which all of them lie
_PATH = 60


class _Roller:
    """A roller of radius 1 on a block of height 3.

    Attributes:
        case: The case.
    """

    def __init__(
        self,
        depth: float,
        *,
        roller: str,
        material: str,
        halved: bool,
        method: str,
        friction: float = 0.0,
        steps: int = 1,
        cut: bool = True,
    ):
        """Make it."""
        block = grid(even(-3, 3, 24), even(-3, 0, 8))
        soft = roller != "rigid"
        bodies = [block, *([disc(10, 1.0, (0.02, 1.0))] if soft else [])]
        young = (1.0, {"rigid": 1.0, "stiff": 20.0, "alike": 1.0}[roller])[: len(bodies)]
        self._parts = parts = Parts(*bodies, material=material, young=young, halved=halved)
        parts.hold(0, "y0")
        self._support = parts.held.copy()
        face = parts.facets(0, "y1")
        views: list[View] = [pushes(parts, (0.0, -1.0), self._support), unfolded(parts)]
        tool = None
        if soft:
            top = parts.hold(1, "y1")
            sides = ["y0", "x0", "x1"]
            contact = cx.Contact(
                parts.surface(1, *sides), parts.surface(0, "y1"), method=method, friction=friction
            )
            slave, master = (1, parts.facets(1, *sides)), (0, face)
            views.append(apart(parts, slave, master, radius=1.0, method=method, size=1.0))

            def update(t: float) -> None:
                top.move((0.0, -t * depth))
        else:
            tool = Ball(parts.mesh, (0.02, 1.0), 1.0)
            contact = cx.Contact(
                parts.surface(0, "y1"), tool.obstacle, method=method, friction=friction
            )
            views.append(pressed(parts, face, tool, 1.0, method))
            views.append(stays(parts, lambda: tool.at, face, (0.0, 20.0)))

            def update(t: float) -> None:
                tool.move((0.02, 1.0 - t * depth))

        self.case = parts.case(
            contact,
            update,
            steps=steps,
            cut=cut,
            step_answers=watch(*views),
            tools=[tool],
        )

    def force(self) -> float:
        """How the support pushes back."""
        return float(self._parts.forces()[self._support, 1].sum())


@cache
def _path(**options: Any) -> dict[float, float]:
    """Forces at the depths that small steps reach rightly."""
    scene = _Roller(max(_DEPTHS), steps=_PATH, **options)
    return {round(t * max(_DEPTHS), 9): scene.force() for t in taken(scene.case)}


def _case(depth: float, steps: int, cut: bool, **options: Any) -> Case:
    scene = _Roller(depth, steps=steps, cut=cut, **options)

    def answers() -> list[Check]:
        path = _path(**options)
        if options["friction"] > 0 or depth not in path:
            return []
        return [relative("force is that of small steps", scene.force(), path[depth], 0.03)]

    scene.case.answers = answers
    return scene.case


def _solvable(depth: float, **options: Any) -> bool:
    return any(depth in _path(**{**options, "method": method}) for method in METHODS)


def folding() -> Iterator[Scene]:
    """How deep the roller goes, in its radii."""
    number = 0
    for own in variants(
        roller=("rigid", "stiff", "alike"),
        material=("svk", "neo-hooke"),
        halved=(False, True),
        method=METHODS,
    ):
        own["friction"] = 0.3 if number % 8 == 4 else 0.0
        for depth in _DEPTHS:
            for steps in (1, 2, 4, 8):
                number += 1
                cut = number % 3 > 0
                yield Scene(
                    "roller at large strains, depth in radii",
                    f"{depth:g}",
                    label({**own, "steps": steps, "cut": cut}),
                    partial(_case, depth, steps, cut, **own),
                    partial(_solvable, depth, **own),
                )
        number += 1
