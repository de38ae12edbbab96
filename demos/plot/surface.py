# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The surfaces that the pictures show, as pyvista meshes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from contactx._host.parallel.reduce import agreed
from dolfinx import fem
from dolfinx.plot import vtk_mesh

from plot.style import import_plotter

# dolfinx chooses by the type of the argument, but declares only the first choice.
_vtk_mesh: Any = vtk_mesh

AXES = {"x": 0, "y": 1, "z": 2}


def deformed_surface(
    u: fem.Function[Any],
    scalar: fem.Function[Any],
    scale: float,
    stretch: Sequence[float] = (1.0, 1.0, 1.0),
) -> Any:
    """Gather the outer surface of the deformed mesh (collective).

    Args:
        u: Displacement, length.
        scalar: Continuous scalar function of degree 1.
        scale: Factor of the displacement.
        stretch: Factor of each axis of the deformed position.

    Returns:
        On rank 0 a pyvista surface with the point data "scalar" and "reference", the position
        before the deformation; None on the other ranks.

    Raises:
        ImportError: If rank 0 has no pyvista; on all ranks.
    """
    space = scalar.function_space
    cells, types, reference = _vtk_mesh(space)
    deformed = reference.copy()
    component = fem.Function(space)
    for i in range(u.function_space.dofmap.bs):
        component.interpolate(u.sub(i))
        deformed[:, i] += scale * component.x.array.real
    # Global numbers join the ranks' parts, and never two bodies that only touch.
    numbers = space.dofmap.index_map
    width = space.dofmap.dof_layout.num_dofs
    local = cells.reshape(len(types), 1 + width)[:, 1:].astype(np.int32)
    connected = numbers.local_to_global(local.ravel()).reshape(local.shape)
    owned = slice(0, numbers.size_local)
    values = scalar.x.array.real
    part = (connected, types, deformed[owned], reference[owned], values[owned].copy())
    parts = space.mesh.comm.gather(part, root=0)
    surface = None
    with agreed(space.mesh.comm):
        if parts is not None:
            surface = _joined(parts, stretch)
    return surface


def _joined(parts: Sequence[Sequence[npt.NDArray[Any]]], stretch: Sequence[float]) -> Any:
    """Make a pyvista surface of the ranks' cells, their types, points and values."""
    connected, types, deformed, reference, values = (
        np.concatenate(arrays) for arrays in zip(*parts, strict=True)
    )
    deformed *= stretch
    cells = np.insert(connected, 0, connected.shape[1], axis=1)
    grid = import_plotter("pyvista").UnstructuredGrid(cells.ravel(), types, deformed)
    grid.point_data["reference"] = reference
    grid.point_data["scalar"] = values
    return grid.extract_surface(algorithm="dataset_surface")


def mirrored(surface: Any, planes: Sequence[str]) -> Any:
    """Add the mirror images of a surface in planes through the origin.

    Args:
        surface: A pyvista surface with the point data "reference".
        planes: Normals of the planes, keys of `AXES`.

    Returns:
        The surface with its images, without faces that lie on the planes.
    """
    for plane in planes:
        axis = AXES[plane]
        corners = surface.point_data["reference"][surface.regular_faces][..., axis]
        # The plane's own faces would end up inside the body.
        outer = surface.extract_cells(np.abs(corners).max(axis=1) > 1e-8 * surface.length)
        outer = outer.extract_surface(algorithm="dataset_surface")
        surface = outer.append_polydata(outer.reflect([float(i == axis) for i in range(3)]))
    return surface


def peak_body(surface: Any) -> tuple[Any, npt.NDArray[np.float64]]:
    """Find the body that carries the largest magnitude of the scalar.

    Args:
        surface: A pyvista surface of one or more bodies with the point data "scalar".

    Returns:
        The body's surface and its outward normal, shape (3,), averaged with the scalar's
        magnitude as the weight: of length one where a flat face is loaded, zero if all sides are.
    """
    # The filter may renumber the points, so only its own output is consistent.
    bodies = surface.connectivity("all")
    magnitude = np.abs(bodies.point_data["scalar"])
    peak = bodies.point_data["RegionId"][magnitude.argmax()]
    body = bodies.extract_cells(bodies.cell_data["RegionId"] == peak)
    body = body.extract_surface(algorithm="dataset_surface")
    # Cells of dolfinx have no fixed orientation, so those of the faces are found here.
    body = body.compute_normals(
        point_normals=False, split_vertices=False, consistent_normals=True, auto_orient_normals=True
    )
    corners = np.abs(body.point_data["scalar"])[body.regular_faces]
    # Faces beside the loaded surface touch it with some of their corners only.
    weight = corners.min(axis=1) if corners.min(axis=1).any() else corners.mean(axis=1)
    weight = weight * body.compute_cell_sizes(length=False, volume=False).cell_data["Area"]
    normal = np.asarray(weight @ body.cell_data["Normals"] / weight.sum())
    # Mirror images would carry them along with the wrong sign, and be drawn dark.
    body.cell_data.clear()
    return body, normal


def sharp_edges(surface: Any, planes: Sequence[str], flat: bool) -> Any:
    """Find the edges that are worth a strong line.

    Args:
        surface: A pyvista surface with the point data "reference".
        planes: Planes that the surface was mirrored in; their seams are left out.
        flat: Whether the surface is flat; then its outer edges count, otherwise its sharp ones.

    Returns:
        The edges as a pyvista mesh of lines.
    """
    edges = surface.extract_feature_edges(
        feature_angle=40,
        boundary_edges=flat,
        feature_edges=not flat,
        non_manifold_edges=False,
        manifold_edges=False,
    )
    if edges.n_cells == 0:
        return edges
    ends = edges.point_data["reference"][edges.lines.reshape(-1, 3)[:, 1:]]
    seams = [np.abs(ends[..., AXES[p]]).max(axis=1) < 1e-8 * surface.length for p in planes]
    return edges.extract_cells(~np.any([*seams, np.zeros(edges.n_cells, bool)], axis=0))
