# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The concrete face of a rockfill dam in its valley: slabs of different lengths, on hexahedra."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from types import ModuleType

from mpi4py import MPI

import numpy as np

from dolfinx.io.gmsh import MeshData

from meshes.build import build_mesh
from meshes.checks import check_divisions, check_positive
from meshes.entities import group_slabs, nodes_of_block
from meshes.grids import Coordinates, add_grid, graded_between

# Places of the layers of cells below the cushion zone, parts of the way to the other slope
_LAYERS = (0.0, 0.04, 0.1, 0.19, 0.31, 0.5, 0.75, 1.0)
# Sides of the boxes that gmsh draws along the slope and through the bodies, before they are shaped
_UNIT = 100.0


@dataclass(frozen=True)
class DamFace:
    """Measures and cells of a dam in a valley of a flat bed between two banks.

    x runs along the dam with 0 in the middle of the valley, y up the upstream face from the level
    of the river bed, z is normal to that face with 0 where the slabs lie. Lengths are in metres.
    The defaults are near the Tianshengqiao 1 dam (178 m high, slabs of 16 m).

    Attributes:
        slabs: Number of slabs.
        width: Width of a slab along x.
        height: Height of the dam above the river bed.
        bed: Part of the dam's length that the river bed takes.
        shortest: Height of the dam at its ends, part of that above the river bed.
        slope: Horizontal length over the height of both faces.
        crest: Width of the crest.
        cushion: Horizontal width of the cushion zone below the face, one layer of cells.
        thickness: Thickness of the slabs at the crest.
        thickening: Thickness that is added for each metre below the crest.
        layers: Cells through a slab.
        rows: Cells along a slab's slope.
        joint_size: Width of the slabs' cells at a joint.
        growth: Width of a slab's cell over that of its neighbour towards the joint.
        largest: Width that no slab's cell exceeds.
        rockfill_cells: Cells of the rockfill's face across a slab.
        rockfill_rows: Cells of the rockfill's face up the slope.
    """

    slabs: int = 20
    width: float = 16.0
    height: float = 178.0
    bed: float = 0.3
    shortest: float = 0.2
    slope: float = 1.4
    crest: float = 12.0
    cushion: float = 3.0
    thickness: float = 0.4
    thickening: float = 0.0035
    layers: int = 4
    rows: int = 100
    joint_size: float = 0.15
    growth: float = 1.8
    largest: float = 3.0
    rockfill_cells: int = 4
    rockfill_rows: int = 70

    def __post_init__(self) -> None:
        """Check the values.

        Raises:
            ValueError: If a number of cells is below one, or a length or ratio out of its range.
        """
        check_divisions(
            slabs=self.slabs,
            layers=self.layers,
            rows=self.rows,
            rockfill_cells=self.rockfill_cells,
            rockfill_rows=self.rockfill_rows,
        )
        check_positive(
            width=self.width,
            height=self.height,
            slope=self.slope,
            crest=self.crest,
            cushion=self.cushion,
            thickness=self.thickness,
            joint_size=self.joint_size,
            largest=self.largest,
        )
        for name in ("bed", "shortest"):
            value = getattr(self, name)
            if not 0 < value < 1:
                raise ValueError(f"{name} is {value}; give a part between 0 and 1.")
        if self.cushion >= self.crest:
            raise ValueError(f"cushion is {self.cushion}; give less than the crest, {self.crest}.")

    @property
    def length(self) -> float:
        """Length of the dam along x."""
        return self.slabs * self.width

    @property
    def edges(self) -> Coordinates:
        """Places where slabs begin and end along x, shape (slabs + 1,)."""
        return np.asarray(self.width * (np.arange(self.slabs + 1) - self.slabs / 2))

    @property
    def up(self) -> Coordinates:
        """The vertical, by the axes of the face."""
        along = np.array([0.0, 1.0, self.slope])
        return np.asarray(along / np.linalg.norm(along))

    def ground(self, x: Coordinates) -> Coordinates:
        """Height of the ground above the river bed at places along the dam."""
        half, flat = self.length / 2, self.bed * self.length / 2
        bank = np.clip((np.abs(x) - flat) / (half - flat), 0, 1)
        return np.asarray(self.height * (1 - self.shortest) * bank)

    def thickness_at(self, elevation: Coordinates) -> Coordinates:
        """Thickness of the slabs at heights above the river bed."""
        return np.asarray(self.thickness + self.thickening * (self.height - elevation))

    def depth(self, x: Coordinates) -> Coordinates:
        """Horizontal distance of places in the rockfill from the face, shape (n,)."""
        return np.asarray(-x[:, 2] / self.up[1])

    def overburden(self, x: Coordinates) -> Coordinates:
        """Vertical distance of places in the rockfill from the dam's surface, shape (n,)."""
        elevation = x @ self.up
        across = x[:, 1] * self.up[2] - x[:, 2] * self.up[1]
        upstream = across / self.slope
        downstream = self.height - (across - self.height * self.slope - self.crest) / self.slope
        surface = np.minimum(np.minimum(upstream, downstream), self.height)
        return np.asarray(np.maximum(surface - elevation, 0.0))

    def grid(self, begin: float, end: float) -> Coordinates:
        """Places along x of a slab's cells, fine at both ends."""
        sizes = (self.joint_size, self.growth, self.largest)
        return graded_between(begin, end, (True, True), *sizes)

    def shape_rockfill(self, x: Coordinates) -> Coordinates:
        """Positions of the rockfill's nodes by those in its box, shape (n, 3)."""
        elevation = self._elevation(x)
        layers = len(_LAYERS) * (1 - x[:, 2] / _UNIT)
        whole = self.crest + 2 * self.slope * (self.height - elevation)
        part = np.interp(layers, 1 + np.arange(len(_LAYERS)), _LAYERS)
        level = self.cushion * np.minimum(layers, 1) + part * (whole - self.cushion)
        # Horizontally into the dam, which is up the slope and off the face
        up, off = self.up[2], -self.up[1]
        y = elevation / self.up[1] + level * up
        return np.stack([x[:, 0], y, level * off], axis=1)

    def shape_slab(self, x: Coordinates) -> Coordinates:
        """Positions of a slab's nodes by those in its box, shape (n, 3)."""
        elevation = self._elevation(x)
        height = x[:, 2] / _UNIT * self.thickness_at(elevation)
        return np.stack([x[:, 0], elevation / self.up[1], height], axis=1)

    def _elevation(self, x: Coordinates) -> Coordinates:
        ground = self.ground(x[:, 0])
        return np.asarray(ground + x[:, 1] / _UNIT * (self.height - ground))


