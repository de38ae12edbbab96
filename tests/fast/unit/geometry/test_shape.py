# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Facets without an area or turned inside out."""

from types import SimpleNamespace

from mpi4py import MPI

import numpy as np
import pytest

from contactx.geometry.facets import check_facets, corner_normals
from contactx.surface import FacetList
from dolfinx import mesh
from dolfinx.mesh import CellType

from scenes import Blocks

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])


def check(*facets):
    """Check facets, each given by the positions of its own nodes, which are numbered backwards."""
    sizes = [len(f) for f in facets]
    offsets = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    nodes = np.arange(offsets[-1], dtype=np.int32)
    halo = SimpleNamespace(comm=MPI.COMM_SELF, x=np.concatenate(facets), original=nodes[::-1])
    check_facets("the surface", "slave", FacetList(offsets, nodes), halo)


def test_corner_normals_of_a_warped_facet():
    """They are the derivatives' cross products in the corners."""
    x = SQUARE + np.random.default_rng(1).uniform(-0.2, 0.2, SQUARE.shape)
    (found,) = corner_normals(x[None])
    for (a, b), normal in zip([(0, 0), (1, 0), (0, 1), (1, 1)], found, strict=True):
        t1 = (1 - b) * (x[1] - x[0]) + b * (x[3] - x[2])
        t2 = (1 - a) * (x[2] - x[0]) + a * (x[3] - x[1])
        np.testing.assert_allclose(normal, np.cross(t1, t2), atol=1e-15)


@pytest.mark.parametrize("length", [1e-9, 1e9])
@pytest.mark.parametrize(
    "facet",
    [
        SQUARE,
        SQUARE * [1e-4, 1, 1],
        SQUARE - [[0, 0, 0.5], [0, 0, 0], [0, 0, 0], [0, 0, 0.5]],
        SQUARE - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0.45, 0.45, 0]],
        SQUARE[:3],
        SQUARE[:3] * [1e-5, 1, 1],
        SQUARE[:2, :2],
    ],
)
def test_facets_that_are_sound(facet, length):
    check(length * facet, length * (facet + 1))


@pytest.mark.parametrize("length", [1e-9, 1e9])
@pytest.mark.parametrize(
    "facet",
    [
        SQUARE[[0, 1, 3, 2]],  # a bow tie
        SQUARE - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0.6, 0.6, 0]],  # an arrow head
        SQUARE - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0.5, 0.5, 0]],  # a straight angle
        SQUARE[[0, 1, 2, 2]],
        SQUARE * [1, 0, 0],
        SQUARE * 0,
        SQUARE[[0, 1, 1]],
        np.array([[0.0, 0, 0], [1, 1, 1], [3, 3, 3]]),
        SQUARE[:3] * 0,
        SQUARE[[1, 1], :2],
        SQUARE[:2, :2] * 1e-13,
    ],
)
def test_facets_that_are_degenerate(facet, length):
    sound = SQUARE[: len(facet), : facet.shape[1]]
    named = ", ".join(map(str, range(len(facet))))
    with pytest.raises(
        ValueError,
        match=r"^1 facets of the slave surface the surface are degenerate: .*"
        rf" has the nodes {named} of the mesh",
    ):
        check(length * (sound + 1), length * facet)


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
