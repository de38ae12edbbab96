# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Values of the nodes of a flat face, as a map."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

from contactx._host.files import check_path
from contactx._host.parallel.reduce import agreed

from plot.checks import check_labels
from plot.style import DOTS_PER_INCH, INK, colour_map, import_plotter, is_signed

_KINDS = ("#c7ccd3", "#2b6cb0", "#d1372c", "#5e0d2a")
STATUS_NAMES: Mapping[int, str] = MappingProxyType({0: "open", 1: "stick", 2: "slip"})


def nodal_map(
    places: npt.NDArray[np.float64],
    values: npt.NDArray[np.float64],
    path: str | Path,
    *,
    labels: tuple[str, str],
    title: str,
    label: str = "",
    triangles: npt.NDArray[np.integer] | None = None,
    kinds: Mapping[int, str] | None = None,
    comm: MPI.Comm | None = None,
) -> None:
    """Draw nodal values of a flat face: interpolated, or as points where they are kinds.

    Args:
        places: Positions of the nodes on the face, shape (n, 2).
        values: Their values, shape (n,).
        path: The image file; its suffix chooses the format.
        labels: Names and units of the two axes.
        title: Title of the picture.
        label: Name and unit of the values, for the colour bar.
        triangles: Nodes of triangles that make up the face, shape (m, 3), to interpolate on.
        kinds: Names of values that are whole numbers, such as ``STATUS_NAMES``; None for values of
            a continuous quantity.
        comm: Ranks that each have a part of the nodes, and triangles of these: all of them must
            call, rank 0 draws, and what goes wrong there is raised on all. None: what is given is
            drawn, wherever it is called.

    Raises:
        ImportError: If matplotlib is not installed.
        TypeError: If an argument is of another kind.
        ValueError: If there are neither triangles nor kinds, shapes do not fit, values to be
            interpolated are not finite, or a triangle has a node that does not exist.
    """
    if kinds is None and triangles is None:
        raise ValueError("triangles and kinds are None; give triangles to interpolate values on.")
    path = check_path("path", path)
    check_labels(labels)
    with agreed(MPI.COMM_SELF if comm is None else comm):
        _check(places, values, triangles, kinds is None)
    if comm is None:
        _draw(places, values, path, labels, title, label, triangles, kinds)
        return
    parts = comm.gather((places, values, triangles))
    with agreed(comm):
        if parts is not None:
            first = np.cumsum([0, *(len(part[1]) for part in parts[:-1])])
            places, values = (np.concatenate([part[k] for part in parts]) for k in range(2))
            if triangles is not None:
                triangles = np.concatenate([p[2] + n for p, n in zip(parts, first, strict=True)])
            _draw(places, values, path, labels, title, label, triangles, kinds)


def _check(
    places: npt.NDArray[np.float64],
    values: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.integer] | None,
    continuous: bool,
) -> None:
    """Check the data of a face, or of a rank's part of it."""
    if np.ndim(places) != 2 or np.shape(places) != (len(values), 2):
        raise ValueError(
            f"places has shape {np.shape(places)} and values {np.shape(values)}; give (n, 2) and "
            "(n,)."
        )
    if continuous and not np.all(np.isfinite(values)):
        raise ValueError("values are not all finite; leave out the nodes that have none.")
    if triangles is not None and not np.all((triangles >= 0) & (triangles < len(values))):
        raise ValueError(f"triangles have nodes that are none of 0 to {len(values) - 1}.")


def _draw(
    places: npt.NDArray[np.float64],
    values: npt.NDArray[np.float64],
    path: str | Path,
    labels: tuple[str, str],
    title: str,
    label: str,
    triangles: npt.NDArray[np.integer] | None,
    kinds: Mapping[int, str] | None,
) -> None:
    """Draw a whole face; the arguments are those of ``nodal_map``."""
    figure = import_plotter("matplotlib.figure").Figure(figsize=(9.0, 4.8), layout="constrained")
    axis = figure.subplots()
    if kinds is None:
        low, high = float(values.min()), float(values.max())
        levels = np.linspace(low, max(high, low + 1e-12), 65)
        drawn = axis.tricontourf(
            *places.T, triangles, values, levels=levels, cmap=colour_map((low, high))
        )
        bar = figure.colorbar(drawn, ax=axis)
        bar.locator = import_plotter("matplotlib.ticker").MaxNLocator()
        bar.update_ticks()
        bar.set_label(label, color=INK)
        if is_signed((low, high)):
            bar.ax.axhline(0, color=INK, lw=1.5)
    else:
        for (kind, name), colour in zip(kinds.items(), _KINDS, strict=False):
            which = np.asarray(values) == kind
            count = int(np.count_nonzero(which))
            if count == 0:
                continue
            axis.scatter(*places[which].T, s=9, color=colour, lw=0, label=f"{name} ({count})")
        figure.legend(frameon=False, loc="outside lower center", ncols=4, markerscale=2)
    axis.set_xlabel(labels[0])
    axis.set_ylabel(labels[1])
    axis.set_title(title, fontsize=14, color=INK)
    axis.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")
