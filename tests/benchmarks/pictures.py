# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Log-log pictures of the benchmarks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, NullFormatter

from contactx.plot.style import COLOURS, DOTS_PER_INCH, INK

_MARKERS = "osD^vP*X<>p"
_PEERS = ("#5b7f95", "#8aa05a", "#7d6aa8", "#3f8f86", "#a8795a", "#7a7f87")
_OURS = (COLOURS[3], COLOURS[2], COLOURS[4], INK)


def lines(
    groups: Mapping[str, Sequence[Mapping[str, Any]]],
    path: Path,
    *,
    ours: int,
    axes: Sequence[tuple[str, str]],
    words: Mapping[str, str],
    title: str,
) -> None:
    """Draw a line for each group in each of several pairs of logarithmic axes.

    Args:
        groups: Rows by the name of their line; a row without one of an axis's values is left out.
        path: The image file.
        ours: How many of the groups, the first ones, stand out.
        axes: Keys of abscissa and ordinate of each picture.
        words: Name of each key's axis.
        title: Title of the whole.
    """
    figure = Figure(figsize=(6.4 * len(axes), 6.6), layout="constrained")
    handles: dict[str, Any] = {}
    for axis, (x, y) in zip(figure.subplots(1, len(axes), squeeze=False)[0], axes, strict=True):
        for k, (name, rows) in enumerate(groups.items()):
            points = sorted((row[x], row[y]) for row in rows if x in row and y in row)
            if not points:
                continue
            (handles[name],) = axis.plot(
                *zip(*points, strict=True),
                color=_OURS[k % len(_OURS)] if k < ours else _PEERS[(k - ours) % len(_PEERS)],
                marker="o" if k < ours else _MARKERS[(k - ours) % len(_MARKERS)],
                lw=2.2 if k < ours else 1.0,
                ms=7 if k < ours else 6,
                mec="white",
                mew=0.6,
                alpha=1.0 if k < ours else 0.85,
                zorder=3 if k < ours else 2,
            )
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(words[x])
        axis.set_ylabel(words[y])
        for side in (axis.xaxis, axis.yaxis):
            side.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
            side.set_minor_formatter(NullFormatter())
        axis.grid(color="#e6e9ed", which="both", lw=0.6, zorder=0)
        axis.spines[["top", "right"]].set_visible(False)
    figure.suptitle(title, fontsize=14, color=INK)
    figure.legend(
        handles.values(), handles, frameon=False, loc="outside lower center", ncols=2, fontsize=9
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")
