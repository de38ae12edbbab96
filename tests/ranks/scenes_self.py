# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A surface on itself, and bodies that all may meet: node-to-surface alone."""

from __future__ import annotations

from collections.abc import Iterator

from closing_clip import CLOSING, Clip
from settling_discs import Box

import contactx as cx

from scenes.thin_sheets import ThinSheets

NODES = "node-to-surface"


def clip() -> Iterator[cx.ContactProblem]:
    """Tips that are far apart along the boundary come together."""
    clip = Clip(0.2, friction=0.2, method=NODES)
    for load in (0.5, 2.0):
        clip.press(load * CLOSING)
        clip.problem.solve()
        yield clip.problem


def sheets() -> Iterator[cx.ContactProblem]:
    """A sheet has contact on both sides."""
    sheets = ThinSheets(friction=0.3, method=NODES)
    sheets.problem.solve()
    yield sheets.problem


def discs() -> Iterator[cx.ContactProblem]:
    """Discs fall onto one another."""
    box = Box(0.2, rows=2, columns=2, method=NODES)
    for _ in box.fall():
        yield box.problem
        if box.steps >= 4:
            return
