# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Images set on a page with a title, lengths and a colour bar."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from plot.style import DOTS_PER_INCH, INK, colour_map, import_plotter, is_signed


def compose(
    images: Sequence[tuple[npt.NDArray[np.uint8], float]],
    path: str | Path,
    *,
    title: str,
    label: str,
    clim: tuple[float, float],
    note: str,
) -> None:
    """Set the overview and the close-up side by side with a colour bar and save the page.

    Args:
        images: One or two images, shape (height, width, 3), each with its width as a length.
        path: The image file; its suffix chooses the format.
        title: Title of the page.
        label: Name of the colour bar.
        clim: Lowest and highest value of the colour bar.
        note: A line below the images; none if empty.
    """
    figure_module, cm = import_plotter("matplotlib.figure"), import_plotter("matplotlib.cm")
    normalize = import_plotter("matplotlib.colors").Normalize(*clim)
    height = 5.0
    ratios = [min(image.shape[1] / image.shape[0], 2.0) for image, _ in images]
    figure = figure_module.Figure(
        figsize=(height * sum(ratios) + 1.3, height + 0.9), layout="constrained"
    )
    axes = figure.subplots(1, len(images), width_ratios=ratios, squeeze=False)[0]
    names = ("", "close-up")
    for axis, (image, width), name in zip(axes, images, names, strict=False):
        axis.imshow(image, interpolation="antialiased")
        axis.set_axis_off()
        axis.set_title(name, fontsize=11, color=INK)
        # A round length of at most a quarter of the image.
        power = 10 ** np.floor(np.log10(width / 4))
        bar = max(factor * power for factor in (1, 2, 5) if factor * power <= width / 4)
        end, below = bar / width * image.shape[1], 1.02 * image.shape[0]
        axis.plot([0, end], [below, below], color=INK, lw=2, clip_on=False)
        axis.annotate(
            f"{bar:g}", (end, below), (6, 0), textcoords="offset points", va="center", color=INK
        )
    figure.suptitle(title, fontsize=15, color=INK)
    if note:
        figure.supxlabel(note, fontsize=9, color=INK)
    colour_bar = figure.colorbar(
        cm.ScalarMappable(normalize, colour_map(clim)), ax=list(axes), shrink=0.8, aspect=25
    )
    colour_bar.set_label(label, fontsize=12, color=INK, labelpad=10)
    colour_bar.outline.set_visible(False)
    if is_signed(clim):
        colour_bar.ax.axhline(0, color=INK, lw=1.5)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")
