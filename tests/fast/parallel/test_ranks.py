# Copyright (C) 2026 contactx authors
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Scenes have the same answer on two ranks; on more, and otherwise distributed: tests/verify."""

import pytest

from ranks.cases import QUICK, Case
from ranks.launch import SCRIPTS, launch
from ranks.runs import Runs


@pytest.fixture(scope="module")
def runs(request, tmp_path_factory):
    return Runs.selected(request, tmp_path_factory.mktemp("ranks"))


@pytest.mark.parametrize(("case", "ranks"), [(Case(*names), 2) for names in QUICK], ids=str)
def test_ranks_do_not_matter(runs, case, ranks):
    runs.check(case, ranks)


def test_a_loop_on_forms_gives_what_the_problem_gives():
    assert float(launch(SCRIPTS / "forms_on_ranks.py", 2)) <= 1e-10


def test_soft_nodes_have_masters_of_other_ranks():
    assert float(launch(SCRIPTS / "soft_nodes_on_ranks.py", 2)) <= 1e-10
