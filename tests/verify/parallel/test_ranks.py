# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes have the same answer on any number of ranks, however the mesh is distributed."""

import pytest

from ranks.cases import METHODS, ONE_METHOD, QUICK, SCENES, Case
from ranks.runs import Runs

# Ranks without cells, without a body, without slave nodes or master facets; ghost cells; any
UNUSUAL = {"first": 2, "bodies": 3, "opposed": 2, "layers": 3, "scattered": 4, "ghosted": 3}
# Planes across the contact
UNUSUAL |= {"shared": 2}
# What they are tried on: free bodies, ties, nodes in several contacts, dragging, obstacles, both
# solvers, quadratic displacement, weights, heat
TRIED = (
    ("hertz_3d", "node"),
    ("hertz_condensed", "surface"),
    ("friction_condensed", "node"),
    ("floating_3d", "surface"),
    ("tied", "node"),
    ("tied", "surface"),
    ("chain", "surface"),
    ("chain_condensed", "surface"),
    ("corner_3d", "node"),
    ("loose_discs", "node"),
    ("sliding_block", "node"),
    ("dragged_2d", "surface"),
    ("dragged_3d", "node"),
    ("plane", "node"),
    ("plastic", "surface"),
    ("quadratic_triangles", "surface"),
    ("quadratic_tetrahedra", "node"),
    ("quadratic_condensed", "surface"),
    ("by_bodies", "surface"),
    ("by_bodies_coarse_model", "surface"),
    ("by_bodies_held", "node"),
    ("axisymmetric", "node"),
    ("heat_across", "surface"),
)


def method(scene, k):
    """One of the methods that a scene is solved by."""
    return ONE_METHOD.get(scene, list(METHODS)[k % 2])


# Ranks that share cores take long. Each scene is on two ranks by one method and on three or four by
# the other one; each kind of contact has several scenes, and is on each number of ranks
CASES = [
    *((Case(scene, method(scene, k // 2)), 2) for k, scene in enumerate(SCENES)),
    *((Case(scene, method(scene, k // 2 + 1)), 3 + k % 2) for k, scene in enumerate(SCENES)),
    *(
        (Case(scene, by, partition), ranks)
        for i, (partition, ranks) in enumerate(UNUSUAL.items())
        for k, (scene, by) in enumerate(TRIED)
        if (i + k) % 3 == 0
    ),
]
# Those of tests/fast are not run again
CASES = [(case, n) for case, n in CASES if (case, n) not in [(Case(*names), 2) for names in QUICK]]


@pytest.fixture(scope="module")
def runs(request, tmp_path_factory):
    return Runs.selected(request, tmp_path_factory.mktemp("ranks"))


@pytest.mark.parametrize(("case", "ranks"), CASES, ids=str)
def test_ranks_do_not_matter(runs, case, ranks):
    runs.check(case, ranks)
