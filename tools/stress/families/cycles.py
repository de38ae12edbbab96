# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A thousand steps of loads that come and go: does anything drift?"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dolfinx.mesh import CellType

from stress.alone import Alone
from stress.blocks import Blocks
from stress.check import Check
from stress.families.grid import scenes, variants
from stress.scene import METHODS, SLIDINGS, Case, Scene, relative
from stress.tools import Floor

_STEPS, _PERIOD = 1000, 40


def cyclic() -> Iterator[Scene]:
    """Blocks pushed to and fro by a part of what makes them slip, pressed and let go."""
    values = ("sticks", "slips", "pressed and let go", "free block shaken")
    options = list(variants(method=METHODS, sliding=SLIDINGS, friction=(0.3,)))
    yield from scenes("1,000 steps to and fro", values, options, _case)


def _case(motion, **options) -> Case:
    if motion == "free block shaken":
        return _shaken(**options)
    blocks = Blocks(
        n_upper=(3, 2), n_lower=(5, 1), size_upper=(1.0, 0.5), down=0.03, steps=_STEPS, **options
    )
    case = blocks.case()
    top = case.bcs[1].g
    amplitude = {"sticks": 0.001, "slips": 0.1}.get(motion, 0.0)

    def update(t):
        phase = 2 * np.pi * t * _STEPS / _PERIOD
        lift = 0.5 * (1 - np.cos(phase)) if motion == "pressed and let go" else 0.0
        side = amplitude * np.sin(phase)
        top.x.array.reshape(-1, 2)[:] = side, -blocks.down * (1 - 1.5 * lift)

    case.update = update
    _periodic(case, blocks.u, blocks.contact)
    return case


def _shaken(method, sliding, friction) -> Case:
    scene = Alone(
        CellType.quadrilateral,
        lambda domain: Floor(domain, (0.0, 0.0)),
        n=(4, 1),
        size=(1.0, 0.2),
        moved=False,
        method=method,
        sliding=sliding,
        friction=friction,
    )

    def update(t):
        phase = 2 * np.pi * t * _STEPS / _PERIOD
        scene.load.value[:] = 0.5 * friction * 0.01 * np.sin(phase), -0.01

    scene.case.update, scene.case.steps = update, _STEPS
    _periodic(scene.case, scene.u, scene.contact)
    return scene.case


def _periodic(case: Case, u, contact) -> None:
    """After some periods each one must end as the one before."""
    ends: list[tuple[np.ndarray, np.ndarray]] = []

    def step_answers(t):
        number = round(t * _STEPS)
        if number % _PERIOD or abs(t * _STEPS - number) > 1e-6:
            return []
        ends.append((u.x.array.copy(), np.copy(contact.force)))
        if len(ends) <= 5:
            return []
        # The first periods shake down; after that nothing may drift
        first, now = ends[4], ends[-1]
        return [
            relative("displacement of the period", now[0], first[0], 1e-4),
            relative("force of the period", now[1], first[1], 1e-4, least=1e-6),
        ]

    def answers():
        return [Check("periods", abs(len(ends) - _STEPS // _PERIOD), 0.0)]

    case.step_answers, case.answers = step_answers, answers
