# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Log-log pictures of the benchmarks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from plot.style import COLOURS, DOTS_PER_INCH, INK

_MARKERS = "osD^vP*X<>p"
_OTHERS = ("#5b7f95", "#7f9a3d", "#7d6aa8", "#2f9a8e", "#a8693f", "#7a7f87")
_OURS = ((COLOURS[3], "-"), (COLOURS[2], "-"), (COLOURS[3], ":"), (COLOURS[2], ":"))


def lines(
    groups: Mapping[str, Sequence[Mapping[str, Any]]],
    path: Path,
    *,
    ours: int,
    axes: Sequence[tuple[str, str]],
    words: Mapping[str, str],
    title: str,
    note: str = "",
    source: str = "",
) -> None:
    """Draw a line for each group in each of several pairs of logarithmic axes.

    Args:
        groups: Rows by the name of their line, what they have in common before a comma; a row
            without one of an axis's values is left out.
        path: The image file.
        ours: How many of the groups, the first ones, stand out.
        axes: Keys of abscissa and ordinate of each picture.
        words: Name of each key's axis.
        title: Title of the whole.
        note: Small print, such as what was measured where and when.
        source: What the file says of what it was drawn from.
    """
    # Words of a picture with one pair of axes can be read on a phone, where it is 350 pixels wide
    alone = len(axes) == 1
    size = (7.0, 8.6) if alone else (6.4 * len(axes), 6.6)
    words_size, names_size = (13, 11.5) if alone else (10, 9)
    figure = Figure(figsize=size, layout="constrained")
    handles: dict[str, Any] = {}
    families = list(dict.fromkeys(name.split(",")[0] for name in list(groups)[ours:]))
    for axis, (x, y) in zip(figure.subplots(1, len(axes), squeeze=False)[0], axes, strict=True):
        for k, (name, rows) in enumerate(groups.items()):
            points = sorted((row[x], row[y]) for row in rows if x in row and y in row)
            if not points:
                continue
            style = _style(k, name, ours, families)
            (handles[name],) = axis.plot(*zip(*points, strict=True), mec="white", mew=0.6, **style)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel(words[x], fontsize=words_size)
        axis.set_ylabel(words[y], fontsize=words_size)
        axis.tick_params(labelsize=words_size)
        for side in (axis.xaxis, axis.yaxis):
            side.set_major_locator(LogLocator(subs=(1, 2, 5)))
            side.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.10g}"))
            side.set_minor_formatter(NullFormatter())
        axis.grid(color="#e6e9ed", which="both", lw=0.6, zorder=0)
        axis.spines[["top", "right"]].set_visible(False)
    figure.suptitle(title, fontsize=14, color=INK)
    figure.legend(
        handles.values(),
        handles,
        frameon=False,
        loc="outside lower center",
        ncols=1 if alone else 2,
        fontsize=names_size,
        title=note or None,
        title_fontsize=names_size - 1.5,
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    metadata = {"Source": source} if source else None
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white", metadata=metadata)


def _style(k: int, name: str, ours: int, families: Sequence[str]) -> dict[str, Any]:
    if k < ours:
        colour, line = _OURS[k % len(_OURS)]
        return {"color": colour, "ls": line, "marker": "o", "lw": 2.2, "ms": 7, "zorder": 3}
    colour = _OTHERS[families.index(name.split(",")[0]) % len(_OTHERS)]
    marker = _MARKERS[(k - ours) % len(_MARKERS)]
    return {"color": colour, "marker": marker, "lw": 1.0, "ms": 6.5, "zorder": 2}
