# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A parallel projection and its image."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from plot.style import INK, colour_map, import_plotter

_PIXELS = 1400


class View:
    """A parallel projection that just holds some points.

    Args:
        points: The points, shape (n, 3).
        direction: From the scene towards the viewer, shape (3,), of any length.
        margin: Free space around the points, as a share of their extent.
        square: Whether the view is as wide as it is high.
    """

    def __init__(
        self,
        points: npt.NDArray[np.float64],
        direction: npt.NDArray[np.float64],
        *,
        margin: float,
        square: bool = False,
    ) -> None:
        """Find the directions, the focus and the extent of the projection."""
        self.towards = direction / np.linalg.norm(direction)
        # The last axis in space points up, unless one looks along it.
        up = np.eye(3)[1 if abs(self.towards[2]) > 0.95 else 2]
        right = np.cross(up, self.towards)
        right /= np.linalg.norm(right)
        self.up = np.cross(self.towards, right)
        basis = np.stack((right, self.up, self.towards))
        projected = points @ basis.T
        low, high = projected.min(axis=0), projected.max(axis=0)
        self.focus = (low + high) / 2 @ basis
        self.extent = (1 + margin) * np.maximum((high - low)[:2], 1e-12)
        if square:
            self.extent = np.full(2, self.extent.max())

    def render(
        self, surface: Any, edges: Any, clim: Sequence[float], lighting: bool
    ) -> npt.NDArray[np.uint8]:
        """Draw a surface coloured by its scalar.

        Args:
            surface: A pyvista surface with the point data "scalar".
            edges: Lines to draw upon it.
            clim: Lowest and highest value of the colours.
            lighting: Whether the surface is lit; if not, its colours are those of the map.

        Returns:
            The image, shape (height, width, 3).
        """
        pyvista = import_plotter("pyvista")
        pyvista.OFF_SCREEN = True
        pixels = np.ceil(_PIXELS * self.extent / self.extent.max()).astype(int)
        plotter = pyvista.Plotter(off_screen=True, window_size=pixels.tolist())
        plotter.set_background("white")
        plotter.add_mesh(
            surface,
            scalars="scalar",
            cmap=colour_map(clim),
            clim=list(clim),
            show_scalar_bar=False,
            show_edges=True,
            edge_color=INK,
            edge_opacity=0.3,
            line_width=1.0,
            lighting=lighting,
            ambient=0.5 if lighting else 0.0,
            diffuse=0.6 if lighting else 1.0,
            specular=0.0,
        )
        if edges.n_cells:
            plotter.add_mesh(edges, color=INK, line_width=2.0, lighting=False)
        distance = 10 * surface.length
        plotter.camera_position = [self.focus + distance * self.towards, self.focus, self.up]
        plotter.camera.parallel_projection = True
        plotter.camera.parallel_scale = self.extent[1] / 2
        plotter.camera.clipping_range = (0.1 * distance, 2 * distance)
        plotter.enable_anti_aliasing("ssaa")
        image = plotter.screenshot(return_img=True)
        plotter.close()
        return np.asarray(image)
