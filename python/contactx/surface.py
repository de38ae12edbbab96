# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Parts of the boundary that come into contact."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from numbers import Integral

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix
from contactx import cpp as core
from contactx._host.nodes import cells_of, geometry_of, in_cells
from contactx._host.parallel.halo import Halo
from contactx._host.parallel.reduce import agreed, anywhere, total
from dolfinx import fem, mesh
from dolfinx.mesh import CellType

# Kinds of cells that contact is made for
KINDS = (CellType.triangle, CellType.quadrilateral, CellType.tetrahedron, CellType.hexahedron)


@dataclass(frozen=True)
class FacetList:
    """Facets of a surface in compressed form, oriented outward.

    Attributes:
        offsets: First node of each facet and the end, shape (num_facets + 1,).
        nodes: Nodes of the facets, numbered as the blocks of the displacement's dofmap.
    """

    offsets: npt.NDArray[np.int32]
    nodes: npt.NDArray[np.int32]

    def groups(self) -> Iterator[tuple[npt.NDArray[np.int64], npt.NDArray[np.int32]]]:
        """Facets by their number of nodes k: their indices, and their nodes, shape (m, k)."""
        sizes = np.diff(self.offsets)
        for size in np.unique(sizes):
            which = np.flatnonzero(sizes == size)
            yield which, self.nodes[self.offsets[which][:, None] + np.arange(size)]


