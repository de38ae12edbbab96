# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Write the mesh of the demo, that of demos/hertz_sphere.py: python mesh.py [h]."""

from __future__ import annotations

import sys
from pathlib import Path

from mpi4py import MPI

from dolfinx import io

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import meshes


def main(h: float = 0.05) -> None:
    """Write hertz.xdmf, for h in radii."""
    data = meshes.hertz_sphere(h, comm=MPI.COMM_SELF)
    data.mesh.name, data.facet_tags.name = "mesh", "facet_tags"
    with io.XDMFFile(MPI.COMM_SELF, "hertz.xdmf", "w") as file:
        file.write_mesh(data.mesh)
        data.mesh.topology.create_connectivity(2, 3)
        file.write_meshtags(data.facet_tags, data.mesh.geometry)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
