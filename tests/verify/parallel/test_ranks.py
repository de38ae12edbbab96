# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes have the same answer on any number of ranks, however the mesh is distributed."""

import pytest

from ranks.cases import METHODS, ONE_METHOD, QUICK, SCENES, Case
from ranks.runs import Runs

# Ranks without cells, without a body, without slave nodes or master facets; ghost cells; any
UNUSUAL = {
    "first": (2,),
    "bodies": (3,),
    "opposed": (2,),
    "layers": (3,),
    "scattered": (4,),
    "ghosted": (3,),
}
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


def methods(scene):
    """Methods that a scene is solved by."""
    return [ONE_METHOD[scene]] if scene in ONE_METHOD else list(METHODS)


def half(scene, k):
    """One of its methods."""
    return methods(scene)[k % len(methods(scene))]


CASES = [
    # Those of tests/fast are not run again
    *((Case(scene, m), 2) for scene in SCENES for m in methods(scene) if (scene, m) not in QUICK),
    # Ranks that share cores take long: each method on half of them
    *((Case(scene, half(scene, n + k)), n) for n in (3, 4) for k, scene in enumerate(SCENES)),
    *(
        (Case(scene, method, partition), n)
        for partition, ranks in UNUSUAL.items()
        for n in ranks
        for scene, method in TRIED
    ),
]


@pytest.fixture(scope="module")
def runs(request, tmp_path_factory):
    return Runs.selected(request, tmp_path_factory.mktemp("ranks"))


@pytest.mark.parametrize(("case", "ranks"), CASES, ids=str)
def test_ranks_do_not_matter(runs, case, ranks):
    runs.check(case, ranks)
