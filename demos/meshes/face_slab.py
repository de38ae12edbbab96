# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Concrete face slabs in a row on the cushion layer of a rockfill dam, on hexahedra."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType, ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_numbers, check_positive
from meshes.entities import group_slabs, nodes_of_block
from meshes.grids import Coordinates, add_grid, graded_between


@dataclass(frozen=True)
class FaceSlab:
    """Measures and cells of slabs in a row on one cushion; ``dataclasses.replace`` changes some.

    x runs along the dam with 0 in the middle of the row, y up the slope from the lower end, z is
    normal to the face with 0 at the slabs' bottom. Between neighbours is a joint. The cushion is
    as wide and long as the row. Lengths are in metres.

    Attributes:
        slabs: Number of slabs in the row.
        width: Width of a slab along x, m.
        length: Length along the slope, m.
        slope: Horizontal length over the height of the slope; 1.4 for 1:1.4.
        thickness: Thickness of the slabs at their upper end, m.
        thickening: Thickness that is added for each metre of height below the upper end; 0 makes it
            constant.
        opening: Width of the joints before any load, at the slabs' top and bottom, m.
        layers: Cells through a slab.
        rows: Cells along the slope.
        joint_size: Width of the slabs' cells at a joint, m; None for half of a layer at mid length.
        growth: Width of a slab's cell over that of its neighbour towards the joint.
        largest: Width that no slab's cell exceeds, m.
        cushion_thickness: Thickness of the cushion, m.
        cushion_layers: Cells through the cushion.
        matching: Whether the cushion's grid continues that of the slabs (before the joints open).
        cushion_size: Size of the cushion's cells along x over that of the slabs', if they do not
            match.
        cushion_rows: Cells of the cushion along the slope, if they do not match; None for those of
            the slabs. Rows that differ make forces of node-to-surface contact swing along the slope
            with the distance of nodes that meet, and with them the stress, by a tenth or more.
    """

    slabs: int = 2
    width: float = 16.0
    length: float = 103.2
    slope: float = 1.4
    thickness: float = 0.4
    thickening: float = 0.0035
    opening: tuple[float, float] = (0.0, 0.0)
    layers: int = 5
    rows: int = 16
    joint_size: float | None = None
    growth: float = 1.2
    largest: float = 2.5
    cushion_thickness: float = 3.5
    cushion_layers: int = 4
    matching: bool = True
    cushion_size: float = 0.9
    cushion_rows: int | None = None

    def __post_init__(self) -> None:
        """Check the values.

        Raises:
            ValueError: If a number of cells is below one, or a length or ratio out of its range.
        """
        check_divisions(
            slabs=self.slabs,
            layers=self.layers,
            rows=self.rows,
            cushion_layers=self.cushion_layers,
            **({} if self.cushion_rows is None else {"cushion_rows": self.cushion_rows}),
        )
        check_positive(
            width=self.width,
            length=self.length,
            slope=self.slope,
            thickness=self.thickness,
            growth=self.growth,
            largest=self.largest,
            cushion_thickness=self.cushion_thickness,
            cushion_size=self.cushion_size,
            **({} if self.joint_size is None else {"joint_size": self.joint_size}),
        )
        if self.growth < 1:
            raise ValueError(f"growth is {self.growth}; give at least 1: cells grow off the joint.")
        if not (np.isfinite(self.thickening) and self.thickening >= 0):
            raise ValueError(f"thickening is {self.thickening}; give a number of at least 0.")
        check_numbers("opening", self.opening)
        if len(self.opening) != 2 or not all(0 <= gap < self.width for gap in self.opening):
            raise ValueError(
                f"opening is {self.opening}; give two lengths, at the top and at the bottom, of at "
                "least 0 and below the width of a slab."
            )

    @property
    def joints(self) -> Coordinates:
        """Places of the joints along x, m, shape (slabs - 1,)."""
        return self.edges[1:-1]

    @property
    def edges(self) -> Coordinates:
        """Places where slabs begin and end along x, m, shape (slabs + 1,)."""
        return np.asarray(self.width * (np.arange(self.slabs + 1) - self.slabs / 2))

    def thickness_at(self, y: Coordinates | float) -> Coordinates:
        """Thickness of the slabs, m, at a distance y up the slope, m."""
        height = (self.length - np.asarray(y)) / np.hypot(1, self.slope)
        return np.asarray(self.thickness + self.thickening * height)

    def grid(self, begin: float, end: float, scale: float = 1.0) -> Coordinates:
        """Coordinates along x of cells between two places, fine at those that are joints.

        Args:
            begin: Lower place, m.
            end: Upper place, m.
            scale: Factor of the size of the cells.
        """
        first = self.joint_size or 0.5 * float(self.thickness_at(self.length / 2)) / self.layers
        fine = [bool(np.any(np.isclose(self.joints, place))) for place in (begin, end)]
        sizes = (scale * first, self.growth, scale * self.largest)
        return graded_between(begin, end, (fine[0], fine[1]), *sizes)

    def cushion_scale(self) -> float:
        """Factor of the size of the cushion's cells: 1 if they match, else surely other cells."""
        if self.matching:
            return 1.0
        scale, (begin, end) = self.cushion_size, self.edges[:2]
        # Other sizes may give as many cells, at the same places
        while len(self.grid(begin, end, scale)) == len(self.grid(begin, end)):
            scale *= 0.95
        return scale


