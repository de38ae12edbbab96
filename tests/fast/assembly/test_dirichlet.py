# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Dirichlet values on nodes of a contact."""

import numpy as np
import pytest

from dolfinx import fem
from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from story import fix

pytestmark = pytest.mark.usefixtures("method")


def master_values(scene):
    """A non-zero value for some contact nodes of the lower block, in every component."""
    V = scene.u.function_space
    X = V.tabulate_dof_coordinates()
    gdim = V.mesh.geometry.dim
    on_face = fem.locate_dofs_topological(V, gdim - 1, scene.tags.find(Tag.LOWER_CONTACT))
    some = on_face[X[on_face, 0] < 0.8].astype(np.int32)
    value = fem.Function(V)
    value.interpolate(lambda x: np.stack([0.01 + 0.02 * x[0] for _ in range(gdim)]))
    return fem.dirichletbc(value, some)


@pytest.mark.parametrize("sliding", ["small", "finite"])
def test_a_start_that_has_the_values_gives_the_same_answer(sliding):
    """Lifting through bulk and contact blocks does what starting from the values does."""
    lifted, started = Blocks(CellType.tetrahedron), Blocks(CellType.tetrahedron)
    for scene in (lifted, started):
        scene.bcs.append(master_values(scene))
    for bc in started.bcs:
        bc.set(started.u.x.array)
    for scene in (lifted, started):
        scene.problem(scene.contact(sliding)).solve()
    assert np.abs(lifted.u.x.array - started.u.x.array).max() <= 1e-11


def test_a_punch_whose_slave_nodes_are_prescribed():
    scene = Blocks(CellType.tetrahedron, down=0.03)
    scene.bcs.append(fix(scene.u, scene.tags, 2, -0.03, Tag.UPPER_CONTACT))
    contact = scene.contact()
    scene.problem(contact).solve()
    gap = contact.discrete.nodes.gap
    assert (contact.multiplier > 0).sum() > 3
    assert np.abs(gap[contact.multiplier > 0]).max() <= 1e-12
    assert contact.force[2] > 0
