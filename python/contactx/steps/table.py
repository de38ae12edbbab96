# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Accepted steps and their table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from rich.table import Table

from contactx.report import Report, render


@dataclass(frozen=True)
class Step:
    """An accepted step.

    Attributes:
        index: Number of the step; 1 is the first one.
        t: Where it ends.
        report: Report of its solve.
    """

    index: int
    t: float
    report: Report = field(repr=False)

    @property
    def iterations(self) -> int:
        """Linear solves; those of cut attempts are in ``report.discarded``."""
        return self.report.iterations


class Row(NamedTuple):
    """A line of the table.

    Attributes:
        t: Where the step ends.
        iterations: Linear solves.
        discarded: Linear solves of the attempts that were cut.
        closed: Slave nodes in contact.
        seconds: Wall time, with the attempts that were cut.
    """

    t: float
    iterations: float
    discarded: float
    closed: float
    seconds: float


def make_row(step: Step, seconds: float) -> Row:
    """Line of an accepted step."""
    report = step.report
    return Row(step.t, report.iterations, report.discarded, report.history[-1].closed, seconds)


def table(rows: Sequence[Row]) -> str:
    """Text table of accepted steps."""
    result = Table("step", "t", "iterations", "discarded", "closed", "seconds")
    for index, row in enumerate(rows, start=1):
        result.add_row(
            str(index),
            f"{row.t:.6g}",
            f"{row.iterations:.0f}",
            f"{row.discarded:.0f}",
            f"{row.closed:.0f}",
            f"{row.seconds:.2f}",
        )
    return render(result)
