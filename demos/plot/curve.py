# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Computed values beside a closed formula."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx._host.files import check_path
from contactx._host.parallel.reduce import agreed

from plot.checks import check_curves, check_increasing, check_labels, check_numbers
from plot.style import COLOURS, DOTS_PER_INCH, INK, import_plotter

Curve = tuple[npt.ArrayLike, npt.ArrayLike]
_POINTS = (COLOURS[3], COLOURS[2], COLOURS[4], "#5b7f95")
_LINES = ("-", "--", ":")


def curves(
    computed: Mapping[str, Curve],
    exact: Mapping[str, Curve],
    path: str | Path,
    *,
    labels: tuple[str, str],
    title: str,
    joined: bool = False,
    marks: Mapping[str, tuple[float, float]] | None = None,
    close_up: tuple[float, float] | None = None,
    comm: MPI.Comm | None = None,
) -> None:
    """Draw computed values as points against closed curves.

    Args:
        computed: Positions and values, shape (n,) each, by the name of the curve.
        exact: The same for the curves of closed formulas.
        path: The image file; its suffix chooses the format.
        labels: Names and units of the two axes.
        title: Title of the picture.
        joined: Whether the points of a curve follow each other, and lines join them.
        marks: Single points to draw as stars, by their names.
        close_up: Lowest and highest position of a close-up beside the picture; none if None.
        comm: Ranks that each have a part of all computed curves, one after the other: all of them
            must call, rank 0 draws, and what goes wrong there is raised on all. None: what is given
            is drawn, wherever it is called.

    Raises:
        ImportError: If matplotlib is not installed.
        TypeError: If an argument is of another kind.
        ValueError: If a curve has not as many positions as values, or a number is out of its range.
    """
    path = check_path("path", path)
    check_labels(labels)
    with agreed(MPI.COMM_SELF if comm is None else comm):
        check_curves("computed", computed)
    check_curves("exact", exact)
    for name, place in (marks or {}).items():
        check_numbers(f"marks[{name!r}]", place, 2)
    if close_up is not None:
        check_increasing("close_up", close_up)
    options = (path, labels, title, joined, marks or {}, close_up)
    if comm is None:
        _draw_page(computed, exact, *options)
        return
    parts = comm.gather(dict(computed))
    with agreed(comm):
        if parts is not None:
            whole = {name: _whole([part[name] for part in parts]) for name in computed}
            _draw_page(whole, exact, *options)


def _whole(parts: Sequence[Curve]) -> Curve:
    x, y = (
        np.concatenate([np.atleast_1d(a) for a in arrays]) for arrays in zip(*parts, strict=True)
    )
    return x, y


def _draw_page(
    computed: Mapping[str, Curve],
    exact: Mapping[str, Curve],
    path: str | Path,
    labels: tuple[str, str],
    title: str,
    joined: bool,
    marks: Mapping[str, tuple[float, float]],
    close_up: tuple[float, float] | None,
) -> None:
    """Draw whole curves; the arguments are those of ``curves``."""
    count = 1 if close_up is None else 2
    figure = import_plotter("matplotlib.figure").Figure(
        figsize=(7.2 * count, 4.6), layout="constrained"
    )
    axes = figure.subplots(1, count, squeeze=False)[0]
    for axis in axes:
        _draw(axis, computed, exact, marks, joined)
        axis.set_xlabel(labels[0])
        axis.grid(color="#e6e9ed", zorder=0)
        axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel(labels[1])
    if close_up is not None:
        axes[1].set_xlim(*close_up)
        axes[1].set_title("close-up", fontsize=11, color=INK)
    figure.suptitle(title, fontsize=14, color=INK)
    handles, names = axes[0].get_legend_handles_labels()
    if handles:
        # A row of the page's width holds some 60 letters beside the marks
        columns = max(1, min(4, 60 // max(map(len, names))))
        figure.legend(handles, names, frameon=False, loc="outside lower center", ncols=columns)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")


def _draw(
    axis: Any,
    computed: Mapping[str, Curve],
    exact: Mapping[str, Curve],
    marks: Mapping[str, tuple[float, float]],
    joined: bool,
) -> None:
    """Draw all curves into one pair of axes."""
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
    for name, (place, value) in marks.items():
        axis.plot([place], [value], "*", color=INK, ms=15, ls="none", label=name, zorder=4)
    if all(np.all(np.asarray(y) >= 0) for _, y in (*computed.values(), *exact.values())):
        axis.set_ylim(bottom=0)


def pressure_curve(
    r: npt.ArrayLike,
    computed: npt.ArrayLike,
    reference_r: npt.ArrayLike,
    reference: npt.ArrayLike,
    path: str | Path,
    *,
    labels: tuple[str, str],
    title: str,
    comm: MPI.Comm | None = None,
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
        comm: Ranks that each have a part of the computed pressures; see ``curves``.

    Raises:
        ImportError: If matplotlib is not installed.
    """
    curves(
        {"computed": (r, computed)},
        {"closed formula": (reference_r, reference)},
        path,
        labels=labels,
        title=title,
        comm=comm,
    )
