# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The deformed bodies, with a close-up of the contact zone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx._host.files import check_path
from contactx._host.parallel.reduce import agreed
from dolfinx import fem

from plot.checks import check_functions, check_increasing, check_numbers
from plot.page import compose
from plot.surface import AXES, deformed_surface, mirrored, peak_body, sharp_edges
from plot.view import View

# Points above this share of the largest magnitude make the zone that the close-up shows.
_ZONE_SHARE = 0.02
# Mean normals longer than this say that one side of a body is loaded, not all of it.
_ONE_SIDED = 0.3


def _draw(
    surface: Any,
    planes: Sequence[str],
    camera: Sequence[float] | None,
    clim: Sequence[float],
    flat: bool,
    box: Sequence[Sequence[float]] | None,
) -> list[tuple[npt.NDArray[np.uint8], float]]:
    """Draw the overview and, where it shows more, the close-up; each with its width."""
    if camera is None:
        camera = (0.0, 0.0, 1.0) if flat else (0.55, -1.5, 0.55)
    direction = np.asarray(camera, dtype=np.float64)
    # A last plane that stays open lets one look at the section.
    shown = planes if flat else planes[: max(1, len(planes) - 1)]
    body = mirrored(surface, shown)
    view = overview = View(body.points, direction, margin=0.04)
    edges = sharp_edges(body, shown, flat)
    images = [(view.render(body, edges, clim, lighting=not flat), float(view.extent[0]))]
    if box is not None:
        low, high = np.asarray(box, dtype=np.float64)
        reference = body.point_data["reference"][:, : len(low)]
        inside = np.all((reference >= low) & (reference <= high), axis=1)
        if not inside.any():
            raise ValueError(f"box is {box}, which holds no node of the surface; make it larger.")
        view = View(body.points[inside], direction, margin=0.0, square=True)
        images.append((view.render(body, edges, clim, lighting=False), float(view.extent[0])))
        return images
    if not np.any(surface.point_data["scalar"]):
        return images
    if not flat:
        body, normal = peak_body(surface)
        normal[[AXES[plane] for plane in planes]] = 0
        body = mirrored(body, planes)
        edges = sharp_edges(body, planes, flat)
        # A scalar that fills a body has no side that it shows on.
        if np.linalg.norm(normal) > _ONE_SIDED:
            direction = normal
    magnitude = np.abs(body.point_data["scalar"])
    zone = body.points[magnitude > _ZONE_SHARE * magnitude.max()]
    view = View(zone, direction, margin=0.5, square=True)
    # In 2D both look the same way: a contact as long as the bodies is as large in the overview.
    if flat and view.extent[0] >= overview.extent.min():
        return images
    # Without lights the colours are exactly those of the colour bar.
    images.append((view.render(body, edges, clim, lighting=False), float(view.extent[0])))
    return images


def _note(scale: float, stretch: Sequence[float]) -> str:
    """Say what is not drawn as it is."""
    notes = [] if scale == 1 else [f"displacement drawn {scale:g} times as large"]
    for axis, factor in zip(AXES, stretch, strict=True):
        if factor != 1:
            notes.append(f"{axis} drawn {factor:g} times as long")
    return ", ".join(notes)


def deformed_bodies(
    u: fem.Function[Any],
    scalar: fem.Function[Any],
    path: str | Path,
    *,
    title: str,
    label: str | None = None,
    scale: float = 1.0,
    clim: tuple[float, float] | None = None,
    camera: Sequence[float] | None = None,
    mirror: Sequence[str] = (),
    stretch: Sequence[float] = (1.0, 1.0, 1.0),
    box: Sequence[Sequence[float]] | None = None,
) -> None:
    """Draw the deformed bodies and a close-up of the contact zone, coloured by a scalar.

    The overview shows all bodies. The close-up shows the same in a box, if one is given; else where
    the scalar is not zero: in 2D of all bodies, and only where that is a small part of them, in 3D
    the surface of the body with the largest value, seen from where the other body was. Collective:
    rank 0 draws, and all ranks raise what goes wrong there.

    Args:
        u: Displacement, length, a Lagrange function with one component per direction.
        scalar: The coloured quantity, a continuous scalar Lagrange function of degree 1 on the
            same mesh, such as the contact pressure.
        path: The image file; its suffix chooses the format.
        title: Title of the picture.
        label: Name and unit of the scalar, for the colour bar; the function's name if None.
        scale: Factor of the drawn displacement.
        clim: Lowest and highest value of the colours; from the least of zero and the lowest
            value to the highest if None.
        camera: Direction from the bodies towards the viewer of the overview, shape (3,).
        mirror: Planes of symmetry through the origin, by their normals "x", "y" or "z". With
            two of them in 3D the overview leaves the last one open and shows the section there.
        stretch: Factor of each axis of the drawing, shape (3,); a thin body is easier to see
            through with its thickness stretched.
        box: Lowest and highest coordinates before the deformation of what the close-up shows, shape
            (2, dim). There must be nodes of the surface in it.

    Raises:
        ImportError: If pyvista or matplotlib is not installed.
        TypeError: If an argument is of another kind.
        ValueError: If a mirror plane is not the name of an axis, a function is of another space,
            not finite or of another mesh, a number is out of its range or the box is empty.
    """
    path = check_path("path", path)
    check_functions(u, scalar)
    for plane in mirror:
        if plane not in list(AXES)[: u.function_space.mesh.geometry.dim]:
            raise ValueError(f"mirror holds {plane!r}; give names of axes: x, y or z.")
    check_numbers("scale", scale, 1)
    check_numbers("stretch", stretch, 3)
    if not all(factor > 0 for factor in stretch):
        raise ValueError(f"stretch is {stretch}; give positive factors.")
    if clim is not None:
        check_increasing("clim", clim)
    if camera is not None:
        check_numbers("camera", camera, 3)
        if not any(camera):
            raise ValueError(f"camera is {camera}; give a direction.")
    if box is not None and (np.ndim(box) != 2 or len(box) != 2):
        raise ValueError(f"box is {box}; give its lowest and its highest coordinates.")
    surface = deformed_surface(u, scalar, scale, stretch)
    with agreed(u.function_space.mesh.comm):
        if surface is None:
            return
        if clim is None:
            values = surface.point_data["scalar"]
            low = min(0.0, float(values.min()))
            clim = (low, max(float(values.max()), low + 1e-12))
        flat = u.function_space.mesh.geometry.dim == 2
        images = _draw(surface, tuple(mirror), camera, clim, flat, box)
        compose(
            images,
            path,
            title=title,
            label=scalar.name if label is None else label,
            clim=clim,
            note=_note(scale, stretch),
        )
