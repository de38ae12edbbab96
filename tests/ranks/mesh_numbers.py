# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Run by test_scripts.py: meshes on some of the ranks against the same on one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mpi4py import MPI

import numpy as np
import numpy.typing as npt

import basix.ufl
from dolfinx import mesh
from dolfinx.mesh import CellType

import meshes
from ranks.agreeing import some_ranks, wait

Tagged = tuple[mesh.Mesh, mesh.MeshTags | None, mesh.MeshTags | None]


def model(data: Any) -> Tagged:
    return data.mesh, data.cell_tags, data.facet_tags


def one_body(comm: MPI.Comm) -> Tagged:
    data = meshes.blocks(CellType.tetrahedron, (2, 2, 2), (3, 3, 3), comm=comm)
    alone, tags = meshes.single(data, meshes.Tag.UPPER)
    return alone, None, tags


def by_hand(split: bool) -> Callable[[MPI.Comm], Tagged]:
    """A strip of squares whose nodes and cells one rank has, or each rank a part of."""

    def make(comm: MPI.Comm) -> Tagged:
        n = 12
        x = np.array([[i, j] for i in range(n + 1) for j in (0, 1)], dtype=np.float64)
        cells = np.array([[2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 3] for i in range(n)])
        if split:
            x, cells = (np.array_split(a, comm.size)[comm.rank] for a in (x, cells))
        elif comm.rank > 0:
            x, cells = x[:0], cells[:0]
        element = basix.ufl.element("Lagrange", "quadrilateral", 1, shape=(2,))
        return mesh.create_mesh(comm, cells, element, x), None, None

    return make


MODELS: dict[str, Callable[[MPI.Comm], Tagged]] = {
    "hertz_sphere": lambda comm: model(meshes.hertz_sphere(0.2, comm)),
    "hertz_cap": lambda comm: model(meshes.hertz_cap(3, comm=comm)),
    "hertz_grid": lambda comm: model(meshes.hertz_grid(0.2, comm=comm)),
    "hertz_cylinder": lambda comm: model(meshes.hertz_cylinder(0.2, comm=comm)),
    "half_cylinders": lambda comm: model(meshes.half_cylinders(1.0, 0.2, zone=0.2, comm=comm)),
    "half_spheres": lambda comm: model(meshes.half_spheres(1.0, 0.2, zone=0.2, comm=comm)),
    "rings": lambda comm: model(meshes.rings(6, comm=comm)),
    "face_slab": lambda comm: model(
        meshes.face_slab(
            replace(meshes.FACE_SLABS["slice"], slabs=3, layers=2, opening=(0.01, 0.02)), comm
        )
    ),
    "stack": lambda comm: model(
        meshes.stack(CellType.hexahedron, [(2, 2, 1), (3, 3, 1), (1, 1, 1)], comm=comm)
    ),
    "blocks, triangles": lambda comm: model(
        meshes.blocks(CellType.triangle, (3, 2), (4, 4), radius=3.0, comm=comm)
    ),
    "blocks, quadrilaterals": lambda comm: model(
        meshes.blocks(CellType.quadrilateral, (1, 1), (1, 1), comm=comm)
    ),
    "one body of two": one_body,
    "rectangle": lambda comm: (mesh.create_rectangle(comm, [[0, 0], [2, 1]], [7, 5]), None, None),
    "box": lambda comm: (
        mesh.create_unit_cube(comm, 3, 2, 4, cell_type=CellType.hexahedron),
        None,
        None,
    ),
    "by hand on one rank": by_hand(split=False),
    "by hand on all ranks": by_hand(split=True),
}


def gathered(comm: MPI.Comm, rows: npt.NDArray[Any]) -> npt.NDArray[Any] | None:
    """Rows of all ranks, sorted, on rank 0."""
    parts = comm.gather(rows, root=0)
    if parts is None:
        return None
    every = np.concatenate(parts)
    return every[np.lexsort(every.T[::-1])]


def tag_rows(domain: mesh.Mesh, tags: mesh.MeshTags) -> npt.NDArray[Any]:
    """Nodes and tag of each tagged entity that this rank owns."""
    dim = tags.dim
    domain.topology.create_connectivity(dim, domain.topology.dim)
    owned = tags.indices < domain.topology.index_map(dim).size_local
    nodes = mesh.entities_to_geometry(domain, dim, tags.indices[owned])
    numbers = np.sort(domain.geometry.input_global_indices[nodes], axis=1)
    return np.column_stack([numbers, tags.values[owned]])


def tables(comm: MPI.Comm, tagged: Tagged) -> list[npt.NDArray[Any] | None]:
    """Nodes, cells and tags, all by the original numbers of the nodes."""
    domain, *tags = tagged
    geometry, topology = domain.geometry, domain.topology
    owned = geometry.index_map().size_local
    numbers = geometry.input_global_indices
    cells = geometry.dofmaps[0][: topology.index_map(topology.dim).size_local]
    rows = [np.column_stack([numbers[:owned], geometry.x[:owned]]), numbers[cells]]
    rows += [tag_rows(domain, t) for t in tags if t is not None]
    return [gathered(comm, r) for r in rows]


def main() -> None:
    world = MPI.COMM_WORLD
    for name, make in MODELS.items():
        alone = tables(MPI.COMM_SELF, make(MPI.COMM_SELF)) if world.rank == 0 else []
        for size in range(2, world.size + 1):
            comm = some_ranks(size)
            if comm is not None:
                shared = tables(comm, make(comm))
                for one, several in zip(alone, shared, strict=False):
                    assert np.array_equal(one, several), (name, size)
                if comm.rank == 0:
                    assert len(np.unique(alone[0][:, 0])) == len(alone[0]), name
                    print(f"{name}: the same on {size} ranks", flush=True)
            wait()


if __name__ == "__main__":
    main()
