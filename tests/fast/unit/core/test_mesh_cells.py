# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Nodes of cells are numbered in the core as Basix numbers them."""

import pytest

import basix
from contactx import cpp as core

CELLS = ("interval", "triangle", "quadrilateral", "tetrahedron", "hexahedron")


@pytest.mark.parametrize("degree", (1, 2))
@pytest.mark.parametrize("cell", CELLS)
def test_nodes_are_at_the_middle_of_the_vertices_of_what_basix_puts_them_on(cell, degree):
    kind = basix.CellType[cell]
    element = basix.create_element(
        basix.ElementFamily.P, kind, degree, basix.LagrangeVariant.gll_warped
    )
    expected = [()] * element.dim
    for entities, dofs in zip(basix.topology(kind), element.entity_dofs, strict=True):
        for vertices, own in zip(entities, dofs, strict=True):
            for dof in own:
                expected[dof] = tuple(vertices)
    assert [tuple(v) for v in core.node_vertices(cell, degree)] == expected


@pytest.mark.parametrize("cell", CELLS[1:])
def test_facets_have_the_vertices_that_basix_gives_them(cell):
    assert core.facet_vertices(cell) == basix.topology(basix.CellType[cell])[-2]


def test_other_cells_and_degrees_are_refused():
    with pytest.raises(ValueError, match="not cells of the kind prism"):
        core.node_vertices("prism", 1)
    with pytest.raises(ValueError, match="degree"):
        core.node_vertices("triangle", 3)
