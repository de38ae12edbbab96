# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Computed values beside a closed formula."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle
from pathlib import Path

import numpy as np
import numpy.typing as npt

from contactx.plot.style import COLOURS, DOTS_PER_INCH, INK, import_plotter

Curve = tuple[npt.ArrayLike, npt.ArrayLike]
_POINTS = (COLOURS[3], COLOURS[2], COLOURS[4])
_LINES = ("-", "--", ":")


def curves(
    computed: Mapping[str, Curve],
    exact: Mapping[str, Curve],
    path: str | Path,
    *,
    labels: tuple[str, str],
    title: str,
    joined: bool = False,
) -> None:
    """Draw computed values as points against closed curves.

    Args:
        computed: Positions and values, shape (n,) each, by the name of the curve.
        exact: The same for the curves of closed formulas.
        path: The image file; its suffix chooses the format.
        labels: Names and units of the two axes.
        title: Title of the picture.
        joined: Whether the points of a curve follow each other, and lines join them.

    Raises:
        ImportError: If matplotlib is not installed.
    """
    figure = import_plotter("matplotlib.figure").Figure(figsize=(7.2, 4.6), layout="constrained")
    axis = figure.subplots()
    for (name, (x, y)), line in zip(exact.items(), cycle(_LINES), strict=False):
        axis.plot(x, y, line, color=INK, lw=1.8, label=name, zorder=2)
    for (name, (x, y)), colour in zip(computed.items(), cycle(_POINTS), strict=False):
        axis.plot(
            x,
            y,
            "o-" if joined else "o",
            color=colour,
            lw=1.0,
            ms=4.5,
            mec="white",
            mew=0.5,
            label=name,
            zorder=3,
        )
    axis.set_xlabel(labels[0])
    axis.set_ylabel(labels[1])
    axis.set_title(title, fontsize=14, color=INK)
    if all(np.all(np.asarray(y) >= 0) for _, y in (*computed.values(), *exact.values())):
        axis.set_ylim(bottom=0)
    axis.grid(color="#e6e9ed", zorder=0)
    axis.spines[["top", "right"]].set_visible(False)
    figure.legend(frameon=False, loc="outside lower center", ncols=4)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")


def pressure_curve(
    r: npt.ArrayLike,
    computed: npt.ArrayLike,
    reference_r: npt.ArrayLike,
    reference: npt.ArrayLike,
    path: str | Path,
    *,
    labels: tuple[str, str],
    title: str,
) -> None:
    """Draw computed pressures as points against a closed curve.

    Args:
        r: Positions of the computed values, length, shape (n,).
        computed: Computed pressures, force/area, shape (n,).
        reference_r: Positions along the reference curve, length, shape (m,).
        reference: Pressures of the reference curve, force/area, shape (m,).
        path: The image file; its suffix chooses the format.
        labels: Names and units of the two axes.
        title: Title of the picture.

    Raises:
        ImportError: If matplotlib is not installed.
    """
    curves(
        {"computed": (r, computed)},
        {"closed formula": (reference_r, reference)},
        path,
        labels=labels,
        title=title,
    )
