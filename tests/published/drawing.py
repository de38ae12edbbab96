# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Small pictures of the gallery: a plane mesh as it is deformed, or a curve beside a formula."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from dolfinx import fem

from plot.style import INK, colour_map, import_plotter
from published.record import Answer

# Inches and dots per inch: what a table in a browser shows well
SIZE, DOTS = (3.2, 2.2), 100
_COLOURS = 48


def picture(answer: Answer, path: Path) -> None:
    """Draw what an answer draws into a file of few colours."""
    matplotlib = import_plotter("matplotlib")
    matplotlib.use("Agg")
    pyplot = import_plotter("matplotlib.pyplot")
    image = import_plotter("PIL.Image")
    with pyplot.rc_context({"font.size": 7, "axes.linewidth": 0.6, "lines.linewidth": 1.0}):
        figure, axes = pyplot.subplots(figsize=SIZE, dpi=DOTS, layout="constrained")
        answer.draw(axes)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png")
        pyplot.close(figure)
    buffer.seek(0)
    with image.open(buffer) as full:
        full.convert("RGB").quantize(_COLOURS).save(path, optimize=True)


def curve(
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    labels: tuple[str, str],
    exact: Callable[[np.ndarray], np.ndarray] | None = None,
    end: float | None = None,
) -> Callable[[Any], None]:
    """A drawing of nodal values, and of a formula beside them.

    Args:
        end: Largest place that is shown; all of them if None.
    """
    places, values = np.asarray(x), np.asarray(y)
    shown = np.flatnonzero(places <= (np.inf if end is None else end))
    order = shown[np.argsort(places[shown])]
    places, values = places[order], values[order]

    def draw(axes: Any) -> None:
        if exact is not None:
            line = np.linspace(places[0], places[-1], 400)
            axes.plot(line, exact(line), color=INK, label="published")
        axes.plot(places, values, "o", color="#d1372c", markersize=2, label="contactx")
        if values.min() >= 0:
            axes.set_ylim(bottom=0)
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.legend(frameon=False)

    return draw


def deformed(
    u: fem.Function, *, scale: float = 1.0, box: tuple[float, float, float, float] | None = None
) -> Callable[[Any], None]:
    """A drawing of a plane mesh, displaced, coloured by how far.

    Args:
        box: Least x, largest x, least y and largest y that are shown; everything if None.
    """
    V = u.function_space
    gdim = V.mesh.geometry.dim
    x = V.tabulate_dof_coordinates()[:, :2].copy()
    moved = u.x.array.reshape(-1, gdim)[:, :2].copy()
    corners = np.array([_ring(cell) for cell in V.dofmap.list[:, : _vertices(V)]])

    def draw(axes: Any) -> None:
        collections = import_plotter("matplotlib.collections")
        points = x + scale * moved
        length = np.linalg.norm(moved, axis=1)
        cells = collections.PolyCollection(
            points[corners],
            array=length[corners].mean(axis=1),
            cmap=colour_map(),
            edgecolors=INK,
            linewidths=0.15,
        )
        axes.add_collection(cells)
        if box is None:
            axes.autoscale_view()
        else:
            axes.set_xlim(box[0], box[1])
            axes.set_ylim(box[2], box[3])
        axes.set_aspect("equal")
        axes.axis("off")
        if scale != 1:
            axes.set_title(f"displacement drawn {scale:g} times as large", fontsize=6)

    return draw


def _vertices(V: fem.FunctionSpace) -> int:
    """Number of a plane cell's corners, which come first among its dofs."""
    return 3 if V.mesh.basix_cell().name == "triangle" else 4


def _ring(cell: npt.NDArray[np.int32]) -> npt.NDArray[np.int32]:
    """Corners in the order around the cell."""
    return cell if len(cell) == 3 else cell[[0, 1, 3, 2]]


def surface(
    x: npt.NDArray[np.float64], values: npt.NDArray[np.float64], label: str, end: float
) -> Callable[[Any], None]:
    """A drawing of nodal values on a plane surface in space.

    Args:
        end: Largest distance from the origin that is shown along an axis.
    """
    places, shown = x[:, :2].copy(), values.copy()

    def draw(axes: Any) -> None:
        near = (np.abs(places) < end).all(axis=1)
        filled = axes.tricontourf(
            places[near, 0], places[near, 1], shown[near], levels=12, cmap=colour_map()
        )
        axes.figure.colorbar(filled, ax=axes, label=label)
        axes.plot(places[near, 0], places[near, 1], ".", color=INK, markersize=0.6)
        axes.set_aspect("equal")

    return draw
