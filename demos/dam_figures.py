# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Picture of the whole face of a dam: stress, joints, and where it crushes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import contactx as cx
from dolfinx import fem

from dam_results import Joint
from dam_scene import Array, Dam, Nodes
from meshes import block_tag
from plot.style import DOTS_PER_INCH, INK, import_plotter

_CLOSED, _OPEN = "#b3261e", "#2b6cb0"


def draw(dam: Dam, compression: fem.Function, found: Sequence[Joint], path: Path) -> None:
    """Draw the face seen from the water; all ranks must take part, and rank 0 draws.

    Args:
        dam: A solved dam.
        compression: Compression along the dam at the nodes, MPa.
        found: State of its joints.
        path: The image file.
    """
    tops = cx.Surface(dam.tags, *(block_tag(i, "top") for i in dam.slabs))
    V = dam.u.function_space
    nodes = tops.nodes(V)
    quads = [facets for _, facets in tops.facet_nodes(V).groups()]
    halves = np.concatenate([f[:, [[0, 1, 2], [1, 3, 2]]].reshape(-1, 3) for f in quads])
    part = (dam.x[nodes, :2], compression.x.array[nodes], np.searchsorted(nodes, halves))
    parts = dam.mesh.comm.gather(part)
    if parts is None:
        return
    first = np.cumsum([0, *(len(p[1]) for p in parts[:-1])])
    places, values = (np.concatenate([p[k] for p in parts]) for k in range(2))
    triangles = np.concatenate([p[2] + n for p, n in zip(parts, first, strict=True)])

    figure = import_plotter("matplotlib.figure").Figure(figsize=(12.0, 9.0), layout="constrained")
    axes = figure.subplots(3, 1, height_ratios=(3, 3, 2), sharex=True)
    _stress(figure, axes, places, values, triangles)
    _joints(axes[1], dam, found)
    _ranking(axes[2], found)
    for axis in axes:
        axis.spines[["top", "right"]].set_visible(False)
    for axis in axes[:2]:
        axis.set_ylabel("up the slope / m")
    axes[2].set_xlabel("along the dam / m")
    figure.savefig(path, dpi=DOTS_PER_INCH, facecolor="white")


def _stress(figure: Any, axes: Any, places: Array, values: Array, triangles: Nodes) -> None:
    """Map of a signed quantity, with a line where it is zero."""
    # A few nodes at joints would take all colours
    most = max(float(np.quantile(np.abs(values), 0.995)), 1e-12)
    axis, levels = axes[0], np.linspace(-most, most, 65)
    drawn = axis.tricontourf(
        *places.T, triangles, values, levels=levels, cmap="RdBu_r", extend="both"
    )
    axis.tricontour(*places.T, triangles, values, levels=[0.0], colors=INK, linewidths=0.6)
    bar = figure.colorbar(drawn, ax=list(axes), shrink=0.6)
    ticks = import_plotter("matplotlib.ticker").MaxNLocator(8).tick_values(-most, most)
    bar.set_ticks([tick for tick in ticks if abs(tick) <= most])
    bar.set_label("compression along the dam / MPa", color=INK)
    axis.set_title("Top of the slabs, seen from the water; zero is marked by a line", color=INK)


def _joints(axis: Any, dam: Dam, found: Sequence[Joint]) -> None:
    """Joints as two columns of nodes, at the slabs' bottom and at their top."""
    model = dam.model
    x = np.linspace(*model.edges[[0, -1]], 400)
    axis.plot(x, model.ground(x) / model.up[1], color=INK, lw=1.0)
    axis.plot(x, np.full_like(x, model.height / model.up[1]), color=INK, lw=1.0)
    widest = max(1e-12, *(j.opening for j in found))
    for contact in dam.joints:
        nodes = contact.slave_nodes
        gap, pressure = (f.x.array[nodes] for f in (contact.gap, contact.pressure))
        z = dam.x[nodes, 2]
        thickness = model.thickness_at(dam.x[nodes, 1] * model.up[1])
        for side, edge in ((-1, np.isclose(z, 0)), (1, np.isclose(z, thickness))):
            places = dam.x[nodes, 0] + 0.12 * side * model.width
            closed, parted = edge & (pressure > 0), edge & ~(pressure > 0)
            axis.plot(places[closed], dam.x[nodes[closed], 1], "s", color=_CLOSED, ms=2.5)
            sizes = 4 + 40 * np.nan_to_num(gap[parted]) / widest
            axis.scatter(places[parted], dam.x[nodes[parted], 1], sizes, color=_OPEN, lw=0)
    axis.set_title(
        "Joints, left at the slabs' bottom and right at their top: in contact (red), open "
        f"(blue, the widest by {1000 * widest:.2f} mm)",
        color=INK,
    )


def _ranking(axis: Any, found: Sequence[Joint]) -> None:
    """Largest compression at each joint, and its place through the slab."""
    x = [j.x for j in found]
    at_top = np.array([j.height > 0.5 for j in found])
    stress = np.array([j.stress for j in found])
    width = 0.6 * (x[1] - x[0]) if len(x) > 1 else 1.0
    for which, colour, name in (
        (at_top, _CLOSED, "upper half"),
        (~at_top, "#8a6d3b", "lower half"),
    ):
        if np.any(which):
            label = f"largest in the {name} of the slab"
            axis.bar(np.array(x)[which], stress[which], width, color=colour, label=label)
    axis.legend(frameon=False)
    axis.set_ylabel("largest compression / MPa")
    axis.set_title("Largest compression along the dam at each joint", color=INK)
