# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of the benchmarks, on the screen and as CSV files."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from rich.console import Console
from rich.table import Table

# Heading, key in the rows and format
Column = tuple[str, str, str]
# What two solvers of one scene are compared by
SOLVER: list[Column] = [
    ("sliding", "sliding", "s"),
    ("solver", "solver", "s"),
    ("dofs", "dofs", "d"),
    ("it", "iterations", "d"),
    ("Krylov", "krylov", "d"),
    ("hier.", "hierarchies", "d"),
]
COST: list[Column] = [
    ("CPU s", "cpu", ".2f"),
    (": direct", "ratio", ".2f"),
    ("MB", "memory", ".0f"),
]
DIFFERENCE: list[Column] = [("du", "u_difference", ".1e"), ("dF", "force_difference", ".1e")]
console = Console(width=150, highlight=False)


# Columns, rows by sizes, the usual sizes and the title of a table
Part = tuple[Sequence[Column], Callable[[Any], Iterator[dict[str, Any]]], Sequence[Any], str]


def show_parts(
    parts: Mapping[str, Part], names: Sequence[str], stem: Path, sizes: Sequence[Any] | None
) -> list[dict[str, Any]]:
    """Measure and print the parts of a benchmark.

    Args:
        parts: Parts by their names.
        names: Those to measure; all if empty.
        stem: Files of the tables, to which the names of the parts are added.
        sizes: In place of those of each part.

    Returns:
        Rows of all tables.
    """
    every = []
    for name in names or parts:
        columns, measured, usual, title = parts[name]
        rows = list(measured(usual if sizes is None else sizes))
        show(title, columns, rows, stem.with_name(f"{stem.name}_{name}.csv"))
        every += rows
    return every


def show(title: str, columns: Sequence[Column], rows: Sequence[dict[str, Any]], path: Path) -> None:
    """Print rows and write them to files.

    Args:
        title: Title of the table.
        columns: Columns of the table.
        rows: Values by their keys; one that is missing is left out.
        path: CSV file, with all values of the rows; beside it the table itself, as Markdown.
    """
    table = Table(title=title, padding=(0, 0, 0, 1), pad_edge=False)
    for heading, _, form in columns:
        table.add_column(heading, justify="left" if form == "s" else "right", overflow="fold")
    for row in rows:
        table.add_row(*(_text(row.get(key), form) for _, key, form in columns))
    console.print(table)
    for row in rows:
        if "failed" in row:
            name = ", ".join(_text(row.get(key), form) for _, key, form in columns[:4])
            note(f"failed: {name}: {row['failed']}")
    path.parent.mkdir(parents=True, exist_ok=True)
    names = list(dict.fromkeys(name for row in rows for name in row))
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        writer.writerows(rows)
    path.with_suffix(".md").write_text(_markdown(columns, rows))
    note(f"see {path}")


def failures(rows: Sequence[dict[str, Any]]) -> int:
    """Number of rows that could not be measured."""
    return sum("failed" in row for row in rows)


def note(text: str) -> None:
    """Print a line."""
    console.print(text, soft_wrap=True, markup=False)


def read(path: Path) -> list[dict[str, Any]]:
    """Rows of a CSV file, numbers as such and empty places left out."""
    with path.open(newline="") as file:
        return [{k: _value(v) for k, v in row.items() if v != ""} for row in csv.DictReader(file)]


def power_law(x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[float, float]:
    """Fit y = factor x^exponent by least squares in logarithms.

    Args:
        x: Positive values, shape (n,).
        y: Positive values, shape (n,).

    Returns:
        Exponent and factor, NaN for less than two different x.
    """
    if np.unique(np.asarray(x)).size < 2:
        return math.nan, math.nan
    exponent, logarithm = np.polyfit(np.log(np.asarray(x)), np.log(np.asarray(y)), 1)
    return float(exponent), float(np.exp(logarithm))


def _markdown(columns: Sequence[Column], rows: Sequence[dict[str, Any]]) -> str:
    table = [
        [heading for heading, _, _ in columns],
        ["---" if form == "s" else "---:" for _, _, form in columns],
        *([_text(row.get(key), form) for _, key, form in columns] for row in rows),
    ]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in table)


def _text(value: Any, form: str) -> str:
    return "" if value is None else format(value, form)


def _value(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return text
