# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The map as a picture: a field for each scene, its colour says what came of it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

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