FACE_SLABS: Mapping[str, FaceSlab] = MappingProxyType(
    {
        "slice": FaceSlab(
            length=1.0, rows=1, thickness=0.505, thickening=0.0, largest=0.5, cushion_layers=6
        ),
        "coarse": FaceSlab(rows=12, joint_size=0.025, growth=1.18, largest=3.0, cushion_layers=3),
        "paper": FaceSlab(rows=128, joint_size=0.025, growth=1.3, largest=2.5, cushion_layers=3),
    }
)


def _open_joints(data: MeshData, model: FaceSlab) -> None:
    """Give the slabs, which gmsh has made as boxes of height 1, their thickness and joints."""
    x, edges = data.mesh.geometry.x, model.edges
    for i in range(model.slabs):
        nodes = nodes_of_block(data, 1 + i)
        height = x[nodes, 2]
        shift = 0.5 * (model.opening[0] * height + model.opening[1] * (1 - height))
        across = (x[nodes, 0] - edges[i]) / model.width
        left = shift if i > 0 else 0.0
        right = shift if i < model.slabs - 1 else 0.0
        x[nodes, 0] += left * (1 - across) - right * across
        x[nodes, 2] = height * model.thickness_at(x[nodes, 1])


def face_slab(model: FaceSlab, comm: MPI.Comm = MPI.COMM_WORLD) -> MeshData:
    """Mesh the slabs of a row and their cushion, which share no node (collective).

    ``FACE_SLABS`` has the presets "slice" (plane strain: one cell along y, constant thickness),
    "coarse" and "paper" (the size of Zhou et al. 2015, doi 10.11779/CJGE201508010). All faces of
    all bodies are tagged: `block_tag` gives the tags by the number of the body, 0 for the cushion
    and 1, 2, ... for the slabs along x. Of a slab "x0" and "x1" are its joint faces (or the row's
    ends), "y0" the lower end. The cushion has nodes below each joint and in the middle x = 0.

    Args:
        model: Measures and cells.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, in metres, with tags of its bodies in ``cell_tags`` and of faces in
        ``facet_tags``.
    """
    if not isinstance(model, FaceSlab):
        raise TypeError(
            f"model is a {type(model).__name__}; give a FaceSlab, or one of FACE_SLABS."
        )
    edges, layers = model.edges, np.linspace(0, 1, model.layers + 1)
    scale = model.cushion_scale()
    rows = model.rows if model.matching else model.cushion_rows or model.rows
    y, y_cushion = (np.linspace(0, model.length, n + 1) for n in (model.rows, rows))
    pieces = [model.grid(*ends, scale) for ends in pairwise(edges)]
    x_cushion = np.concatenate([pieces[0], *(piece[1:] for piece in pieces[1:])])
    z_cushion = np.linspace(-model.cushion_thickness, 0, model.cushion_layers + 1)

    def recipe(gmsh: ModuleType) -> None:
        bodies = [add_grid(gmsh, x_cushion, y_cushion, z_cushion)]
        for ends in pairwise(edges):
            bodies.append(add_grid(gmsh, model.grid(*ends), y, layers))
        group_slabs(gmsh, bodies, "cushion")
        gmsh.model.mesh.generate(3)

    data = build_mesh("face_slab", 3, recipe, comm)
    _open_joints(data, model)
    return data
