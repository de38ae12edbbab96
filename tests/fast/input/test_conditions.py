# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The list of Dirichlet conditions once a problem has it."""

import pytest

from inputs.rows import scene
from meshes import Tag
from story import fix

CHANGES = {
    "appended": lambda b: b.bcs.append(fix(b.u, b.tags, 1, 0.0, Tag.UPPER_CONTACT)),
    "taken out": lambda b: b.bcs.pop(),
    "replaced": lambda b: b.bcs.__setitem__(0, fix(b.u, b.tags, 0, 0.1, Tag.LOWER_BOTTOM)),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_list_that_changes_is_refused(change):
    """It would have no effect; to put it back is enough."""
    blocks = scene()
    problem = blocks.problem(blocks.contact())
    problem.solve()
    before, u = list(blocks.bcs), blocks.u.x.array.copy()
    CHANGES[change](blocks)
    with pytest.raises(ValueError, match=r"^bcs has changed since .* Make another ContactProblem"):
        problem.solve()
    assert (blocks.u.x.array == u).all()
    blocks.bcs[:] = before
    problem.solve()
