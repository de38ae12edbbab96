# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The t of load steps as a user gives them; see ``problem/step_plan.h`` for what follows."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

import numpy as np

from contactx import cpp as core
from contactx.arguments import described, is_number


def make_plan(
    steps: int | Sequence[float], max_cuts: int, easy: int, t_end: float | None = None
) -> core.StepPlan:
    """Make a plan of what a user gives.

    Args:
        steps: Number of equal steps, or the t of each.
        max_cuts: How often a given step may be halved.
        easy: Iterations up to which an accepted step counts as easy.
        t_end: Where equal steps end, 1 if None; the largest t of a list.

    Raises:
        TypeError: If an argument is of another kind.
        ValueError: If a number is out of its range or the t do not increase.
    """
    if t_end is not None:
        if not is_number(t_end):
            raise TypeError(f"t_end is {described(t_end)}: give a number")
        if not (np.isfinite(t_end) and t_end > 0):
            raise ValueError(f"t_end is {t_end}: give a finite number above 0")
    end = 1.0 if t_end is None else float(t_end)
    max_cuts = _integer("max_cuts", max_cuts, 0, 40)
    easy = _integer("easy", easy, 0)
    if np.ndim(steps) == 0:
        n = _integer("steps", steps, 1)
        return core.StepPlan(core.StepPlan.equal(n, end), max_cuts, easy)
    try:
        given = np.asarray(steps, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"steps is {steps!r}: give a number of steps or a list of t") from None
    if given.ndim != 1 or len(given) == 0:
        raise ValueError(f"steps has shape {given.shape}: give a number of steps or a list of t")
    if not np.all((given > 0) & (given <= end)):
        bad = given[~((given > 0) & (given <= end))][0]
        hint = "" if t_end is not None else ", or give t_end"
        raise ValueError(
            f"steps holds t = {bad:g}: each t must be above 0 and at most {end:g}{hint}"
        )
    if np.any(np.diff(given) <= 0):
        k = int(np.argmax(np.diff(given) <= 0))
        raise ValueError(
            f"steps holds {given[k + 1]:g} after {given[k]:g}: each t must be larger than the last"
        )
    return core.StepPlan(given.tolist(), max_cuts, easy)


def _integer(name: str, value: Any, least: int, most: int | None = None) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}: give an integer") from None
    if number < least or (most is not None and number > most):
        limit = f"at least {least}" if most is None else f"from {least} to {most}"
        raise ValueError(f"{name} is {number}: give an integer {limit}")
    return number
