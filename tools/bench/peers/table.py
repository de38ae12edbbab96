# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""What was measured on the common Hertz problem: ``peers.csv``, which ``bench_peers.py`` writes."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import tables

FILE = Path(__file__).parents[1] / "peers.csv"
COLUMNS = (
    *("peer", "version", "setting", "h", "dofs", "iterations", "cpu", "wall", "memory"),
    *("p0_err", "p_l2", "pen", "date", "machine", "commit"),
)
OURS = "contactx"

Row = dict[str, str]


def rows(path: Path = FILE) -> list[Row]:
    """Rows as they are written."""
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def name(row: Row) -> str:
    """Code, its version where the row has it, and setting."""
    return f"{' '.join(filter(None, (row['peer'], row.get('version'))))}, {row['setting']}"


def shown(row: Row) -> dict[str, str]:
    """What tables have of a row, in their order; wall seconds where there are no others."""
    return {
        "name": name(row),
        "h": row["h"],
        "size": f"{int(row['dofs']):,}",
        "iterations": row["iterations"],
        "time": row["cpu"] or f"({row['wall']})",
        **{key: row[key] for key in ("memory", "p_l2", "pen")},
    }


def numbers(path: Path = FILE) -> dict[str, list[dict[str, Any]]]:
    """Numbers of all codes, by the name of code and setting; contactx is first."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for row, values in zip(rows(path), tables.read(path), strict=True):
        groups.setdefault(name(row), []).append(values)
    return dict(sorted(groups.items(), key=lambda item: not item[0].startswith(OURS)))


def others(path: Path = FILE) -> dict[str, list[dict[str, Any]]]:
    """Numbers of all codes but contactx."""
    every = numbers(path)
    return {name: every[name] for name in every if not name.startswith(OURS)}


def update(measured: Iterable[Row], path: Path = FILE) -> list[Row]:
    """Put rows in place of those of the same code, setting and size, and write all of them.

    Rows that were not measured stay as they are, with the date of their measurement.

    Returns:
        All rows: contactx first, then by code and setting in the order of the file.
    """

    def key(row: Row) -> tuple[str, str, float]:
        return row["peer"], row["setting"], float(row["h"])

    found = {key(row): row for row in rows(path)}
    found |= {key(row): row for row in measured}
    codes = [OURS, *dict.fromkeys(code for code, _, _ in found)]
    settings = list(dict.fromkeys((code, setting) for code, setting, _ in found))
    order = sorted(found, key=lambda k: (codes.index(k[0]), settings.index(k[:2]), -k[2]))
    every = [found[k] for k in order]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(every)
    return every
