# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Progress bar of load steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import rich
from rich.progress import (
    BarColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from contactx.problem import ContactProblem

type Show = Callable[[float, str], None]


class _IterationsColumn(ProgressColumn):
    """Iterations of the solve under way, read whenever the bar is drawn."""

    def __init__(self, problem: ContactProblem):
        super().__init__()
        self._problem = problem

    def render(self, task: Task) -> Text:
        """Number of linear solves so far."""
        return Text(f"iteration {self._problem.report.iterations}")


@contextmanager
def progress_bar(problem: ContactProblem, begin: float, end: float) -> Iterator[Show]:
    """Show a progress bar, which vanishes at the end; nothing where there is no terminal.

    Args:
        problem: Problem whose iterations are shown.
        begin: Accepted t.
        end: Last t.

    Yields:
        A function that takes the accepted t and what is being done.
    """
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        _IterationsColumn(problem),
        TimeElapsedColumn(),
        TextColumn("left:"),
        TimeRemainingColumn(),
    )
    # Steps may take long: their speed is that of all steps so far
    console = rich.get_console()
    with Progress(
        *columns,
        console=console,
        transient=True,
        disable=not console.is_terminal,
        speed_estimate_period=float("inf"),
    ) as progress:
        bar = progress.add_task("", total=end)
        progress.update(bar, completed=begin)
        yield lambda t, text: progress.update(bar, completed=t, description=text, refresh=True)


def show_text(text: str) -> None:
    """Print a text on rich's console."""
    rich.get_console().print(text, highlight=False, end="")
