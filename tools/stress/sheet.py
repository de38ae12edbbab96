# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The map as tables: every scene in a CSV file, families on the screen and in Markdown."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from stress.outcome import Kind, Outcome

HEADINGS = ("family", "scenes", *Kind, "steps", "iterations", "most in a step")


def write(rows: Sequence[Outcome], path: Path) -> None:
    """Write every scene to a CSV file."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].row() if rows else ["family"])
        writer.writeheader()
        writer.writerows(row.row() for row in rows)


def read(path: Path) -> list[Outcome]:
    """Read such a file."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    types = {name: type(value) for name, value in Outcome("", "", "").row().items()}
    return [
        Outcome(**{n: (str if t is Kind else t)(row[n]) for n, t in types.items()}) for row in rows
    ]


def counts(rows: Sequence[Outcome]) -> list[list[str]]:
    """One line a family, and one for all."""
    lines = []
    for family in [*dict.fromkeys(row.family for row in rows), None]:
        own = [row for row in rows if family in (None, row.family)]
        kinds = Counter(row.kind for row in own)
        most = max((row.iterations / max(row.steps, 1) for row in own), default=0.0)
        lines.append(
            [
                family or "all",
                f"{len(own):,}",
                *(f"{kinds[kind]:,}" for kind in Kind),
                f"{sum(row.steps for row in own):,}",
                f"{sum(row.iterations for row in own):,}",
                f"{most:.0f}",
            ]
        )
    return lines


def families(rows: Sequence[Outcome]) -> list[dict[str, Any]]:
    """What is recorded of each family; ``of`` is how many scenes it has, run or not."""
    found = []
    for family in dict.fromkeys(row.family for row in rows):
        own = [row for row in rows if row.family == family]
        kinds = Counter(row.kind for row in own)
        found.append(
            {
                "family": family,
                "of": len(own),
                "scenes": len(own),
                **{kind: kinds[kind] for kind in Kind},
                "steps": sum(row.steps for row in own),
                "iterations": sum(row.iterations for row in own),
                "most": max(row.iterations / max(row.steps, 1) for row in own),
            }
        )
    return found


def show(rows: Sequence[Outcome], console: Console, path: Path) -> None:
    """Print the families and write them to a Markdown file, with the refused scenes."""
    table = Table(*HEADINGS)
    lines = counts(rows)
    for line in lines:
        table.add_row(*line)
    console.print(table)
    marks = ["---", *["---:"] * (len(HEADINGS) - 1)]
    text = [f"| {' | '.join(cells)} |" for cells in [HEADINGS, marks, *lines]]
    for row in rows:
        if row.kind in (Kind.REFUSED, Kind.WRONG):
            text += ["", f"{row.kind}: {row.family}: {row.value}, {row.variant}: {row.reason}"]
    path.write_text("\n".join(text) + "\n")
