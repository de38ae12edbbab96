# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Frozen kinematics are those of the iterate at which they were frozen."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from scenes import Blocks


@pytest.mark.parametrize("cell", [CellType.quadrilateral, CellType.hexahedron])
def test_slip_is_the_same_when_it_is_frozen(cell):
    """Above a ridge, where a step begins with a gap."""
    scene = Blocks(cell, gap=0.6, n_upper=9, n_lower=2)
    domain = scene.u.function_space.mesh
    x, gdim = domain.geometry.x, domain.geometry.dim
    top = np.isclose(x[:, gdim - 1], 0.0)
    # A roof
    x[top, gdim - 1] -= 0.4 * np.abs(x[top, 0] - 0.75)
    contact = scene.contact(friction=0.3)
    scene.problem(contact)
    discrete, nodes = contact.discrete, contact.discrete.nodes
    discrete.begin_step()
    scene.u.x.array[:] += 0.02 * np.random.default_rng(1).standard_normal(len(scene.u.x.array))
    discrete.halo.update_ghosts()
    discrete.search()
    discrete.update_gap()
    slip, gap = nodes.slip.copy(), nodes.gap.copy()
    assert (discrete.save()["master_feature"] != 0).sum() >= 2
    discrete.freeze(True)
    discrete.update_gap()
    assert np.abs(nodes.gap - gap).max() <= 1e-14
    assert np.abs(slip).max() > 1e-2
    assert np.abs(nodes.slip - slip).max() <= 1e-13
