# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies with inertia that hit something."""

from __future__ import annotations

from functools import cache

import impact_bars
import numpy as np
from impact_bars import SCENES, VELOCITY, Bars

from published.drawing import curve
from published.record import Answer, Case

_SOURCE = "S. Timoshenko and J. N. Goodier, Theory of Elasticity, 3rd ed., 1970, section 169"


@cache
def _bars(scene: str) -> Bars:
    """Bars of 100 cells, after they have bounced."""
    bars = Bars(scene, 100, 1.0)
    bars.run()
    return bars


def _answer(value: float, bars: Bars) -> Answer:
    """A value of bars, and the contact force over time."""

    def exact(t: np.ndarray) -> np.ndarray:
        return np.where(t < 2, 1.0, 0.0)

    labels = ("time c / L", "force / rho c v A")
    return Answer(value, bars.iterations, curve(bars.times, bars.forces, labels, exact))


def force() -> Answer:
    """Contact force of a bar on a wall."""
    bars = _bars(SCENES[0])
    return _answer(float(bars.steady.mean()), bars)


def duration() -> Answer:
    """Time for which a bar is on a wall."""
    bars = _bars(SCENES[0])
    return _answer(bars.duration, bars)


def velocity() -> Answer:
    """Velocity of one of two bars after they have hit each other."""
    bars = _bars(SCENES[1])
    return _answer(bars.velocity / VELOCITY, bars)


CASES = [
    Case(
        "bar_force",
        "Elastic bar that hits a rigid wall",
        _SOURCE,
        f"contact force over rho c v A, mean from {impact_bars.BETWEEN[0]} "
        f"to {impact_bars.BETWEEN[1]} L/c",
        force,
        published=1.0,
        problem="bar",
    ),
    Case(
        "bar_time",
        "Elastic bar that hits a rigid wall",
        _SOURCE,
        "time of contact over L/c",
        duration,
        published=2.0,
        problem="bar",
    ),
    Case(
        "bars_velocity",
        "Two like elastic bars that hit each other",
        _SOURCE,
        "mean velocity after over that before",
        velocity,
        published=1.0,
        note="By bars of 100 cells; the rest is in waves of the length of some cells that stay "
        "in the bars. With 200 cells it is 1.2 %.",
    ),
]
