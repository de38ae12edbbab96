# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The list of Dirichlet conditions once a problem has it."""

import numpy as np
import pytest

from dolfinx.mesh import CellType

from meshes import Tag
from scenes import Blocks
from story import fix

CHANGES = {
    # Slave nodes at the sides no longer move along the surface
    "appended": lambda b: b.bcs.append(fix(b.u, b.tags, 0, 0.01, Tag.UPPER_X0, Tag.UPPER_X1)),
    "taken out": lambda b: b.bcs.pop(0),
    "replaced": lambda b: b.bcs.__setitem__(-1, fix(b.u, b.tags, 1, -0.02, Tag.UPPER_TOP)),
}


@pytest.mark.parametrize("solver", ["lu", "condensed"])
@pytest.mark.parametrize("change", CHANGES)
def test_a_list_that_changes_counts_from_the_next_solve_on(change, solver):
    """As if the problem had been made with it; without friction the way there does not count."""
    scene, other = (Blocks(CellType.quadrilateral, n_upper=6, n_lower=9) for _ in range(2))
    options = {"petsc_options": {"pc_type": solver}}
    if solver == "lu":
        options["petsc_options"]["pc_factor_mat_solver_type"] = "mumps"
    contact, same = scene.contact(), other.contact()
    problem = scene.problem(contact, **options)
    problem.solve()
    first = scene.u.x.array.copy()
    CHANGES[change](scene)
    CHANGES[change](other)
    problem.solve()
    assert np.abs(scene.u.x.array - first).max() > 1e-4
    other.problem(same, **options).solve()
    np.testing.assert_allclose(scene.u.x.array, other.u.x.array, rtol=0, atol=1e-9)
    np.testing.assert_allclose(contact.multiplier, same.multiplier, rtol=0, atol=1e-9)


def test_conditions_that_come_later_are_checked():
    scene, stranger = Blocks(CellType.quadrilateral), Blocks(CellType.quadrilateral)
    problem = scene.problem(scene.contact())
    problem.solve()
    u = scene.u.x.array.copy()
    scene.bcs.append(stranger.bcs[0])
    with pytest.raises(ValueError, match="bcs"):
        problem.solve()
    assert (scene.u.x.array == u).all()
    scene.bcs.pop()
    problem.solve()
