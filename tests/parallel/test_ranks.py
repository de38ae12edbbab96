# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes have the same answer on any number of ranks, however the mesh is distributed."""

import numpy as np
import pytest

from ranks.cases import METHODS, SCENES, Case
from ranks.launch import SCRIPTS
from ranks.outcome import differences
from ranks.together import launch_together

SCRIPT = SCRIPTS / "run_cases.py"
TOLERANCE = 1e-9
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
# solvers
TRIED = (
    ("hertz_3d", "node"),
    ("hertz_condensed", "surface"),
    ("friction_condensed", "node"),
    ("floating_3d", "surface"),
    ("tied", "node"),
    ("tied", "surface"),
    ("chain", "surface"),
    ("corner_3d", "node"),
    ("sliding_block", "node"),
    ("dragged_2d", "surface"),
    ("dragged_3d", "node"),
    ("plane", "node"),
    ("plastic", "surface"),
)
# Iterations may differ: on the way out of yield rounding decides which tangent the material has,
# and early solves of the condensed solver are as rough as the preconditioner of the ranks' parts
ROUNDED = ("plastic", "dragged_condensed", "hertz_condensed")
BOTH = list(METHODS)
CASES = [
    *((Case(scene, method), 2) for scene in SCENES for method in BOTH),
    # Ranks that share cores take long: each method on half of them
    *((Case(scene, BOTH[(n + k) % 2]), n) for n in (3, 4) for k, scene in enumerate(SCENES)),
    *(
        (Case(scene, method, partition), n)
        for partition, ranks in UNUSUAL.items()
        for n in ranks
        for scene, method in TRIED
    ),
]


class Runs:
    """Solves the wanted cases, all of a number of ranks in one launch."""

    def __init__(self, folder, wanted):
        self._folder = folder
        alone = [(Case(case.scene, case.method), 1) for case, _ in wanted]
        self._wanted = list(dict.fromkeys([*wanted, *alone]))
        self._wrong = {}

    def get(self, case, ranks):
        """Results of a case, which fails if it came to none."""
        if ranks not in self._wrong:
            names = [str(case) for case, n in self._wanted if n == ranks]
            self._wrong[ranks] = launch_together(
                SCRIPT, ranks, self._folder, names, lambda name: self._file(name, ranks)
            )
        if str(case) in self._wrong[ranks]:
            pytest.fail(self._wrong[ranks][str(case)])
        with np.load(self._file(str(case), ranks)) as file:
            found = dict(file)
        print(f"{found.pop('seconds'):.2f} s")
        if "error" in found:
            pytest.fail(str(found["error"]))
        return found

    def _file(self, name, ranks):
        return self._folder / f"{name}-{ranks}.npz"


@pytest.fixture(scope="module")
def runs(request, tmp_path_factory):
    """Runs of the cases that pytest has selected."""
    selected = [
        (item.callspec.params["case"], item.callspec.params["ranks"])
        for item in request.session.items
        if item.path == request.path and hasattr(item, "callspec")
    ]
    return Runs(tmp_path_factory.mktemp("ranks"), selected)


@pytest.mark.parametrize(("case", "ranks"), CASES, ids=str)
def test_ranks_do_not_matter(runs, case, ranks):
    expected = runs.get(Case(case.scene, case.method), 1)
    found = runs.get(case, ranks)
    if case.scene in ROUNDED:
        found["step iterations"] = expected["step iterations"]
    assert not differences(found, expected, TOLERANCE)
