# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the demos share: arguments, the table of results, where pictures go."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

import contactx as cx

console = Console()


@dataclass(frozen=True)
class Result:
    """A number that a demo computes and a formula gives."""

    name: str
    expected: float
    computed: float

    @property
    def error(self) -> float:
        """Relative error."""
        return self.computed / self.expected - 1


def arguments(
    description: str, h: float, unit: str, argv: Sequence[str] | None
) -> argparse.Namespace:
    """Read the command line: size h, sliding and the folder of the pictures."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--h", type=float, default=h, help=f"cell size in the contact, {unit}")
    parser.add_argument(
        "--sliding", choices=("finite", "small"), default="finite", help="kinematics of contact"
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path(__file__).parent / "output",
        help="folder for pictures and files",
    )
    return parser.parse_args(argv)


@contextmanager
def progress(text: str) -> Iterator[Callable[[str], None]]:
    """Show what is going on; yields a function that changes the text."""
    with console.status(text) as status:
        yield status.update


def solve(problem: cx.ContactProblem) -> None:
    """Solve and show the iterations as they come."""
    with progress("solving") as show:

        def monitor(*_: object) -> None:
            row = problem.report.history[-1]
            show(
                f"solving: iteration {row.number}, residual {row.residual:.1e} "
                f"(to reach {row.tolerance:.1e}), {row.closed} nodes in contact"
            )

        problem.solver.setMonitor(monitor)
        problem.solve()
    console.print(str(problem.report), highlight=False)


def show(title: str, results: Sequence[Result], files: Sequence[Path]) -> None:
    """Print the results against the formula, and where the pictures are."""
    table = Table("", "expected", "computed", "error", title=title)
    for r in results:
        table.add_row(r.name, f"{r.expected:.6g}", f"{r.computed:.6g}", f"{100 * r.error:+.2f} %")
    console.print(table)
    for file in files:
        console.print(f"see {file}", soft_wrap=True, highlight=False)
