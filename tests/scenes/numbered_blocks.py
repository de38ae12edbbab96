# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two blocks on any ranks, whose nodes and cells are the same however they are distributed."""

from __future__ import annotations

from functools import cache

from mpi4py import MPI

import numpy as np

import basix.ufl
import ufl
from contactx._host.bodies import Bodies
from contactx._host.bulk import Bulk
from contactx._host.parallel.halo import Halo
from contactx._host.unknowns import Unknowns
from dolfinx import fem, graph, mesh

SHAPES = {2: "quadrilateral", 3: "hexahedron"}
# Cut across both blocks, in pieces that are apart, a block a rank, all on one, with cells of others
PARTITIONS = ("slabs", "pieces", "blocks", "last", "ghosted")


def grid(counts, origin, size):
    """Nodes and cells of a block."""
    axes = [o + s * np.arange(n + 1) / n for n, o, s in zip(counts, origin, size, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(counts))
    number = np.arange(len(points)).reshape([n + 1 for n in counts])
    cells = [number]
    for axis in range(len(counts)):
        low, high = slice(None, -1), slice(1, None)
        cells = [c[(slice(None),) * axis + (side,)] for c in cells for side in (low, high)]
    # The first axis runs fastest in the corners of a cell
    cells = [cells[int(f"{k:0{len(counts)}b}"[::-1], 2)] for k in range(len(cells))]
    return points, np.stack([c.ravel() for c in cells], axis=1)


class TwoBlocks:
    """An upper block on a lower one that is fixed at its bottom, with nodes in any order.

    Attributes:
        u, halo, bodies, bulk: Displacement and what belongs to it.
        lower, upper: Names of the bodies.
    """

    def __init__(self, comm, dim, partition, *, corner=(0.2, 0.2, 0.1), size=(0.9, 0.9, 1.0)):
        """Create them; corner and size are those of the upper block, (x, y, height)."""
        pick = [0, 2] if dim == 2 else [0, 1, 2]
        low, cells = grid(
            (4,) * dim, np.array([0.0, 0.0, -1.0])[pick], np.array([1.5, 1.5, 1])[pick]
        )
        high, more = grid((3,) * dim, np.array(corner)[pick], np.array(size)[pick])
        rng = np.random.default_rng(0)
        order = rng.permutation(len(low) + len(high))
        points = np.empty((len(order), dim))
        points[order] = np.concatenate([low, high])
        cells = order[rng.permutation(np.concatenate([cells, more + len(low)]))]
        self.lower, self.upper = order[: len(low)].min(), order[len(low) :].min()

        def destination(comm, parts, types, local):
            middle = points[local[0].reshape(-1, 2**dim)].mean(axis=1)
            if partition == "slabs":
                rank = np.minimum(middle[:, 0] / 1.5 * parts, parts - 1)
            elif partition == "pieces":
                rank = np.floor(middle[:, 0] / 0.375) % parts
            elif partition == "blocks":
                rank = np.where(middle[:, -1] > 0, parts - 1, 0)
            else:
                rank = np.full(len(middle), parts - 1)
            return graph.adjacencylist(rank.astype(np.int32).reshape(-1, 1))._cpp_object

        if partition == "ghosted":
            destination = mesh.create_cell_partitioner(mesh.GhostMode.shared_facet, 2)
        element = basix.ufl.element("Lagrange", SHAPES[dim], 1, shape=(dim,))
        given = len(points) if comm.rank == 0 else 0
        domain = mesh.create_mesh(
            comm, cells[:given], element, points[:given], partitioner=destination
        )
        self.dim, self.domain, self.num_nodes = dim, domain, len(points)
        V = fem.functionspace(domain, ("Lagrange", 1, (dim,)))
        self.u, v = fem.Function(V), ufl.TestFunction(V)
        F = ufl.inner(ufl.sym(ufl.grad(self.u)), ufl.grad(v)) * ufl.dx
        bottom = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[dim - 1], -1))
        bc = fem.dirichletbc(np.zeros(dim), bottom, V)
        self.bulk = Bulk([F], None, Unknowns([self.u], 0, is_mixed=False), [bc])
        self.halo = Halo(self.u, V.tabulate_dof_coordinates()[:, :dim])
        self.bodies = Bodies(V, self.halo)

    def everywhere(self, values):
        """Values of owned nodes or dofs by the number of the node in the mesh as it was made."""
        halo = self.halo
        values = np.asarray(values)
        width = values.size // halo.num_owned if halo.num_owned else 0
        width = halo.comm.allreduce(width, MPI.MAX)
        rows = values.reshape(halo.num_owned, width)
        parts = halo.comm.allgather((halo.original[: halo.num_owned], rows))
        result = np.full((self.num_nodes, rows.shape[1]), np.nan)
        for numbers, part in parts:
            assert np.isnan(result[numbers]).all()
            result[numbers] = part
        return result

    def see_all(self):
        """Take all nodes into the halo."""
        owned = np.arange(self.halo.num_owned)
        mine = self.halo.numbers(owned), self.halo.owners(owned)
        numbers, owners = zip(*self.halo.comm.allgather(mine), strict=True)
        self.halo.grow(np.concatenate(numbers), np.concatenate(owners))
        assert self.halo.comm.size == 1 or self.halo.num_nodes == self.num_nodes

    def facets(self, at):
        """Facets that this rank owns, on the boundary where a function of the position holds."""
        domain, tdim = self.domain, self.dim
        domain.topology.create_connectivity(tdim - 1, tdim)
        found = mesh.locate_entities_boundary(domain, tdim - 1, at)
        found = found[found < domain.topology.index_map(tdim - 1).size_local]
        V = self.u.function_space
        node = np.zeros(len(domain.geometry.x), dtype=np.int32)
        node[domain.geometry.dofmaps[0]] = V.dofmap.list
        nodes = node[mesh.entities_to_geometry(domain, tdim - 1, found)].astype(np.int32)
        return np.arange(len(found) + 1, dtype=np.int32) * 2 ** (tdim - 1), nodes.ravel()


@cache
def alone(dim):
    """The same on this rank alone."""
    return TwoBlocks(MPI.COMM_SELF, dim, "last")
