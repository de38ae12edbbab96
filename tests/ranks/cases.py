# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes, methods and partitions that are run on several ranks."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import contactx as cx

from ranks import partitions, scenes_coupled, scenes_elastic, scenes_moving, scenes_several

METHODS = {"node": "node-to-surface", "surface": "surface-to-surface"}
_MODULES = (scenes_elastic, scenes_several, scenes_coupled, scenes_moving)

# Functions that yield the problem after each step
SCENES: dict[str, Callable[[], Iterator[cx.ContactProblem]]] = {
    name: function
    for module in _MODULES
    for name, function in vars(module).items()
    if inspect.isgeneratorfunction(function) and not name.startswith("_")
}
# Scenes that name their method themselves: they are run by that one alone
ONE_METHOD = dict.fromkeys(("clip", "sheets", "discs"), "node")
ONE_METHOD |= {"dam_face": "surface", "dam_face_in_increments": "surface"}
# What they are for is in that one alone, or the same in both
ONE_METHOD |= {"tip_on_arm": "surface", "chords": "surface", "edge": "node"}
# What tests/fast runs on two ranks: friction, free bodies, ties, nodes in several
# contacts, dragging over the parts of ranks, an obstacle, inertia, self-contact, both solvers
QUICK = (
    ("friction_condensed", "node"),
    ("floating_3d", "surface"),
    ("tied", "node"),
    ("chain", "surface"),
    ("dragged_2d", "surface"),
    ("dragged_3d", "node"),
    ("plane", "node"),
    ("flying_2d", "surface"),
    ("clip", "node"),
)


@dataclass(frozen=True)
class Case:
    """A scene by a method on a distributed mesh."""

    scene: str
    method: str
    partition: str = partitions.DEFAULT

    def __str__(self) -> str:
        return f"{self.scene}-{self.method}-{self.partition}"

    @classmethod
    def read(cls, text: str) -> Case:
        """A case from its text."""
        return cls(*text.split("-"))