class Surface:
    """Tagged part of a mesh's boundary; all ranks make it together.

    Attributes:
        facet_tags: The tags.
        tags: Values that make up the surface.
        facets: Its facets on this rank, sorted.
        num_facets: Number of its facets on all ranks.
    """

    def __init__(self, facet_tags: mesh.MeshTags, *tags: int | Iterable[int]):
        """Create a surface.

        Args:
            facet_tags: Tags of facets, as gmsh models and ``mesh.meshtags`` give them.
            tags: Values in ``facet_tags`` that make up the surface: one or several.

        Raises:
            TypeError: If the arguments are of another kind.
            ValueError: If the tags are not of facets or of facets that do not exist, no tag is
                given, a tag is not there, or the cells are wedges or pyramids.
        """
        if not isinstance(facet_tags, mesh.MeshTags):
            raise TypeError(
                f"facet_tags must be dolfinx MeshTags, not {type(facet_tags).__name__}: "
                "write Surface(facet_tags, tag)"
            )
        tdim = facet_tags.topology.dim
        if facet_tags.dim != tdim - 1:
            raise ValueError(
                f"facet_tags are tags of entities of dimension {facet_tags.dim}, but the facets "
                f"of this mesh have dimension {tdim - 1}: pass the facet tags"
            )
        topology = facet_tags.topology
        if topology.cell_type not in KINDS:
            raise ValueError(
                f"the mesh has cells of the kind {topology.cell_type.name}, whose facets DOLFINx "
                "0.11 does not integrate over: contact needs triangles, quadrilaterals, tetrahedra "
                "or hexahedra"
            )
        comm: MPI.Comm = topology.comm
        facets = topology.index_map(tdim - 1)
        count = facets.size_local + facets.num_ghosts
        bad = facet_tags.indices[(facet_tags.indices < 0) | (facet_tags.indices >= count)]
        with agreed(comm):
            if len(bad) > 0:
                raise ValueError(
                    f"facet_tags have the facet {bad[0]}, but the mesh has the facets 0 to "
                    f"{count - 1} on this rank: take their numbers from "
                    "mesh.locate_entities_boundary"
                )
        values: list[int] = []
        for tag in tags:
            for value in tag if isinstance(tag, Iterable) else (tag,):
                if not isinstance(value, Integral):
                    raise TypeError(
                        f"a tag is an integer, not {value!r}: write Surface(facet_tags, 1, 2)"
                    )
                values.append(int(value))
        if not values:
            raise ValueError("a Surface needs at least one tag: its surface is empty")
        present = np.unique(facet_tags.values)
        if comm.size > 1:
            present = np.unique(np.concatenate(comm.allgather(present)))
        for tag in values:
            if tag not in present:
                there = ", ".join(map(str, present)) if len(present) else "none"
                raise ValueError(
                    f"tag {tag} is not in the facet tags; there are: {there}. Give one that is, or "
                    "tag its facets"
                )
        self.facet_tags = facet_tags
        self.tags = tuple(values)
        self.facets = np.unique(np.concatenate([facet_tags.find(tag) for tag in values]))
        owned = self.facets < facet_tags.topology.index_map(tdim - 1).size_local
        self.num_facets = int(total(comm, int(owned.sum())))

    def __repr__(self) -> str:
        """Name the tags."""
        return f"Surface(tags={self.tags}, {self.num_facets} facets)"

    def nodes(self, V: fem.FunctionSpace) -> npt.NDArray[np.int32]:
        """Nodes of the surface's facets whose cells this rank owns.

        Args:
            V: Lagrange space of degree 1 or 2 whose dofs, block by block, are the nodes.

        Returns:
            Blocks of V's dofmap, sorted, shape (n,).

        Raises:
            ValueError: As ``facet_nodes`` does.
        """
        return np.unique(self.facet_nodes(V).nodes)

    def facet_nodes(self, V: fem.FunctionSpace) -> FacetList:
        """Nodes of the surface's facets whose cells this rank owns.

        The normal of a facet, t_1 x t_2 of its local coordinates, points out of its cell. Of
        degree 2 a facet has as many as its linear parts, one after the other.

        Args:
            V: Lagrange space of degree 1 or 2 whose dofs, block by block, are the nodes.

        Returns:
            The facets.

        Raises:
            ValueError: If the tags belong to another mesh, or a facet has a cell on either side.
        """
        of, local = self.cells_and_facets(V.mesh)
        return FacetList(*core.oriented_facets(*cells_of(V), of, local, geometry_of(V.mesh)))

    def cells_and_facets(
        self, domain: mesh.Mesh
    ) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
        """Cells of the surface's facets, those that this rank owns; all ranks must take part.

        Args:
            domain: The mesh.

        Returns:
            The cells, and the number of the facet in each, shape (n,).

        Raises:
            ValueError: As ``facet_nodes`` does.
        """
        topology = domain.topology
        if self.facet_tags.topology is not topology._cpp_object:
            raise ValueError(
                f"the facet tags of {self} belong to another mesh than the displacement: make them "
                "on u.function_space.mesh"
            )
        tdim = topology.dim
        topology.create_connectivity(tdim - 1, tdim)
        facet_cells = topology.connectivity(tdim - 1, tdim)
        inner = np.diff(facet_cells.offsets)[self.facets] != 1
        if topology.comm.size > 1:
            # The cell on the other side may be on another rank
            inner |= np.isin(self.facets, topology.interprocess_facets())
        if anywhere(topology.comm, bool(inner.any())):
            raise ValueError(
                f"{self} has facets inside a body, with a cell on either side: "
                "a contact surface must be part of the boundary. Two bodies that share the nodes "
                "of their common face are one: in gmsh do not fragment the bodies"
            )
        cells, local = in_cells(domain, self.facets)
        mine = cells < topology.index_map(tdim).size_local
        return cells[mine], local[mine]


def check_straight(name: str, surface: Surface, V: fem.FunctionSpace, halo: Halo) -> None:
    """Check that a contact surface is as the displacement has it; all ranks must take part.

    See ``mesh/straight.h``.

    Args:
        name: What it is to the contact.
        surface: The surface.
        V: Space of the displacement.
        halo: Nodes on this rank.

    Raises:
        ValueError: If it is curved on any rank, on all ranks; as ``Surface.facet_nodes`` does.
    """
    cmap = V.mesh.geometry.cmaps[0]
    if cmap.degree == 1:
        return
    points = basix.create_element(
        basix.ElementFamily.P,
        basix.CellType[V.mesh.topology.cell_type.name],
        cmap.degree,
        basix.LagrangeVariant(cmap.variant),
    ).points
    core.check_straight(
        halo.nodes,
        f"{name} {surface}",
        *cells_of(V),
        geometry_of(V.mesh),
        np.asarray(points, dtype=np.float64),
        *surface.cells_and_facets(V.mesh),
    )
