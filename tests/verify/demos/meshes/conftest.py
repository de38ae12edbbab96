# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures of a mesh that the tests compare with the geometry."""

from __future__ import annotations

from mpi4py import MPI

import numpy as np
import numpy.typing as npt
import pytest

import dolfinx
import ufl
from dolfinx import fem
from dolfinx.io.gmsh import MeshData


class Measures:
    """What the tests ask of a mesh with tags."""

    def __init__(self, data: MeshData) -> None:
        """Keep the mesh and its tags."""
        assert data.cell_tags is not None and data.facet_tags is not None
        self.mesh, self.cell_tags, self.facet_tags = data.mesh, data.cell_tags, data.facet_tags

    def bodies(self) -> dict[int, float]:
        """Integrate one over each tagged body."""
        return self._integrals("dx", self.cell_tags)

    def faces(self) -> dict[int, float]:
        """Integrate one over each tagged face."""
        return self._integrals("ds", self.facet_tags)

    def nodes(self) -> int:
        """Count the nodes of all ranks."""
        return int(self.mesh.geometry.index_map().size_global)

    def points(self, body: int) -> npt.NDArray[np.float64]:
        """Coordinates of the nodes of a body on all ranks, shape (nodes, 3)."""
        local = self.mesh.geometry.x[self._body_nodes(body)]
        return np.concatenate(self.mesh.comm.allgather(local))

    def facet_points(self, tag: int) -> npt.NDArray[np.float64]:
        """Coordinates of the nodes of the facets with a tag on all ranks, (facets, nodes, 3)."""
        dim = self.mesh.topology.dim - 1
        self.mesh.topology.create_connectivity(dim, dim + 1)
        nodes = dolfinx.mesh.entities_to_geometry(self.mesh, dim, self.facet_tags.find(tag))
        return np.concatenate(self.mesh.comm.allgather(self.mesh.geometry.x[nodes]))

    def check_topology(self) -> None:
        """The bodies share no node, leave none out, and all tagged facets are exterior."""
        upper, lower = self._body_nodes(1), self._body_nodes(2)
        assert np.intersect1d(upper, lower).size == 0
        assert upper.size + lower.size == self.mesh.geometry.x.shape[0]
        self.mesh.topology.create_connectivity(self.mesh.topology.dim - 1, self.mesh.topology.dim)
        exterior = dolfinx.mesh.exterior_facet_indices(self.mesh.topology)
        assert np.isin(self.facet_tags.indices, exterior).all()

    def _body_nodes(self, body: int) -> npt.NDArray[np.int32]:
        return np.unique(self.mesh.geometry.dofmaps[0][self.cell_tags.find(body)])

    def _integrals(self, measure: str, tags: dolfinx.mesh.MeshTags) -> dict[int, float]:
        comm = self.mesh.comm
        values = sorted(set().union(*comm.allgather(set(tags.values.tolist()))))
        domain = ufl.Measure(measure, self.mesh, subdomain_data=tags)
        one = fem.Constant(self.mesh, 1.0)
        local = (fem.assemble_scalar(fem.form(one * domain(value))) for value in values)
        return {v: comm.allreduce(size, MPI.SUM) for v, size in zip(values, local, strict=True)}


@pytest.fixture
def measures() -> type[Measures]:
    """Provide the measures to the tests of this folder."""
    return Measures
