# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes have the same answer on any number of ranks, however the mesh is distributed."""

from pathlib import Path

import numpy as np
import pytest
from cases import METHODS, SCENES, Case
from launch import Failure, Hang, launch
from outcome import differences

SCRIPT = Path(__file__).with_name("run_cases.py")
TOLERANCE = 1e-9
# Ranks without cells, without a body, without slave nodes or master facets; ghost cells; any
UNUSUAL = {
    "first": (2, 3),
    "bodies": (2, 3),
    "opposed": (2, 4),
    "layers": (3,),
    "scattered": (3, 4),
    "ghosted": (2, 4),
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
CASES = [
    *((Case(scene, method), n) for n in (2, 3, 4) for scene in SCENES for method in METHODS),
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
        self._launched = set()
        self._hangs = {}

    def get(self, case, ranks):
        """Results of a case, which fails if it came to none."""
        if ranks not in self._launched:
            self._launched.add(ranks)
            self._launch(ranks)
        path = self._path(case, ranks)
        if not path.exists():
            pytest.fail(self._hangs.get((case, ranks), "not run: others before it hang"))
        with np.load(path) as file:
            found = dict(file)
        print(f"{found.pop('seconds'):.2f} s")
        if "error" in found:
            pytest.fail(str(found["error"]))
        return found

    def _launch(self, ranks):
        left = [case for case, n in self._wanted if n == ranks]
        # A few that hang shall not hide the others
        for _ in range(3):
            try:
                launch(SCRIPT, ranks, str(self._folder), *map(str, left))
                return
            except (Hang, Failure) as error:
                left = [case for case in left if not self._path(case, ranks).exists()]
                if not left:
                    raise
                self._hangs[left.pop(0), ranks] = str(error)

    def _path(self, case, ranks):
        return self._folder / f"{case}-{ranks}.npz"


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
    assert not differences(found, expected, TOLERANCE)
