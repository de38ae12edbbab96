# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Computed pressures beside a closed formula."""

from __future__ import annotations

from pathlib import Path

import numpy.typing as npt

from contactx.plot.style import COLOURS, DOTS_PER_INCH, INK, import_plotter


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
    figure = import_plotter("matplotlib.figure").Figure(figsize=(7.2, 4.6), layout="constrained")
    axis = figure.subplots()
    axis.plot(reference_r, reference, color=INK, lw=1.8, label="closed formula", zorder=2)
    axis.plot(
        r, computed, "o", color=COLOURS[3], ms=4.5, mec="white", mew=0.5, label="computed", zorder=3
    )
    axis.set_xlabel(labels[0])
    axis.set_ylabel(labels[1])
    axis.set_title(title, fontsize=14, color=INK)
    axis.set_ylim(bottom=0)
    axis.grid(color="#e6e9ed", zorder=0)
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(frameon=False)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")
