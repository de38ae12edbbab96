# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What a benchmark of the gallery is, and what comes of running it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import contactx as cx

# Largest relative error of a case that names no other
TOLERANCE = 0.03
# Where published values come from
TEXTBOOKS, NAFEMS, CODES = "textbooks and papers", "NAFEMS R0094", "tests of other codes"
_TESTED = ("Code_Aster", "CalculiX", "4C", "MOOSE", "PETSc")


@dataclass
class Answer:
    """What contactx gives.

    Attributes:
        draw: Draws a small picture on axes of matplotlib.
        expected: The value that a closed formula gives for what was computed, such as for a force
            that came of a given displacement; None where the value stands in the record.
    """

    value: float
    iterations: list[int]
    draw: Callable[[Any], None]
    expected: float | None = None


@dataclass(frozen=True)
class Case:
    """A published benchmark.

    Attributes:
        name: Short name, that of the picture's file.
        title: What is in contact with what.
        source: Who published the value, and where it stands.
        quantity: What is compared, with its unit.
        run: Solves it by the default options.
        published: The value; None where a closed formula gives it for the computed force.
        tolerance: Largest relative error.
        note: What should be known beside it; of a miss, why it is one.
        slow: Whether it takes more than 20 s.
        problem: What all cases have in common that compare values of one problem; the name if
            empty.
        options: Options that are not the default ones.
    """

    name: str
    title: str
    source: str
    quantity: str
    run: Callable[[], Answer]
    published: float | None = None
    tolerance: float = TOLERANCE
    note: str = ""
    slow: bool = False
    problem: str = ""
    options: str = ""

    @property
    def origin(self) -> str:
        """Where the value comes from."""
        if self.source.startswith(_TESTED):
            return CODES
        return NAFEMS if NAFEMS in self.source else TEXTBOOKS


@dataclass
class Result:
    """A case and its answer."""

    case: Case
    answer: Answer
    seconds: float = field(default=0.0)

    @property
    def published(self) -> float:
        """The value to compare with."""
        published = self.case.published
        value = self.answer.expected if published is None else published
        assert value is not None, f"{self.case.name} has no value to compare with"
        return value

    @property
    def error(self) -> float:
        """Relative error."""
        return self.answer.value / self.published - 1

    @property
    def row(self) -> dict[str, Any]:
        """What is recorded of it."""
        return {
            "name": self.case.name,
            "published": self.published,
            "contactx": self.answer.value,
            "error": self.error,
            "iterations": sum(self.answer.iterations),
            "steps": len(self.answer.iterations),
            "seconds": self.seconds,
        }


def solve(problem: cx.ContactProblem) -> list[int]:
    """Solve one step; linear solves as `Answer` takes them."""
    problem.solve()
    return [problem.report.iterations]


def steps(
    problem: cx.ContactProblem, number: Any, update: Callable[[float], None], **options: Any
) -> Iterator[int]:
    """Solve load steps; yields the linear solves of each, when it was accepted."""
    for step in cx.LoadSteps(problem, number, update=update, progress=False, **options):
        yield step.iterations
