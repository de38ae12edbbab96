# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The map as pictures: a field for each scene, or a bar for each family."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from plot.style import DOTS_PER_INCH, INK
from stress.outcome import Kind, Outcome

_COLOURS = {
    Kind.CONVERGED: "#3b8f6b",
    Kind.CUT: "#9cc98f",
    Kind.RIGHTLY: "#6f9fc8",
    Kind.REFUSED: "#e0a93b",
    Kind.WRONG: "#c0392b",
}
_COLUMNS = 4


def draw(rows: Sequence[Outcome], path: Path) -> None:
    """Draw a panel for each family: values of its axis from left to right, variants below.

    Args:
        rows: All scenes.
        path: The image file.
    """
    families = list(dict.fromkeys(row.family for row in rows))
    lines = -(-len(families) // _COLUMNS)
    figure = Figure(figsize=(4.2 * _COLUMNS, 2.9 * lines + 0.8), layout="constrained")
    axes = figure.subplots(lines, _COLUMNS, squeeze=False).ravel()
    for axis, family in zip(axes, families, strict=False):
        _panel(axis, family, [row for row in rows if row.family == family])
    for axis in axes[len(families) :]:
        axis.set_visible(False)
    total = {kind: sum(row.kind == kind for row in rows) for kind in Kind}
    handles = [Patch(color=_COLOURS[k], label=f"{k}: {total[k]:,}") for k in Kind]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), frameon=False)
    figure.suptitle(f"Stress map: {len(rows):,} scenes", fontsize=15, color=INK)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")


def draw_families(rows: Sequence[Mapping[str, Any]], path: Path, note: str, source: str) -> None:
    """Draw a bar for each family: how many of a hundred scenes came to what.

    Args:
        rows: What is recorded of families, see ``sheet.families``.
        path: The image file.
        note: Small print.
        source: What the file says of what it was drawn from.
    """
    figure = Figure(figsize=(7.0, 0.27 * len(rows) + 1.6), layout="constrained")
    axis = figure.subplots()
    begins = np.zeros(len(rows))
    for kind, colour in _COLOURS.items():
        part = np.array([100 * (row[kind] or 0) / row["scenes"] for row in rows])
        total = sum(row[kind] or 0 for row in rows)
        label = f"{kind}: {total:,}"
        axis.barh(range(len(rows)), part, 0.78, begins, color=colour, label=label)
        begins += part
    names = [f"{row['family']} ({row['scenes']:,})" for row in rows]
    axis.set_yticks(range(len(rows)), names, fontsize=9)
    axis.set_xlim(0, 100)
    axis.set_ylim(len(rows) - 0.5, -0.5)
    axis.set_xlabel("of a hundred scenes", fontsize=10)
    axis.tick_params(axis="y", length=0)
    axis.spines[:].set_visible(False)
    total = sum(row["scenes"] for row in rows)
    figure.suptitle(f"Stress map: {total:,} scenes", fontsize=14, color=INK)
    words = {"title": note, "title_fontsize": 9, "fontsize": 10}
    figure.legend(loc="outside lower center", ncols=3, frameon=False, **words)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white", metadata={"Source": source})


def _panel(axis, family: str, rows: Sequence[Outcome]) -> None:
    values = list(dict.fromkeys(row.value for row in rows))
    variants = list(dict.fromkeys(row.variant for row in rows))
    order = list(Kind)
    field = np.full((len(variants), len(values)), np.nan)
    for row in rows:
        place = variants.index(row.variant), values.index(row.value)
        field[place] = np.nanmax([field[place], order.index(Kind(row.kind))])
    colours = ListedColormap([_COLOURS[kind] for kind in order])
    # Lines between many fields would hide them
    lines = {"ec": "white", "lw": 0.4} if len(variants) <= 40 else {}
    axis.pcolormesh(field, cmap=colours, vmin=-0.5, vmax=len(order) - 0.5, **lines)
    axis.invert_yaxis()
    axis.set_title(f"{family} ({len(rows):,})", fontsize=10, color=INK)
    step = max(1, -(-len(values) // 9))
    shown = np.arange(0, len(values), step)
    axis.set_xticks(shown + 0.5, [values[i] for i in shown], fontsize=7, rotation=30, ha="right")
    axis.set_yticks([])
    axis.set_ylabel(f"{len(variants)} variants", fontsize=8)
    axis.tick_params(length=0)
    axis.spines[:].set_visible(False)
