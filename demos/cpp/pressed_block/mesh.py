# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Write the mesh of the demo, a block on a wider one: python mesh.py."""

from __future__ import annotations

import sys
from pathlib import Path

from mpi4py import MPI

from dolfinx import io
from dolfinx.mesh import CellType

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import meshes


def main() -> None:
    """Write pressed_block.xdmf."""
    data = meshes.blocks(
        CellType.quadrilateral,
        [20, 10],
        [24, 4],
        size_upper=[2.0, 1.0],
        size_lower=[3.0, 0.5],
        shift=[0.5],
        comm=MPI.COMM_SELF,
    )
    data.mesh.name, data.facet_tags.name = "mesh", "facet_tags"
    with io.XDMFFile(MPI.COMM_SELF, "pressed_block.xdmf", "w") as file:
        file.write_mesh(data.mesh)
        data.mesh.topology.create_connectivity(1, 2)
        file.write_meshtags(data.facet_tags, data.mesh.geometry)


if __name__ == "__main__":
    main()
