# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Faces and coordinates of the gallery's own meshes, those that ``demos/meshes`` does not have."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from dolfinx import mesh


def faces(domain: mesh.Mesh, places: Sequence[tuple[int, float]]) -> mesh.MeshTags:
    """Tags of faces across the axes of a box, 1, 2, ... in the order of their places.

    Args:
        domain: The mesh.
        places: Axis and coordinate of each face.
    """
    dim = domain.topology.dim
    marked = [
        mesh.locate_entities_boundary(domain, dim - 1, lambda x, i=i, at=at: np.isclose(x[i], at))
        for i, at in places
    ]
    facets = np.concatenate(marked)
    order = np.argsort(facets)
    values = np.repeat(np.arange(1, len(marked) + 1, dtype=np.int32), [len(f) for f in marked])
    return mesh.meshtags(domain, dim - 1, facets[order], values[order])
