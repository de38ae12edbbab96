# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The next t: given steps, halved where one fails and doubled where they are easy."""

from __future__ import annotations

import operator
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx.arguments import described, is_number


@dataclass(frozen=True)
class Plan:
    """The way from 0 to the last given t, and the place on it.

    Positions within a given step are multiples of a power of two, exact in floating point: every
    given t is met, and no sliver of a step is left before it.

    Attributes:
        given: The given t, increasing.
        max_cuts: How often a given step may be halved.
        easy: Iterations up to which an accepted step counts as easy.
        number: How many of the given t have been reached.
        start: Where the current given step begins.
        done: Share of it that has been accepted.
        cuts: How often it is halved at present.
        failed: Whether a longer step from this place has failed.
    """

    given: tuple[float, ...]
    max_cuts: int
    easy: int
    number: int = 0
    start: float = 0.0
    done: float = 0.0
    cuts: int = 0
    failed: bool = False

    @property
    def finished(self) -> bool:
        """True if the last given t has been reached."""
        return self.number == len(self.given)

    @property
    def t(self) -> float:
        """Last accepted t."""
        return self.start if self.finished else self._at(self.done)

    @property
    def next(self) -> float:
        """The t to attempt."""
        return self._at(self._share())

    def accept(self, iterations: int) -> Plan:
        """Go on behind an accepted step.

        Args:
            iterations: Linear solves that it took.

        Returns:
            The plan from there: after an easy step the next one is twice as long, unless such a
            step has just failed.
        """
        grows = iterations <= self.easy and not self.failed
        there = replace(self, cuts=max(self.cuts - 1, 0) if grows else self.cuts, failed=False)
        share = self._share()
        if share < 1:
            return replace(there, done=share)
        return replace(there, number=self.number + 1, start=self.next, done=0.0)

    def cut(self) -> Plan | None:
        """Halve the step that failed.

        Returns:
            The plan with a shorter step, None where it must not be any shorter.
        """
        cuts = self.cuts + 1
        # The rest of a given step may be shorter than what was to be attempted
        while self.done + 0.5**cuts >= 1:
            cuts += 1
        return replace(self, cuts=cuts, failed=True) if cuts <= self.max_cuts else None

    def save(self) -> dict[str, npt.NDArray[Any]]:
        """The given t and the place, for a checkpoint."""
        place = [self.number, self.start, self.done, self.cuts]
        return {"given": np.array(self.given), "place": np.array(place, dtype=np.float64)}

    def load(self, given: npt.NDArray[Any], place: npt.NDArray[Any]) -> Plan:
        """Go on from a saved place.

        Args:
            given: Given t of the plan that was saved; where this one has others, it goes on to the
                first of them that is larger than the saved t.
            place: What ``save`` made of the place.

        Returns:
            The plan from there.

        Raises:
            ValueError: If the saved t is beyond the last given one.
        """
        number, start, done, cuts = place.tolist()
        same = Plan(
            tuple(given.tolist()), self.max_cuts, self.easy, int(number), start, done, int(cuts)
        )
        if same.given == self.given:
            return same
        if same.t > self.given[-1]:
            raise ValueError(
                f"it is at t = {same.t:.6g}, beyond the last given t = {self.given[-1]:.6g}"
            )
        return replace(self, number=bisect_right(self.given, same.t), start=same.t)

    def _share(self) -> float:
        return min(self.done + 0.5**self.cuts, 1.0)

    def _at(self, share: float) -> float:
        end = self.given[self.number]
        return end if share == 1 else self.start + share * (end - self.start)


def make_plan(
    steps: int | Sequence[float], max_cuts: int, easy: int, t_end: float | None = None
) -> Plan:
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
        return Plan(tuple(end * (k / n) for k in range(1, n + 1)), max_cuts, easy)
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
    return Plan(tuple(given.tolist()), max_cuts, easy)


def _integer(name: str, value: Any, least: int, most: int | None = None) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}: give an integer") from None
    if number < least or (most is not None and number > most):
        limit = f"at least {least}" if most is None else f"from {least} to {most}"
        raise ValueError(f"{name} is {number}: give an integer {limit}")
    return number