def dam_face(model: DamFace, comm: MPI.Comm = MPI.COMM_WORLD) -> MeshData:
    """Mesh the rockfill and the slabs on it, which share no node (collective).

    All faces of all bodies are tagged: `block_tag` gives the tags by the number of the body, 0 for
    the rockfill and 1, 2, ... for the slabs along x. Of the rockfill "top" is the face, "bottom"
    the downstream slope, "y0" the ground and "x0" and "x1" the ends; of a slab "x0" and "x1" are
    its joint faces, "y0" the lower end at the plinth, "bottom" and "top" what the rockfill and the
    water touch.

    Args:
        model: Measures and cells.
        comm: Communicator of the mesh; rank 0 makes it.

    Returns:
        The mesh, in metres, with tags of its bodies in ``cell_tags`` and of faces in
        ``facet_tags``.
    """
    if not isinstance(model, DamFace):
        raise TypeError(f"model is a {type(model).__name__}; give a DamFace.")
    edges = model.edges
    rows, face_rows = (np.linspace(0, _UNIT, n + 1) for n in (model.rows, model.rockfill_rows))
    layers = np.linspace(0, _UNIT, model.layers + 1)
    inside = np.linspace(0, _UNIT, 1 + len(_LAYERS))
    x_rockfill = np.linspace(edges[0], edges[-1], model.slabs * model.rockfill_cells + 1)

    def recipe(gmsh: ModuleType) -> None:
        bodies = [add_grid(gmsh, x_rockfill, face_rows, inside)]
        bodies += [add_grid(gmsh, model.grid(*ends), rows, layers) for ends in pairwise(edges)]
        group_slabs(gmsh, bodies, "rockfill")
        gmsh.model.mesh.generate(3)

    data = build_mesh("dam_face", 3, recipe, comm, in_strips=True)
    x = data.mesh.geometry.x
    for i in range(1 + model.slabs):
        nodes = nodes_of_block(data, i)
        x[nodes] = (model.shape_slab if i else model.shape_rockfill)(x[nodes])
    return data
