# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets without an area or turned inside out."""

import numpy as np
import pytest

from dolfinx import mesh
from dolfinx.mesh import CellType

from scenes import Blocks


@pytest.mark.parametrize(
    ("cell", "role", "tag"),
    [
        (CellType.triangle, "slave", 11),
        (CellType.tetrahedron, "master", 21),
        (CellType.hexahedron, "slave", 11),
    ],
)
def test_a_problem_refuses_them(cell, role, tag):
    """A corner of the surface is moved onto the node across its facet, or near to it."""
    scene = Blocks(cell)
    contact = scene.contact()
    domain = scene.u.function_space.mesh
    facets = np.sort(scene.tags.find(tag))
    nodes = mesh.entities_to_geometry(domain, scene.tags.dim, facets)
    x = domain.geometry.x
    corner = min(np.unique(nodes), key=lambda node: tuple(x[node]))
    holding = nodes[(nodes == corner).any(axis=1)]
    across = max(np.unique(holding), key=lambda node: np.linalg.norm(x[node] - x[corner]))
    x[corner] += (0.7 if cell == CellType.hexahedron else 1.0) * (x[across] - x[corner])
    bad = holding[(holding == across).any(axis=1)]
    named = min(sorted(domain.geometry.input_global_indices[facet].tolist()) for facet in bad)
    with pytest.raises(
        ValueError,
        match=rf"^{len(bad)} facets of the {role} surface Surface\(tags=\({tag},\).* degenerate"
        rf".* has the nodes {', '.join(map(str, named))} of the mesh",
    ):
        scene.problem(contact)
